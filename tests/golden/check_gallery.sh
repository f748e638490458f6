#!/bin/sh
# The pictures of the operators in tools/demo, and the README's table of them, are what the command
# makes:  check_gallery.sh SOURCE_DIR, with PEL_COMMAND in the environment.
set -eu

source=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
passed=0
failed=0

check() {
    if "$@"; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        echo "wrong: $*"
    fi
}

same_picture() {
    "$PEL_COMMAND" convert "$1" "$work/a.ppm" && "$PEL_COMMAND" convert "$2" "$work/b.ppm" &&
        cmp "$work/a.ppm" "$work/b.ppm"
}

mkdir -p "$work/tools/demo"
cp "$source/README.md" "$work/README.md"
sh "$source/tools/dev/gallery.sh" "$work/tools/demo"
check cmp "$source/README.md" "$work/README.md"
check cmp "$source/tools/demo/operators.md" "$work/tools/demo/operators.md"
for picture in "$work"/tools/demo/operators/*.png; do
    check same_picture "$picture" "$source/tools/demo/operators/$(basename "$picture")"
done
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ] && [ "$passed" -gt 2 ]
