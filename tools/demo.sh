#!/bin/sh
# Finds the coloured objects of a robot's picture:  sh tools/demo.sh [BUILD_DIR]
# Installs what is missing (Debian), builds the command `pel` in build/ (or BUILD_DIR) and runs it.
set -eu

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
install_missing "$build/logs/demo-install.log"

echo "Building pel (log: $build/logs/demo-build.log)"
step "$build/logs/demo-configure.log" cmake -S . -B "$build/demo" -DPEL_BUILD_TOOLS=ON \
    -DPEL_BUILD_TESTS=OFF || exit 1
step "$build/logs/demo-build.log" cmake --build "$build/demo" --parallel "$jobs" || exit 1

pel=$build/demo/tools/pel
out=$build/demo-out
echo
echo "pel blobs -c tools/demo/robot.classes --min-area 20 tools/demo/robot.ppm"
"$pel" blobs -c tools/demo/robot.classes --min-area 20 -o "$out/robot.ppm" tools/demo/robot.ppm
"$pel" blobs -c tools/demo/robot.classes --min-area 20 -o "$out/robot.png" tools/demo/robot.ppm \
    >/dev/null
echo
echo "The picture with boxes, centroids and axes:"
echo "    $out/robot.ppm"
echo "    $out/robot.png"
