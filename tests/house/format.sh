#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Every source is laid out as .clang-format says; what is shared with OpenCL C keeps its own ways.
# Argument: the source tree.
set -euo pipefail
cd "$1"
mapfile -t sources <<<"$(find program protocol sim-server synth-server view-server pd-patches tests \
  -name '*.cpp' -o -name '*.hpp' -o -name '*.def' | sort)"
[[ -n ${sources[0]} ]] || { echo "no sources found in $1" >&2; exit 1; }
clang-format --dry-run -Werror "${sources[@]}" ||
  { echo "clang-format -i FILE lays a file out" >&2; exit 1; }
echo "${#sources[@]} files"
