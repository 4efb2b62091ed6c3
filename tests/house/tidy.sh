#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# clang-tidy over every translation unit of the product; with SPLASH_TIDY_ALL set, of its tests, too
# (twice as long). A unit found clean is not read again until it, a header of ours or the rules
# change. Arguments: the source tree, the build folder.
set -euo pipefail
cd "$1"
build=$2
clean=$build/tidy-clean
mkdir -p "$clean"

rules=$(clang-tidy --version
  cat .clang-tidy tests/.clang-tidy "$build/compile_commands.json"
  find protocol sim-server synth-server pd-patches tests \( -name '*.hpp' -o -name '*.h' \) \
    -exec cat {} +)
rules=$(sha256sum <<<"$rules")

check() {  # one source: silent when clean
  local key output
  key=$clean/$({ echo "$rules"; echo "$1"; cat "$1"; } | sha256sum | cut -d' ' -f1)
  [[ ! -e $key ]] || return 0
  if output=$(clang-tidy --quiet --extra-arg=-Wno-unknown-warning-option -p "$build" "$1" 2>&1); then
    touch "$key"
  else
    printf '%s\n' "$output" | grep -v 'warnings generated\|^Suppressed\|^Use -header-filter' || true
    return 1
  fi
}
export -f check
export build clean rules

mapfile -t sources <<<"$(sed -n 's/^ *"file": "\(.*\)",\{0,1\}$/\1/p' "$build/compile_commands.json" |
  grep -F "$1/" | grep -vF "$build/" | grep -vF "$1/${SPLASH_TIDY_ALL-tests}/" | sort -u)"
[[ -n ${sources[0]} ]] || { echo "no sources of $1 in $build/compile_commands.json" >&2; exit 1; }
# shellcheck disable=SC2016  # the inner shell expands it
printf '%s\0' "${sources[@]}" | xargs -0 -P "$(nproc)" -n 1 bash -c 'check "$1"' _
echo "${#sources[@]} translation units"
