#!/bin/sh
# Finds the coloured objects of a robot's picture:  sh tools/demo.sh [--board BOARD] [BUILD_DIR]
# Installs what is missing (Debian), builds the command `pel` in build/ (or BUILD_DIR) and runs it.
# With --board an emulated microcontroller finds them: its firmware gets the picture line by line,
# and `pel listen` prints what it says on its serial line. Boards: ports/baremetal/boards.
set -eu

board=''
if [ "${1:-}" = --board ]; then
    board=${2:-}
    board_file=$(dirname "$0")/../ports/baremetal/boards/$board.cmake
    if [ -z "$board" ] || [ ! -f "$board_file" ]; then
        echo "usage: sh tools/demo.sh [--board BOARD] [BUILD_DIR]" >&2
        echo "boards: $(ls "$(dirname "$board_file")" | sed 's/\.cmake$//' | tr '\n' ' ')" >&2
        exit 2
    fi
    # The emulator that the board names tells which compiler it wants.
    case $(cat "$board_file") in
    *qemu-system-riscv32*) tools=riscv64-unknown-elf ;;
    *) tools=arm-none-eabi ;;
    esac
    shift 2
fi
build=${1:-$(dirname "$0")/../build}
mkdir -p "$build/logs" "$build/demo-out"
build=$(cd "$build" && pwd)
cd "$(dirname "$0")/.."
. tools/dev/need.sh

need gcc has cc
need libc6-dev has_header stdlib.h
need make has make
need cmake has cmake
need libpng-dev has_header png.h
need libjpeg-dev has_header jpeglib.h
if [ "$board" ]; then
    need "gcc-$tools" has "$tools-gcc"
    case $tools in
    riscv*) need qemu-system-misc has qemu-system-riscv32 ;;
    *) need qemu-system-arm has qemu-system-arm ;;
    esac
fi
install_missing "$build/logs/demo-install.log"

echo "Building pel (log: $build/logs/demo-build.log)"
step "$build/logs/demo-configure.log" cmake -S . -B "$build/demo" -DPEL_BUILD_TOOLS=ON \
    -DPEL_BUILD_TESTS=OFF || exit 1
step "$build/logs/demo-build.log" cmake --build "$build/demo" --parallel "$jobs" || exit 1

pel=$build/demo/tools/pel
out=$build/demo-out

# The picture as a camera would send it, what the robot says of it, and what it takes for that.
demo_board() {
    firmware=$build/demo-$board
    echo "Building the firmware for $board (log: $build/logs/demo-$board.log)"
    step "$build/logs/demo-$board-configure.log" cmake -S ports/robot -B "$firmware" \
        -DPEL_BOARD="$board" -DCMAKE_TOOLCHAIN_FILE="$PWD/ports/baremetal/toolchain.cmake" &&
        step "$build/logs/demo-$board.log" cmake --build "$firmware" --parallel "$jobs" || exit 1
    "$pel" convert --to YUYV tools/demo/robot.ppm "$out/camera.yuv"
    echo
    echo "$board sees tools/demo/robot.ppm line by line and says:"
    (cd "$out" && sh "$firmware/run.sh" 2>robot.said) || {
        cat "$out/robot.said" >&2
        echo "the firmware failed" >&2
        exit 1
    }
    "$pel" listen -c ports/robot/robot.classes "$out/robot.uart"
    echo
    echo "For its motors:"
    "$pel" listen -c ports/robot/robot.classes --targets "$out/robot.uart"
    echo
    stack=$(sed -n 's/^stack used: \([0-9]*\) bytes$/\1/p' "$out/robot.said")
    "$tools-size" "$firmware/robot_blobs.elf" | awk -v stack="$stack" 'NR == 2 {
        printf "Flash: %d bytes. RAM: %d bytes (%d of data, %d of stack used).\n",
            $1 + $2, $2 + $3 + stack, $2 + $3, stack }'
    "$pel" listen -c ports/robot/robot.classes --csv "$out/robot.uart" >"$out/robot.csv"
    "$pel" blobs -c ports/robot/robot.classes --raw YUYV 320x240 --csv "$out/camera.yuv" \
        >"$out/desk.csv"
    if ! cmp "$out/robot.csv" "$out/desk.csv"; then
        echo "this is not what 'pel blobs' finds" >&2
        exit 1
    fi
    echo "'pel blobs' finds the same, byte for byte."
}

if [ "$board" ]; then
    demo_board
    exit 0
fi
echo
echo "pel blobs -c tools/demo/robot.classes --min-area 20 tools/demo/robot.ppm"
"$pel" blobs -c tools/demo/robot.classes --min-area 20 -o "$out/robot.ppm" tools/demo/robot.ppm
"$pel" blobs -c tools/demo/robot.classes --min-area 20 -o "$out/robot.png" tools/demo/robot.ppm \
    >/dev/null
echo
echo "The picture with boxes, centroids and axes:"
echo "    $out/robot.ppm"
echo "    $out/robot.png"
