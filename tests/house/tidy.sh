#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# clang-tidy over every translation unit of the product; with SPLASH_TIDY_ALL set, of its tests, too. The static analyzer,
# which takes nearly as long as all other checks, is among them with a third argument, analyzer; with SPLASH_TIDY_ALL it
# follows calls from one function into others (several times as long).
# Reading the system headers takes most of the time, so units of the product are joined into one and
# read together, with the options of all: they differ only in definitions and folders that others have
# no use for. If clang-tidy finds fault with those, each is read alone. A unit found clean is not read
# again until it, a header of ours or the rules change. Arguments: the source tree, the build folder.
set -euo pipefail
cd "$1"
build=$2
clean=$build/tidy-clean
joined=$build/tidy-joined${3:+-$3}
readonly kMost=32  # units read together
rm -rf "$joined"
mkdir -p "$clean" "$joined"
commands=$build/separate.json
awk -f tests/house/separate_units.awk "$build/compile_commands.json" >"$commands"

extra=--extra-arg=-Wno-unknown-warning-option
checks=-readability-duplicate-include  # seen below, in less time
[[ ${3:-} == analyzer ]] || checks+=,-clang-analyzer-*
if [[ -z ${SPLASH_TIDY_ALL:-} ]]; then  # following calls is half of all time
  for word in -Xclang -analyzer-config -Xclang mode=shallow; do extra+=" --extra-arg=$word"; done
fi

rules=$(clang-tidy --version
  echo "$extra $checks"
  cat .clang-tidy tests/.clang-tidy
  find program protocol sim-server synth-server pd-patches tests \
    \( -name '*.hpp' -o -name '*.def' -o -name '*.h' \) \
    -exec cat {} +)
rules=$(sha256sum <<<"$rules")

units=$(paste -d'\t' \
  <(sed -n 's/^ *"file": "\(.*\)",\{0,1\}$/\1/p' "$commands") \
  <(sed -n 's/^ *"command": "[^ ]*\( [^ ]*c++\)\{0,1\} \(.*\) -o [^ ]* -c .*/\2/p' \
      "$commands" | sed 's/ -O[0-3]//g; s/ -Werror//g') |
  grep -F "$1/" | grep -vF "$build/" | grep -v "^$1/${SPLASH_TIDY_ALL-tests}/" | sort -u -k1,1 |
  awk -F'\t' -v tests="$1/tests/" '
    { source[NR] = $1; options[NR] = $2 }
    index($1, tests) != 1 {
      gsub(/-isystem /, "-isystem", $2)
      count = split($2, words, " ")
      for (i = 1; i <= count; ++i) if (!seen[words[i]]++) all = all words[i] " "
    }
    END {
      for (i = 1; i <= NR; ++i) print source[i] "\t" (index(source[i], tests) == 1 ? options[i] : all)
    }')
[[ -n $units ]] || { echo "no sources of $1 in $commands" >&2; exit 1; }

key_of() {  # options, source: the mark that the unit is clean
  local digest
  digest=$({ echo "$rules"; echo "$@"; cat "$2"; } | sha256sum)
  printf '%s/%s' "$clean" "${digest%% *}"
}

unquoted() {  # options as JSON has them: a shell's \" within them is a quote
  sed 's/\\\\\\"/"/g; s/\\"/"/g' <<<"$1"
}

read_alone() {  # options, source: silent when clean
  local output words
  read -ra words <<<"$(unquoted "$1")"  # one of its commands: tests may compile it, too
  # shellcheck disable=SC2086
  if output=$(clang-tidy --quiet --checks="$checks" $extra "$2" -- "${words[@]}" 2>&1); then
    touch "$(key_of "$@")"
  else
    printf '%s\n' "$output" | grep -v 'warnings generated\|^Suppressed\|^Use -header-filter' || true
    return 1
  fi
}

# Units read as one text; what each includes again is no duplicate.
read_together() {  # options, sources
  local options=$1 words source text failed=0
  read -ra words <<<"$(unquoted "$options")"
  shift
  text=$(mktemp "$joined/XXXXXX.cpp")
  for source in "$@"; do printf '#line 1 "%s"\n%s\n' "$source" "$(<"$source")"; done >"$text"
  # shellcheck disable=SC2086
  if (($# > 1)) && clang-tidy --quiet --config-file=.clang-tidy \
      --checks="$checks" $extra \
      "$text" -- "${words[@]}" &>"$text.log"; then
    for source in "$@"; do touch "$(key_of "$options" "$source")"; done
  else
    for source in "$@"; do read_alone "$options" "$source" || failed=1; done
  fi
  return "$failed"
}
export -f key_of unquoted read_alone read_together
export build clean joined rules extra checks

# Tests, which have rules of their own, are read one by one.
join_units() {
  awk -F'\t' -v tests="$PWD/tests/" -v join="awk -v most=$kMost -f tests/house/join_units.awk" '
    index($1, tests) == 1 { print $2 "\t" $1; next }
    { print | join }'
}

fresh=$(while IFS=$'\t' read -r source options; do
  [[ -e $(key_of "$options" "$source") ]] || printf '%s\t%s\n' "$source" "$options"
done <<<"$units")
# Each group runs in a shell of its own, one per core.
# shellcheck disable=SC2016  # the inner shell expands it
[[ -z $fresh ]] || join_units <<<"$fresh" | tr '\n' '\0' | xargs -0 -P "$(nproc)" -n 1 bash -c '
  IFS=$'"'\t'"' read -ra words <<<"$1"; read_together "${words[@]}"' _

repeated=$(cut -f1 <<<"$units" | while read -r source; do
  sed -n "s|^#include.*|$source: & a second time|p" "$source" | sort | uniq -d
done)
[[ -z $repeated ]] || { printf '%s\n' "$repeated"; exit 1; }
wc -l <<<"$units" | sed 's/$/ translation units/'
