#!/usr/bin/env bash
# Installs the module by pip into a new directory and uses it:
# pip.sh PYTHON SOURCE DIRECTORY COMPILER LAUNCHER
set -euo pipefail
python=$1 source=$2 dir=$3
export CXX=$4 CMAKE_CXX_COMPILER_LAUNCHER=$5 PIP_ROOT_USER_ACTION=ignore
rm -rf "$dir"
mkdir -p "$dir"
"$python" -m pip install --quiet --no-build-isolation --no-index --no-deps --target "$dir/installed" \
  "$source"
cd "$dir"
export PYTHONPATH=$dir/installed
"$python" -c "import poise; assert poise.__file__.startswith('$dir'), poise.__file__"
"$python" "$source/examples/python/01_hold.py" | diff "$source/examples/expected/01_hold.txt" -
