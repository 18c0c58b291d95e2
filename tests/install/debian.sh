#!/usr/bin/env bash
# Makes the Debian packages, unpacks them and uses them:
# debian.sh BUILD SOURCE COMPILER [PYTHON_DIR]
set -euo pipefail
build=$1 source=$2 compiler=$3 python_dir=${4:-}
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
(cd "$build" && cpack -G DEB -B "$dir/packages" > "$dir/log") || { cat "$dir/log"; exit 1; }

field() { dpkg-deb -f "$dir/packages/$1"_*.deb "$2"; }
unpack() { dpkg-deb -x "$dir/packages/$1"_*.deb "$dir/$1"; }

unpack poise
[[ $(field poise Depends) == *libyaml-cpp* ]]
[[ $("$dir/poise/usr/bin/poise" --version) == "poise $(field poise Version)" ]]
doc=$dir/poise/usr/share/doc/poise
"$dir/poise/usr/bin/poise" best "$doc/examples/l-part.yaml" > /dev/null
[[ $(field poise Depends) == *libembree* ]]  # of a module, which the program finds where it is
"$dir/poise/usr/bin/poise" hold "$doc/examples/mug-parallel-jaw.yaml" > /dev/null
[[ -s $doc/README.md && -s $doc/theory.md && -s $doc/pictures/dual.svg ]]
bash -c 'source "$1" && complete -p poise' - \
  "$dir/poise/usr/share/bash-completion/completions/poise" > /dev/null

unpack libpoise-dev
[[ $(field libpoise-dev Depends) == *libeigen3-dev* ]]
"$source/tests/install/pkg_config.sh" "$dir/libpoise-dev" "$compiler" \
  "$source/examples/cpp/01_hold.cpp" | diff "$source/examples/expected/01_hold.txt" -

[ -n "$python_dir" ] || exit 0
unpack python3-poise
[[ $(field python3-poise Depends) == *python3-numpy*python3* ]]
cd "$dir"
PYTHONPATH=$dir/python3-poise/usr/$python_dir /usr/bin/python3 "$source/examples/python/01_hold.py" |
  diff "$source/examples/expected/01_hold.txt" -
