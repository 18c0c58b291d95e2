#!/usr/bin/env bash
# Whether the make.py of a folder makes the files that are there: made.sh meshes|motions
set -euo pipefail
here=$(dirname "$(realpath "$0")")/$1
made=$(mktemp -d)
trap 'rm -rf "$made"' EXIT
/usr/bin/python3 "$here/make.py" "$made"
for file in "$here"/*; do
  [ "${file##*/}" = make.py ] || diff -q "$file" "$made/${file##*/}"
done
