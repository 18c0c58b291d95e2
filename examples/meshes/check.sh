#!/usr/bin/env bash
# Whether make.py makes the meshes that are here.
set -euo pipefail
here=$(dirname "$(realpath "$0")")
made=$(mktemp -d)
trap 'rm -rf "$made"' EXIT
/usr/bin/python3 "$here/make.py" "$made"
for mesh in "$here"/*.obj; do
  diff -q "$mesh" "$made/$(basename "$mesh")"
done
