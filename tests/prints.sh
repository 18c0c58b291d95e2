#!/usr/bin/env bash
# Whether a command succeeds and prints what a file says: prints.sh FILE COMMAND...
set -euo pipefail
"${@:2}" | diff "$1" -
