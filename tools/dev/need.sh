# Sourced by demo.sh and test.sh: finds out what the machine lacks and installs it.

missing=''
jobs=$(getconf _NPROCESSORS_ONLN 2>/dev/null || echo 2) # for everybody who builds

# need PACKAGE COMMAND [ARGUMENT...]: the package is missing if the command fails.
need() {
    package=$1
    shift
    case "$missing " in
    *" $package "*) return ;;
    esac
    if ! "$@" >/dev/null 2>&1; then
        missing="$missing $package"
    fi
}

has() {
    command -v "$1"
}

# sanitizes COMPILER FILE: whether it can link the sanitizers' libraries; FILE is overwritten.
sanitizes() {
    echo 'int main(void) { return 0; }' |
        "$1" -fsanitize=address,undefined -x c - -o "$2" >/dev/null 2>&1
}

# say_unsanitized COMPILER: what is not tested then, in a line that nobody overlooks.
say_unsanitized() {
    echo "SKIPPED: $1 cannot link AddressSanitizer and UndefinedBehaviorSanitizer; the tests that" \
        "need them are left out or run without them. Install libasan and libubsan" \
        "(Debian: libgcc-N-dev, where N is the number in '$1 -dumpversion')."
}

has_header() {
    printf '#include <stdio.h>\n#include <%s>\n' "$1" | cc -E -
}

# Installs what `need` found missing, or says what to type and ends the script. $1: a log file.
install_missing() {
    if [ -z "$missing" ]; then
        return
    fi
    install_line="apt-get update && apt-get install -y --no-install-recommends$missing"
    as_root=''
    if ! has apt-get >/dev/null; then
        echo "Please install what these Debian packages hold:$missing" >&2
        exit 1
    elif [ "$(id -u)" -ne 0 ]; then
        as_root='sudo'
        if ! has sudo >/dev/null || { [ ! -t 0 ] && ! sudo -n true 2>/dev/null; }; then
            echo "Some packages are missing. As root, type:" >&2
            echo "    $install_line" >&2
            exit 1
        fi
    fi
    echo "Installing$missing (log: $1)"
    if ! $as_root sh -c "DEBIAN_FRONTEND=noninteractive; export DEBIAN_FRONTEND; $install_line" \
        </dev/null >"$1" 2>&1; then
        tail -n 20 "$1" >&2
        echo "Could not install$missing" >&2
        exit 1
    fi
}

# step LOG COMMAND...: runs a long command with its output in a file; shows its end if it fails.
step() {
    log=$1
    shift
    if "$@" >"$log" 2>&1; then
        return 0
    fi
    echo "failed: $*" >&2
    tail -n 30 "$log" >&2
    echo "the whole log: $log" >&2
    return 1
}
