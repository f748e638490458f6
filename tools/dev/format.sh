#!/bin/sh
# Formatting is decided by .clang-format:  format.sh checks, format.sh --fix mends.
#     format.sh [--fix] [FILE...]      all C and C++ files of the project if none is named
set -eu

cd "$(dirname "$0")/../.."
fix=''
if [ "${1:-}" = --fix ]; then
    fix=yes
    shift
fi

# Releases of clang-format differ in detail; one has to be the judge.
formatter=''
for candidate in clang-format-14 clang-format; do
    if "$candidate" --version 2>/dev/null | grep -q 'version 14\.'; then
        formatter=$candidate
        break
    fi
done
if [ -z "$formatter" ]; then
    echo "clang-format 14 is not here: nothing was checked"
    echo "0 passed, 0 failed, 1 skipped"
    exit 0
fi

if [ $# -eq 0 ]; then
    set -- $(find lib ports tests tools \( -name '*.c' -o -name '*.h' -o -name '*.cpp' \) \
        2>/dev/null | sort)
fi

passed=0
failed=0
for file in "$@"; do
    if [ "$fix" ]; then
        "$formatter" -i "$file"
    fi
    if "$formatter" "$file" | cmp -s "$file" -; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        echo "$file: not formatted; sh tools/dev/format.sh --fix $file"
    fi
done
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ] && [ "$passed" -gt 0 ]
