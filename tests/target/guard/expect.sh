#!/bin/sh
# Runs a command that is to end with a certain status, having said a certain thing.
#     expect.sh STATUS TEXT COMMAND [ARGUMENT...]
expected=$1
text=$2
shift 2
output=$("$@" 2>&1)
status=$?
printf '%s\n' "$output" | sed 's/^/| /'
if [ "$status" -ne "$expected" ]; then
    echo "ended with status $status, not $expected"
elif ! printf '%s\n' "$output" | grep -qF -- "$text"; then
    echo "did not say: $text"
else
    echo '1 passed, 0 failed'
    exit 0
fi
echo '0 passed, 1 failed'
exit 1
