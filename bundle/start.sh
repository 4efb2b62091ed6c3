#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Starts a program of a bundle (./splash bundle) on whatever Linux: each name in the bundle's bin/ is
# a link to this. With bash and coreutils alone it decides
# - whose C library to take: the host's where it is as new as the bundle's, since drivers may ask
#   for it; else the bundle's, with the loader that belongs to it;
# - of every other library the newer one, for the same reason;
# - which OpenCL drivers there are, for the loader libOpenCL.so.1, which reads a folder of names.
# SPLASH_START=show prints what it would do. SPLASH_HOST is put before the paths that are looked at
# on the host (tests).
set -euo pipefail

name=$(basename -- "$0")
self=$(readlink -f -- "${BASH_SOURCE[0]}")
root=$(dirname -- "$(dirname -- "$self")")
host=${SPLASH_HOST:-}
readonly name root host
readonly kLoader=ld-linux-x86-64.so.2
# Where libraries lie on Debian, Red Hat and Arch, on NixOS, in containers and under WSL.
readonly kFolders=("$host"/{usr/,}lib/x86_64-linux-gnu "$host"/{usr/,}lib64 "$host"/{usr/local/,usr/,}lib)
readonly kDriverFolders=("$host"/usr/lib/x86_64-linux-gnu/{nvidia/current,intel-opencl,amdgpu-pro}
  "$host"/usr/local/nvidia/lib{64,} "$host"/usr/lib/wsl/lib "$host"/run/opengl-driver/lib
  "$host"/opt/rocm*/lib "$host"/opt/rocm*/opencl/lib "$host"/opt/amdgpu*/lib/x86_64-linux-gnu
  "$host"/opt/intel/oneapi/compiler/latest/lib "$host"/usr/local/lib/x86_64-linux-gnu)
# Of NVIDIA, AMD (ROCm), Intel (GPUs, CPUs), Mesa and PoCL.
readonly kDrivers=(libnvidia-opencl.so.1 libamdocl64.so libigdrcl.so libintelocl.so libRusticlOpenCL.so.1
  libMesaOpenCL.so.1 libpocl.so.2)

fail() { printf '%s: %s\n' "$name" "$1" >&2; exit 69; }

# Whether version $1 is before $2: numbers with dots between.
is_before() {
  local a b k
  IFS=. read -ra a <<<"$1"
  IFS=. read -ra b <<<"$2"
  for ((k = 0; k < ${#a[@]} || k < ${#b[@]}; ++k)); do
    ((10#${a[k]:-0} == 10#${b[k]:-0})) || { ((10#${a[k]:-0} < 10#${b[k]:-0})); return; }
  done
  return 1
}

# libstdc++.so.6.0.30 -> 6.0.30, libgcc_s.so.1 -> 1; none: 0.
version_of() {
  local text=${1##*/}
  text=${text##*.so}
  text=${text#.}
  [[ $text =~ ^[0-9]+(\.[0-9]+)*$ ]] || text=0
  printf '%s' "$text"
}

# The first file of that name in the host's folders, then in those that the host's loader keeps a
# list of; nothing: there is none.
on_host() {
  local folder
  for folder in "${kFolders[@]}"; do
    [[ ! -e $folder/$1 ]] || { printf '%s' "$folder/$1"; return; }
  done
  [[ $listed =~ $'\t'"$1 (libc6,x86-64"[^$'\n']*' => '([^$'\n']+) ]] && printf '%s' "${BASH_REMATCH[1]}"
  return 0
}

# --- The C library ----------------------------------------------------------------------------

# Of glibc, as it says itself; 0: there is none.
host_glibc() {
  local loader=$host/lib64/$kLoader library said
  library=$(on_host libc.so.6)
  [[ -x $loader && -n $library ]] || { printf 0; return; }
  said=$("$loader" "$library" 2>/dev/null || true)
  [[ $said =~ 'release version '([0-9]+\.[0-9]+) ]] && printf '%s' "${BASH_REMATCH[1]}" || printf 0
}

choose_c_library() {
  local own found
  own=$(<"$root/lib/glibc/version")
  found=$(host_glibc)
  if is_before "$found" "$own"; then
    loader=$root/lib/glibc/$kLoader
    path=$root/lib/glibc
    c_library="the bundle's C library, $own: the host's is $found"
    [[ $found != 0 ]] || c_library="the bundle's C library, $own: the host has no glibc"
  else
    loader=$host/lib64/$kLoader
    path=
    c_library="the host's C library, $found: the bundle's is $own"
  fi
}

# --- The other libraries ----------------------------------------------------------------------

# The host's are taken by leaving the bundle's out of a folder of links.
choose_libraries() {
  local file theirs left_out=() kept=() gcc=
  for file in "$root"/lib/*.so*; do
    theirs=$(on_host "${file##*/}")
    if [[ -n $theirs ]] && is_before "$(version_of "$(readlink -f -- "$file")")" \
        "$(version_of "$(readlink -f -- "$theirs")")"; then
      left_out+=("${file##*/}")
    else
      kept+=("$file")
    fi
  done
  # What belongs to the compiler has no version in its name: it goes with the C++ library.
  if [[ " ${left_out[*]} " == *" libstdc++.so.6 "* ]]; then
    gcc=1
    left_out+=(libgcc_s.so.1 libgomp.so.1)
  fi
  libraries=${left_out[*]}
  folder=$root/lib
  ((${#left_out[@]} == 0)) || {
    theirs=()
    for file in "${kept[@]}"; do
      [[ -n $gcc && $file == */lib@(gcc_s|gomp).so.1 ]] || theirs+=("$file")
    done
    folder=$(kept_folder lib link "${theirs[@]}")
  }
  path+=${path:+:}$folder
}

# A folder of links to the files named, or with a line each in a file of its own: made once, kept for
# the next start. Who comes meanwhile finds it whole or not at all.
kept_folder() {  # what, link|write, files
  local what=$1 how=$2 key place new file
  shift 2
  key=$(printf '%s\n' "$@" | cksum)
  for place in "${XDG_CACHE_HOME:-${HOME:-/nonexistent}/.cache}/splash" "${TMPDIR:-/tmp}/splash-$EUID"; do
    (umask 077; mkdir -p -- "$place") 2>/dev/null && [[ -O $place && -w $place ]] || continue
    place+=/bundle-$what-${key%% *}
    if [[ ! -d $place ]]; then
      new=$(mktemp -d -- "$place.XXXXXX")
      if [[ $how == link ]]; then
        ln -s -- "$@" "$new/"
      else
        for file in "$@"; do printf '%s\n' "$file" >"$new/${file##*/}.icd"; done
      fi
      mv -T -- "$new" "$place" 2>/dev/null || rm -rf -- "$new"
    fi
    printf '%s' "$place"
    return
  done
  fail "there is no folder to write to: set XDG_CACHE_HOME or TMPDIR"
}

# --- OpenCL drivers ---------------------------------------------------------------------------

# Those that the host's /etc names, those that lie in usual places without a word in /etc, and the
# bundle's PoCL, if it has one and the host none: two in one process do not get on.
choose_drivers() {
  local file library found=() names=' '
  for file in "$host"/etc/OpenCL/vendors/*.icd; do
    [[ -r $file ]] || continue
    library=
    read -r library <"$file" || true
    [[ -z $library ]] || { found+=("$library"); names+="${library##*/} "; }
  done
  for library in "${kDrivers[@]}"; do
    [[ $names != *" ${library%%.so*}."* && $names != *" ${library%%.so*}-"* ]] || continue
    file=$(driver_file "$library")
    [[ -z $file ]] || { found+=("$file"); names+="$library "; path_end+=:${file%/*}; }
  done
  if [[ $names != *' libpocl'* && -e $root/lib/pocl/libpocl.so.2 ]]; then
    found+=("$root/lib/pocl/libpocl.so.2")
    path_end+=:$root/lib/pocl
    export PATH=$PATH:$root/lib/pocl/bin  # a linker, if the host has none
  fi
  drivers=${found[*]}
  ((${#found[@]} == 0)) || OCL_ICD_VENDORS=$(kept_folder drivers write "${found[@]}")
  ((${#found[@]} == 0)) || export OCL_ICD_VENDORS
}

driver_file() {  # library
  local folder found
  found=$(on_host "$1")
  [[ -z $found ]] || { printf '%s' "$found"; return; }
  for folder in "${kDriverFolders[@]}"; do
    [[ ! -e $folder/$1 ]] || { printf '%s' "$folder/$1"; return; }
  done
}

# ----------------------------------------------------------------------------------------------

main() {
  local loader path path_end='' folder libraries drivers="as \$OCL_ICD_VENDORS says" c_library listed=
  local program=$root/lib/programs/$name
  [[ $root != *:* ]] || fail "a colon parts names of folders: move $root to a place without one"
  [[ -x $program ]] || fail "$root is not whole: $program is missing; unpack the bundle anew"
  [[ -n $host ]] || listed=$(ldconfig -p 2>/dev/null || /sbin/ldconfig -p 2>/dev/null || true)
  choose_c_library
  choose_libraries
  [[ -n ${OCL_ICD_VENDORS:-} ]] || choose_drivers
  path+=${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}$path_end
  export SPLASH_PROGRAM=$root/bin/$name SPLASH_SOURCE_DIR=$root/share/splash
  if [[ ${SPLASH_START:-} == show ]]; then
    printf '%s\n' "$c_library" "the host's libraries, which are newer: ${libraries:-none}" \
      "OpenCL drivers: ${drivers:-none}" "$loader --library-path $path $program"
    return
  fi
  exec "$loader" --argv0 "$SPLASH_PROGRAM" --library-path "$path" "$program" "$@"
}

main "$@"
