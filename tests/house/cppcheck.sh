#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# cppcheck over every translation unit of the product; what it says is an error. Suppressions stand
# in .cppcheck, each with its reason. Arguments: the source tree, the build folder.
set -euo pipefail
cd "$1"
build=$2
mkdir -p "$build/cppcheck"
commands=$build/cppcheck/separate.json
awk -f tests/house/separate_units.awk "$build/compile_commands.json" >"$commands"

# Not the tests: GoogleTest's macros are another language to it.
units=$(sed -n 's/^ *"file": "\(.*\)",\{0,1\}$/\1/p' "$commands" |
  grep -F "$1/" | grep -vF "$build/" | grep -vF "$1/tests/" | sort -u)
[[ -n $units ]] || { echo "no sources of $1 in $commands" >&2; exit 1; }
filters=()
while read -r unit; do filters+=(--file-filter="$unit"); done <<<"$units"

# The build folder keeps what was found in units that have not changed.
cppcheck --project="$commands" "${filters[@]}" \
  --cppcheck-build-dir="$build/cppcheck" -j "$(nproc)" --quiet \
  --enable=warning,performance,portability,style \
  --suppressions-list=.cppcheck --error-exitcode=1 \
  --template='{file}:{line}:{column}: {severity}: {message} [{id}]'
echo "$(wc -l <<<"$units") translation units"
