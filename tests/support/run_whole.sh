#!/bin/sh
# A program of tests as one test: run_whole.sh PROGRAM FILE writes what it prints to FILE, too. Exit code 77: a case was skipped,
# and none failed.
"$1" >"$2" 2>&1
status=$?
cat "$2"
if [ "$status" -eq 0 ] && grep -q '^\[  SKIPPED \]' "$2"; then exit 77; fi
exit "$status"
