#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Makes a bundle: programs of a build folder with the libraries that they need, scenes, references and
# licences, in one folder that may lie anywhere (start.sh). The same build gives the same bytes.
# Arguments: the build folder, the version, the tarball, and the programs. OUT.tar.xz, .gz, .zst or a
# bare .tar.
#   make.sh --pocl BUILD VERSION OUT
# makes a second tarball, to be unpacked over the first: PoCL, for hosts without an OpenCL driver.
set -euo pipefail
export LC_ALL=C

here=$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")
source=$(dirname -- "$here")
only_pocl=
[[ $1 != --pocl ]] || { only_pocl=1; shift; }
build=$1 version=$2 out=$3
shift 3
readonly here source only_pocl build version out
readonly kName=splash-$version-x86_64
# All of glibc that a driver may ask for: parts of two versions do not go together.
readonly kGlibc="ld-linux-x86-64.so.2 libc.so.6 libm.so.6 libmvec.so.1 libpthread.so.0 libdl.so.2 librt.so.1
  libresolv.so.2 libutil.so.1 libanl.so.1 libnss_dns.so.2 libnss_files.so.2 libBrokenLocale.so.1"
# What is compiled in without a library of its own.
readonly kCompiledIn="libcli11-dev nlohmann-json3-dev libboost1.[0-9]*[0-9]-dev librandom123-dev"

fail() { printf 'bundle: %s\n' "$1" >&2; exit "${2:-70}"; }

# Libraries that a file needs, one path a line; one that is missing is named.
needed() {  # files
  local said
  said=$(ldd "$@" 2>&1) || fail "ldd cannot read $*: $said"
  [[ $said != *"not found"* ]] || fail "a library is missing: $(grep -m1 'not found' <<<"$said")" 69
  awk '$2 == "=>" { print $3 }' <<<"$said" | sort -u
}

is_glibc() { [[ " ${kGlibc//$'\n'/ } " == *" $1 "* ]]; }

# With the link that programs ask for, and without what debuggers read.
take_library() {  # path, folder
  local file name=${1##*/}
  file=$(readlink -f -- "$1")
  mkdir -p "$2"
  strip --strip-unneeded -o "$2/${file##*/}" "$file"
  [[ ${file##*/} == "$name" ]] || ln -sf "${file##*/}" "$2/$name"
  taken+=("$1")
}

take_programs() {  # names
  local name
  mkdir -p "$top/bin" "$top/lib/programs"
  cp "$here/start.sh" "$top/lib/start"
  cp "$here/device_check.sh" "$top/bin/splash-device-check"
  for name in "$@"; do
    [[ -x $build/bin/$name ]] || fail "$build/bin/$name is not built" 66
    strip -o "$top/lib/programs/$name" "$build/bin/$name"
    ln -s ../lib/start "$top/bin/$name"
  done
}

take_libraries() {
  local file folder name
  for file in $(needed "$top"/lib/programs/*); do
    is_glibc "${file##*/}" || take_library "$file" "$top/lib"
  done
  folder=$(needed "$top"/lib/programs/* | grep -m1 '/libc\.so\.6$')
  folder=${folder%/*}
  for name in $kGlibc; do
    [[ ! -e $folder/$name ]] || take_library "$folder/$name" "$top/lib/glibc"
  done
  [[ $("$folder/libc.so.6") =~ 'release version '([0-9.]+[0-9]) ]] || fail "$folder/libc.so.6 is no glibc"
  printf '%s\n' "${BASH_REMATCH[1]}" >"$top/lib/glibc/version"
}

take_files() {
  mkdir -p "$top/share/splash/tests/validation"
  cp -r "$source/configs" "$top/share/splash/"
  cp -r "$source/tests/validation"/{scenes,reference} "$top/share/splash/tests/validation/"
  cp -r "$source/tests/data" "$top/share/splash/tests/"
  cp "$source/LICENSE" "$top/"
}

# PoCL looks for its own below ../../share and beside itself. What links its kernels calls ld for the
# C library's development files, which a bare host lacks: ours takes the bundle's libraries instead.
take_pocl() {
  local library ld file share
  library=$(ldconfig -p | awk '$1 == "libpocl.so.2" { print $NF; exit }')
  [[ -n $library ]] || fail "there is no libpocl.so.2 here" 69
  ld=$(readlink -f -- "$(command -v ld.bfd)")
  share=$(readlink -f -- "${library%/*}/../../share/pocl")
  for file in "$library" $(needed "$library" "$ld"); do
    is_glibc "${file##*/}" || [[ $file == */lib@(stdc++|gcc_s).so.* ]] || take_library "$file" "$top/lib/pocl"
  done
  mkdir -p "$top/lib/pocl/pocl" "$top/lib/pocl/bin" "$top/lib/programs" "$top/share/pocl"
  for file in "${library%/*}"/pocl/libpocl-devices-*.so; do
    strip --strip-unneeded -o "$top/lib/pocl/pocl/${file##*/}" "$file"
  done
  strip -o "$top/lib/programs/ld" "$ld"
  taken+=("$ld")
  cp "$here/pocl_ld.sh" "$top/lib/pocl/bin/ld"
  cp -rL "$share/include" "$share"/*.bc "$top/share/pocl/"
}

# --- What it is made of -----------------------------------------------------------------------

package_of() {  # file -> Debian's package; nothing where dpkg does not know
  local file=$1
  dpkg -S "$file" 2>/dev/null | sed -n '1s/:.*//p' | grep . ||
    dpkg -S "/usr$file" 2>/dev/null | sed -n '1s/:.*//p'
}

licence_in() {  # copyright file -> the name of what holds for most files, if it is in Debian's format
  awk '/^Files: *\*$/ { all = 1 } all && sub(/^License: */, "") { print; exit }' "$1"
}

list_libraries() {  # the file to write
  local file package doc names
  mkdir -p "$top/share/licences"
  for file in "${taken[@]}"; do
    package=$(package_of "$file" || true)
    printf '%s %s\n' "${package:-unknown}" "${file##*/}"
  done | sort -u >"$stage/names"
  # shellcheck disable=SC2086  # a version may be any
  [[ -n $only_pocl ]] || for package in $kCompiledIn; do
    for doc in /usr/share/doc/$package; do
      [[ ! -d $doc ]] || printf '%s (compiled in)\n' "${doc##*/}" >>"$stage/names"
    done
  done
  {
    printf 'package | version | files | licence of most of it; all are in share/licences/PACKAGE\n'
    cut -d' ' -f1 "$stage/names" | sort -u | while read -r package; do
      doc=/usr/share/doc/$package/copyright
      names=$(sed -n "s/^$package //p" "$stage/names" | paste -sd' ')
      [[ ! -e $doc ]] || cp -L "$doc" "$top/share/licences/$package"
      # shellcheck disable=SC2016  # a field of dpkg's
      printf '%s | %s | %s | %s\n' "$package" \
        "$(dpkg-query -W -f='${Version}' "$package" 2>/dev/null | sed 's/amd64$//' || printf '?')" "$names" \
        "$([[ ! -e $doc ]] || licence_in "$doc")"
    done
  } >"$1"
}

write_readme() {
  cat >"$top/README.txt" <<TEXT
splash $version for Linux on x86-64: nothing is installed, this folder may lie anywhere.

  bin/splash-device-check          holds an OpenCL device against references and measures it, in ten
                                   minutes; leaves a report. --help
  bin/sim-server --list-devices    which devices there are
  bin/sim-server --scene pool --target HOST:57310
  bin/synth-server --rig stereo
  bin/view-server                  the water in a browser (sim-server --show 127.0.0.1:57301)
  bin/sim-server --help            and so on for each in bin/

It needs an OpenCL driver: NVIDIA's, AMD's, Intel's or PoCL, which are found without files in /etc too.
Where there is none, unpack $kName-pocl.tar.xz over this folder, if you have it.
SPLASH_START=show bin/sim-server says which C library, libraries and drivers a program gets here.

share/splash/configs/README.md   scenes and what may stand in them
share/libraries*.txt             the libraries within, their versions and licences
LICENSE                          that of splash itself
TEXT
}

main() {
  local stage top taken=()
  stage=$(mktemp -d)
  # shellcheck disable=SC2064  # as it is now
  trap "rm -rf -- '$stage'" EXIT
  top=$stage/$kName
  if [[ -n $only_pocl ]]; then
    take_pocl
    list_libraries "$top/share/libraries-pocl.txt"
  else
    take_programs "$@"
    take_libraries
    take_files
    list_libraries "$top/share/libraries.txt"
    write_readme
  fi
  find "$top" -type d -exec chmod 755 {} +
  find "$top" -type f -perm /111 -exec chmod 755 {} +
  find "$top" -type f ! -perm /111 -exec chmod 644 {} +
  mkdir -p "$(dirname -- "$out")"
  # One thread: with several, xz's blocks depend on the machine.
  XZ_OPT="-9 -T1" GZIP=-n tar --auto-compress -cf "$out" -C "$stage" --sort=name --mtime=@315532800 \
    --owner=0 --group=0 --numeric-owner --format=gnu "$kName" || fail "$out cannot be written" 74
}

main "$@"
