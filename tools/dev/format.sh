#!/bin/sh
# Formatting is decided by .clang-format:  format.sh checks, format.sh --fix mends. And no line of a
# source or script is longer than 100 columns, comments included, which clang-format lets pass.
#     format.sh [--fix] [FILE...]      all sources and scripts of the project if none is named
set -eu

cd "$(dirname "$0")/../.."
fix=''
if [ "${1:-}" = --fix ]; then
    fix=yes
    shift
fi

# Releases of clang-format differ in detail; one has to be the judge.
formatter=''
venv=$(dirname "${PEL_PYTHON:-build/venv/bin/python}") # has what tests/requirements.txt asks for
for candidate in "$venv/clang-format" clang-format-14 clang-format; do
    if "$candidate" --version 2>/dev/null | grep -q 'version 14\.'; then
        formatter=$candidate
        break
    fi
done
if [ -z "$formatter" ]; then
    echo "clang-format 14 is not here, only the lengths of lines are checked; to install it:"
    echo "    python3 -m pip install -r tests/requirements.txt"
fi

if [ $# -eq 0 ]; then
    set -- $(find lib ports tests tools \( -name '*.c' -o -name '*.h' -o -name '*.[ch]pp' \
        -o -name '*.py' -o -name '*.sh' \) 2>/dev/null | sort)
fi

is_formatted() {
    case $1 in
    *.c | *.h | *.[ch]pp) [ -z "$formatter" ] || "$formatter" "$1" | cmp -s "$1" - ;;
    esac
}

# Columns are characters, not bytes.
long_lines() {
    LC_ALL=C.UTF-8 grep -nE '^.{101,}' "$1" | cut -d : -f 1 | tr '\n' ' '
}

passed=0
failed=0
for file in "$@"; do
    case $fix$file in
    yes*.c | yes*.h | yes*.[ch]pp) [ -z "$formatter" ] || "$formatter" -i "$file" ;;
    esac
    good=yes
    if ! is_formatted "$file"; then
        good=''
        echo "$file: not formatted; sh tools/dev/format.sh --fix $file"
    fi
    long=$(long_lines "$file")
    if [ "$long" ]; then
        good=''
        echo "$file: longer than 100 columns: line $long"
    fi
    if [ "$good" ]; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
    fi
done
if [ "$formatter" ]; then
    echo "$passed passed, $failed failed"
else
    echo "$passed passed, $failed failed, 1 skipped"
fi
[ "$failed" -eq 0 ] && [ "$passed" -gt 0 ]
