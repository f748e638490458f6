#!/bin/sh
# Builds everything and runs every test:  sh tools/test.sh [--quick]
# Installs what is missing (Debian). Works in build/; the last line says how it went.
set -eu

quick=''
for argument in "$@"; do
    case $argument in
    --quick) quick=yes ;;
    *)
        echo "usage: sh tools/test.sh [--quick]" >&2
        echo "  --quick   about two minutes: without the long tests and the sanitizers" >&2
        exit 2
        ;;
    esac
done

root=$(cd "$(dirname "$0")/.." && pwd)
build=$root/build
logs=$build/logs
mkdir -p "$logs"
cd "$root"
. tools/dev/need.sh

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
need gcc-arm-none-eabi has arm-none-eabi-gcc
need gcc-riscv64-unknown-elf has riscv64-unknown-elf-gcc
need opencv-doc test -d /usr/share/doc/opencv-doc
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

exec "$python" tools/dev/summary.py $summary
