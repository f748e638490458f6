#!/bin/sh
# Runs a Unity program and turns its summary into the closing line that all tests have.
#     unity_run.sh PROGRAM [ARGUMENT...]
output=$("$@" 2>&1)
status=$?
printf '%s\n' "$output"
printf '%s\n' "$output" | awk -v status="$status" '
    /^[0-9]+ Tests [0-9]+ Failures [0-9]+ Ignored/ {
        tests = $1; failed = $3; ignored = $5; seen = 1
    }
    END {
        if (!seen) {
            print "no summary: the program ended with status " status " before it was done"
            exit 1
        }
        passed = tests - failed - ignored
        if (status != 0 && failed == 0) {
            failed = 1
            print "the program ended with status " status
        }
        printf "%d passed, %d failed", passed, failed
        if (ignored > 0) {
            printf ", %d skipped", ignored
        }
        printf "\n"
        exit failed > 0 || passed == 0
    }'
