#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The linker that a bundle's PoCL calls for each kernel it has compiled, on a host that need not have
# one, nor the C library's development files: libraries that are asked for by -l are the bundle's.
set -euo pipefail
root=$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")
root=${root%/lib/pocl/bin}
arguments=()
for argument in "$@"; do
  case $argument in
    -l* | -L*) ;;
    *) arguments+=("$argument") ;;
  esac
done
exec "$root/lib/glibc/ld-linux-x86-64.so.2" --library-path "$root/lib/glibc:$root/lib/pocl:$root/lib" \
  "$root/lib/programs/ld" "${arguments[@]}" "$root/lib/glibc/libm.so.6" "$root/lib/glibc/libc.so.6" \
  "$root/lib/libgcc_s.so.1"
