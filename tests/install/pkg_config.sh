#!/usr/bin/env bash
# Builds and runs an example against an installation: pkg_config.sh PREFIX COMPILER SOURCE
set -euo pipefail
file=$(find "$1" -name poise.pc)
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
read -ra flags < <(PKG_CONFIG_PATH=$(dirname "$file") pkg-config --cflags --libs poise)
"$2" -std=c++20 "$3" "${flags[@]}" -o "$dir/consumer"
"$dir/consumer"
