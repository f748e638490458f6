#!/bin/sh
# Cameras as the kernel drives them, in a virtual machine:
#     sh tests/camera/run.sh [--out FOLDER] [--programs FOLDER] [--software]
# Boots Debian's kernel once in QEMU with its virtual cameras (vivid, v4l2loopback, vimc) and runs
# guest.sh there: what the port gets from them, by value, and what it does when they misbehave. One
# line for each check; the last line counts them. What cannot be had is skipped, and said.
#
#   --out       where to work, default build/camera; the image in it is used again
#   --programs  a build folder that has camera_check and pel already; default: builds its own
#   --software  not with /dev/kvm, even where it works
set -eu

root=$(cd "$(dirname "$0")/../.." && pwd)
out=$root/build/camera
programs=''
software=''
while [ $# -gt 0 ]; do
    case $1 in
    --out | --programs)
        [ $# -ge 2 ] || { echo "$1 needs a folder" >&2; exit 2; }
        case $1 in --out) out=$2 ;; *) programs=$2 ;; esac
        shift
        ;;
    --software) software=yes ;;
    *) sed -n '2,/^set/{/^#/s/^# \{0,1\}//p}' "$0" >&2; exit 2 ;;
    esac
    shift
done
mkdir -p "$out"
out=$(cd "$out" && pwd)
. "$root/tools/dev/need.sh"
. "$root/tests/camera/image.sh"

# A test that cannot run here is no failure, but it has to be seen.
skip() {
    echo "SKIPPED: the checks with virtual cameras: $1"
    echo '0 passed, 0 failed, 1 skipped'
    exit 0
}

fail() {
    echo "FAIL $1"
    echo '0 passed, 1 failed'
    exit 1
}

list_needs() {
    missing=''
    need qemu-system-x86 has qemu-system-x86_64
    need busybox-static has busybox
    need cpio has cpio
    need kmod has depmod
    need xz-utils has xz
    need gcc has gcc
    need libc6-dev has_header stdlib.h
    need binutils has strip
    need make has make
    if [ -z "$programs" ]; then
        need cmake has cmake
        need python3 has python3
    fi
}

need_programs() {
    [ "$(uname -s)-$(uname -m)" = Linux-x86_64 ] || skip 'they need Linux on x86-64'
    has apt-get >/dev/null && has apt-cache >/dev/null && has dpkg-deb >/dev/null ||
        skip "they need Debian's packages, and apt-get is not here"
    list_needs
    if [ "$missing" ]; then
        (install_missing "$out/install.log") || skip "these packages cannot be installed:$missing"
        list_needs
        [ -z "$missing" ] || skip "still missing after installing:$missing"
    fi
}

# The check programs and the command.
build_programs() {
    if [ -z "$programs" ]; then
        programs=$out/build
        echo "Building the programs (log: $out/build.log)"
        step "$out/configure.log" cmake -S "$root" -B "$programs" \
            -DPEL_BUILD_TESTS=ON -DPEL_BUILD_TOOLS=ON || fail 'configure'
        step "$out/build.log" cmake --build "$programs" --parallel "$jobs" \
            --target camera_check libcamera_check pel_command || fail 'build'
    fi
    camera_check=$programs/tests/camera/camera_check
    libcamera_check=$programs/tests/camera/libcamera_check
    pel=$programs/tools/pel
    for program in "$camera_check" "$libcamera_check" "$pel"; do
        [ -x "$program" ] || fail "there is no $program"
    done
}

# Scenes for the guest to play as a camera, and the blobs that their files give.
render_scenes() {
    cd "$out/programs/checks"
    for seed in 7 8 9; do
        "$pel" scene --seed $seed --noise 3 --classes scene.classes -o - |
            "$pel" convert --to YUYV - "$seed.yuv"
        "$pel" blobs -c scene.classes --raw YUYV 320x240 --csv "$seed.yuv" >"$seed.csv"
        [ "$(wc -l <"$seed.csv")" -gt 5 ] || fail "scene $seed has next to no blobs"
    done
    cd "$root"
}

pack_programs() {
    rm -rf "$out/programs"
    mkdir -p "$out/programs/bin" "$out/programs/checks"
    cp "$root/tests/camera/init" "$out/programs/"
    cp "$root/tests/camera/guest.sh" "$out/programs/checks/"
    add_program "$camera_check"
    add_program "$libcamera_check"
    add_program "$pel"
    # libcamera loads more than it is linked with: the image processing of each camera.
    library=$(ldd "$libcamera_check" | sed -n 's|.* => \(/.*libcamera\.so[^ ]*\) .*|\1|p')
    if [ "$library" ]; then
        library=$(dirname "$(readlink -f "$library")")
        for folder in "$library/libcamera" /usr/share/libcamera; do
            [ ! -d "$folder" ] || add_folder "$folder"
        done
    fi
    render_scenes
    pack "$out/programs" "$out/programs.cpio.gz"
    cat "$image/system.cpio.gz" "$out/programs.cpio.gz" >"$out/all.cpio.gz"
}

# boot ACCELERATOR SECONDS: runs the checks; their lines come out in results.txt.
boot() {
    rm -f "$out/results.txt" "$out/console.log"
    timeout "$2" qemu-system-x86_64 -accel "$1" -m 512 -smp 1 -nic none -display none -no-reboot \
        -kernel "$image/kernel" -initrd "$out/all.cpio.gz" \
        -append 'console=ttyS0 quiet panic=-1 mitigations=off' \
        -serial "file:$out/console.log" -serial "file:$out/results.txt" \
        </dev/null >"$out/qemu.log" 2>&1
}

# Whether the processor lends itself to virtual machines and this user may use it.
kvm_works() {
    [ -z "$software" ] && [ -r /dev/kvm ] && [ -w /dev/kvm ] && grep -qwE 'vmx|svm' /proc/cpuinfo
}

# Whether the machine that boots as process $1 comes up within half a minute.
comes_up() {
    tries=0
    while [ $tries -lt 30 ] && kill -0 "$1" 2>/dev/null; do
        if grep -q 'the machine is up' "$out/console.log" 2>/dev/null; then
            return 0
        fi
        sleep 1
        tries=$((tries + 1))
    done
    grep -q 'the machine is up' "$out/console.log" 2>/dev/null
}

# With the processor's help; without it where there is none, or where it turns out to be of no use.
boot_somehow() {
    if kvm_works; then
        boot kvm 240 &
        machine=$!
        if comes_up $machine; then
            wait $machine || true
            return
        fi
        kill $machine 2>/dev/null || true
        wait $machine || true
        echo '# no virtual machine with /dev/kvm: emulated instead'
    fi
    boot tcg 280 || true
}

# Prints what the checks said and the closing line. A machine that stopped early is a failure.
report() {
    tr -d '\r' <"$out/results.txt" >"$out/lines.txt" 2>/dev/null || : >"$out/lines.txt"
    if [ "$(tail -n 1 "$out/lines.txt")" != 'the checks are through' ]; then
        tail -n 15 "$out/console.log" "$out/qemu.log" 2>/dev/null || true
        echo 'FAIL machine: it ended before the checks were through' >>"$out/lines.txt"
    fi
    grep -v '^the checks are through$' "$out/lines.txt"
    awk '/^ok / { passed++ } /^FAIL / { failed++ } /^SKIPPED / { skipped++ }
        END {
            printf "%d passed, %d failed", passed, failed
            if (skipped > 0) {
                printf ", %d skipped", skipped
            }
            printf "\n"
            exit failed > 0 || passed == 0
        }' "$out/lines.txt"
}

need_programs
need_system || skip "their kernel could not be had from apt (log: $out/image.log)"
build_programs
pack_programs
boot_somehow
report
