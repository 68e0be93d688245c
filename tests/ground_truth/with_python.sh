#!/bin/sh
# with_python.sh PYTHON SCRIPT ARGUMENT...: runs the script; 77 (skipped) without that Python.
[ -x "$1" ] || { echo "no $1: scripts/test makes it" >&2; exit 77; }
exec "$@"
