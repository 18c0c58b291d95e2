#!/usr/bin/env bash
# What bash offers after the beginning of a command line: completion.sh COMPLETION PROGRAM
set -euo pipefail
source "$1"
program=$(realpath "$2")
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
cd "$dir"
mkdir parts
touch grasps.h5 grasps.jsonl disk.yaml disk.json notes.txt picture.svg 'two words.yml'

offered() {  # the words so far, the last one incomplete
  COMP_WORDS=("$@")
  COMP_CWORD=$(($# - 1))
  COMPREPLY=()
  _poise
  printf '%s\n' "${COMPREPLY[@]}" | sort | paste -sd ,
}

failures=0
expect() {  # offered words, then the command line
  local expected=$1 actual
  shift
  actual=$(offered "$@")
  [[ $actual == "$expected" ]] && return
  echo "after '$*' expected '$expected', offered '$actual'"
  failures=$((failures + 1))
}

expect batch,best,capacity,check,contacts,curve,draw,hold,import,motion,turn,verify,view poise ''
expect capacity,check,contacts,curve poise c
expect --help,--version poise --
expect disk.json,disk.yaml,parts,'two words.yml' poise best ''
expect disk.json,disk.yaml poise hold --angle 20 d
expect disk.json,disk.yaml poise --json hold d
expect 'two words.yml' poise hold two
expect disk.json poise verify disk.yaml disk.j
expect all,pinching-up poise best disk.yaml --domain ''
expect pinching-up poise curve --domain p
expect best,hold poise batch --what ''
expect grasps.h5,grasps.jsonl,parts poise batch ''
expect parts,picture.svg poise curve disk.yaml --plot ''
expect '' poise hold --angle ''
expect acronym poise import ''
expect grasps.h5,parts poise import acronym ''
expect parts poise import acronym grasps.h5 --mesh-root ''
expect '' poise nonsense ''
expect --angle poise hold disk.yaml --a

# Every flag that the program knows, and no other.
for command in '' check contacts hold best curve capacity draw verify batch view import; do
  known=$("$program" ${command:+"$command"} --help |
    sed -nE 's/^  (-[a-z],)?(--[a-z0-9-]+).*/\2/p' | sort | paste -sd ,)
  expect "$known" poise ${command:+"$command"} --
done
exit "$failures"
