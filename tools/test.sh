#!/bin/sh
# Builds everything and runs every test:  sh tools/test.sh [--quick | --board NAME]
# Installs what is missing (Debian). Works in build/; the last line says how it went.
set -eu

usage() {
    echo "usage: sh tools/test.sh [--quick | --board NAME]" >&2
    echo "  --quick        about two minutes: without the long tests and the sanitizers" >&2
    echo "  --board NAME   the unit suites on that board in its emulator, and nothing else;" >&2
    echo "                 'list' names the boards, 'all' is all of them" >&2
    exit 2
}

quick=''
board=''
while [ $# -gt 0 ]; do
    case $1 in
    --quick) quick=yes ;;
    --board)
        [ $# -ge 2 ] || usage
        board=$2
        shift
        ;;
    *) usage ;;
    esac
    shift
done

root=$(cd "$(dirname "$0")/.." && pwd)
build=$root/build
logs=$build/logs
mkdir -p "$logs"
cd "$root"
. tools/dev/need.sh

# What the emulated machines of tests/target take; $1 is a board, 'all', or another of them.
need_machines() {
    description=ports/baremetal/boards/$1.cmake
    if [ "$1" = all ] || grep -qs 'CORE cortexm' "$description"; then
        need gcc-arm-none-eabi has arm-none-eabi-gcc
        need qemu-system-arm has qemu-system-arm
    fi
    if [ "$1" = all ] || grep -qs 'CORE riscv' "$description"; then
        need gcc-riscv64-unknown-elf has riscv64-unknown-elf-gcc
        need qemu-system-misc has qemu-system-riscv32
    fi
    if [ "$1" = all ] || [ "$1" = aarch64-linux ]; then
        need gcc-aarch64-linux-gnu has aarch64-linux-gnu-gcc
        need libc6-dev-arm64-cross test -e /usr/aarch64-linux-gnu/include/stdio.h
        need qemu-user has qemu-aarch64
    fi
    if [ "$1" = all ] || [ "$1" = s390x-linux ]; then
        need gcc-s390x-linux-gnu has s390x-linux-gnu-gcc
        need libc6-dev-s390x-cross test -e /usr/s390x-linux-gnu/include/stdio.h
        need qemu-user has qemu-s390x
    fi
}

# What the Arduino library takes (tests/packages).
need_arduino() {
    need gcc-avr has avr-gcc
    need avr-libc test -e /usr/lib/avr/include/avr/io.h
    need libsimavr-dev has_header simavr/sim_avr.h
    need libelf-dev has_header libelf.h
    need arduino-builder has arduino-builder
    need arduino-ctags has arduino-ctags
    need arduino-core-avr test -d /usr/share/arduino/hardware/arduino/avr
}

# What the virtual machine of tests/camera takes; its kernel is downloaded but not installed.
need_cameras() {
    need libcamera-dev pkg-config --exists libcamera
    need libcamera-ipa sh -c 'ls /usr/lib/*/libcamera/ipa_vimc.so'
    need qemu-system-x86 has qemu-system-x86_64
    need busybox-static has busybox
    need cpio has cpio
    need kmod has depmod
    need xz-utils has xz
}

if [ "$board" ]; then
    need gcc has gcc
    need libc6-dev has_header stdlib.h
    need make has make
    need cmake has cmake
    need python3 has python3
    need python3-pip python3 -m pip --version
    need_machines "$board"
    install_missing "$logs/install.log"
    case $board in
    list) exec python3 tests/target/matrix.py --list ;;
    all) board=$(python3 tests/target/matrix.py --list | cut -d ' ' -f 1) ;;
    esac
    exec python3 tests/target/matrix.py --unity "$build/unity" $board
fi

need gcc has cc
need gcc has gcc
need libc6-dev has_header stdlib.h
need g++ has g++
need make has make
need cmake has cmake
need clang has clang
need libclang-rt-dev sanitizes clang "$logs/clang-sanitizes"
need valgrind has valgrind
need pkg-config has pkg-config
need libpng-dev has_header png.h
need libjpeg-dev has_header jpeglib.h
need python3 has python3
need python3-venv python3 -c 'import ensurepip, venv'
need_machines all
need_cameras
need opencv-doc test -d /usr/share/doc/opencv-doc
need_arduino
install_missing "$logs/install.log"

# Python packages go into a folder of their own: the system's Python is not ours to change.
python=$build/venv/bin/python
stamp=$build/venv/installed-requirements.txt
if ! cmp -s tests/requirements.txt "$stamp" || ! "$python" -m pip --version >/dev/null 2>&1; then
    echo "Installing the Python packages of tests/requirements.txt (log: $logs/python.log)"
    rm -rf "$build/venv"
    step "$logs/python.log" python3 -m venv "$build/venv" || exit 1
    step "$logs/python.log" "$python" -m pip --disable-pip-version-check install \
        -r tests/requirements.txt || exit 1
    cp tests/requirements.txt "$stamp"
fi

# build_with NAME COMPILER [CMAKE-OPTION...]
build_with() {
    name=$1
    compiler=$2
    shift 2
    echo "Building with $name (logs: $logs/$name-*.log)"
    step "$logs/$name-configure.log" cmake -S "$root" -B "$build/$name" \
        -DCMAKE_C_COMPILER="$compiler" -DPEL_WERROR=ON -DPEL_PYTHON="$python" \
        -DPEL_UNITY_DIR="$build/unity" -DPEL_BUILD_TOOLS=ON -DPEL_BUILD_TESTS=ON "$@" &&
        step "$logs/$name-build.log" cmake --build "$build/$name" --parallel "$jobs"
}

# run_tests NAME [CTEST-OPTION...]; what they gave is read from ctest's log afterwards.
run_tests() {
    name=$1
    shift
    # An old log must not stand in for a run that never happened.
    rm -f "$build/$name/Testing/Temporary/LastTest.log"
    (cd "$build/$name" && ctest --show-only=json-v1 "$@" >planned-tests.json)
    (cd "$build/$name" && ctest --parallel "$jobs" "$@") || true
    summary="$summary --run $name:$build/$name"
}

summary=''
label=''
ratios=$build/gcc/tests/bench/ratios.txt
rm -f "$ratios"
if [ "$quick" ]; then
    label='-L quick'
fi

if build_with gcc gcc; then
    summary="$summary --check compile-gcc:passed"
    run_tests gcc $label
else
    summary="$summary --check compile-gcc:failed"
fi
if build_with clang clang; then
    summary="$summary --check compile-clang:passed"
else
    summary="$summary --check compile-clang:failed"
fi
if ! sanitizes gcc "$logs/gcc-sanitizes"; then
    say_unsanitized gcc
    summary="$summary --check sanitizers-of-gcc:skipped"
elif [ -z "$quick" ]; then
    if build_with sanitize gcc -DPEL_SANITIZE=ON -DPEL_WERROR=OFF; then
        summary="$summary --check compile-sanitize:passed"
        run_tests sanitize -L quick
    else
        summary="$summary --check compile-sanitize:failed"
    fi
fi

if [ -z "$quick" ] && [ -f "$ratios" ]; then
    cat "$ratios"
fi
exec "$python" tools/dev/summary.py $summary
