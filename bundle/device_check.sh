#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Holds an OpenCL device against references with the whole program, and measures it: what a bundle
# (./splash bundle) is for on a machine with a GPU. Needs bash and coreutils. --help
set -euo pipefail
export LC_ALL=C

bin=$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")
readonly bin
readonly kLeast=10      # a part is not begun with less time left than this [s]
readonly kEvery=30      # between two lines on a part that takes long [s]
readonly kMostParticles=16000000

# name | its share of the time that is left, beside the others that are left | what is held or measured
readonly kParts="
self-test  |  30 | densities and accelerations of a cube against sums in double precision, twice the same bits
programs   |  40 | two seconds of the basin by sim-server, and the sound of its events by synth-server
kernels    | 160 | kernels of water, bodies and detectors against sums by brute force in double precision
validation | 110 | twelve published cases and closed forms, each at one resolution
scenes     | 110 | each built-in scene twice: the real-time factor; both runs end in the same bits
determinism | 30 | the same seed gives the same events and bits, kernels of all widths the same water
faults     |  60 | faults put into the water are seen, never told, and mended
yardstick  |  30 | the two main kernels beside C++ by hand on this machine's processor: the same sums
size       |  80 | time of a step from 2,000 to 16 million particles, as memory and time allow
stages     |  50 | launches, bytes and arithmetic of each kernel against what the device can do
"

say() { printf '%s\n' "$*"; }
fail() { printf 'splash-device-check: %s\n' "$2" >&2; exit "$1"; }

usage() {
  cat <<'TEXT'
splash-device-check [OPTIONS]: holds an OpenCL device against references and measures it.

  --device N|NAME|gpu|cpu  which device; sim-server --list-devices counts them (default: a GPU, else what
                           there is)
  --scalar                 the kernels that GPUs get, on any device
  --minutes M              time for all of it; what does not fit is left out and named (default: 10)
  --part NAME              only this part (repeatable)
  --out DIR                where the report is left (default: splash-device-report)
  -h, --help               this text

Ends with 0 if all was held, 1 if something was not, 2 if time was too short for some of it.

TEXT
  parts_of ''
}

parts_of() {  # name or ''; lines "  name   what"
  local name share what
  while IFS='|' read -r name share what; do
    name=${name// /}
    [[ -z $name || ( -n $1 && $1 != "$name" ) ]] || printf '  %-12s%s\n' "$name" "$what"
  done <<<"$kParts"
}

# --- Running a part ---------------------------------------------------------------------------

left() { printf '%s' $((end - $(date +%s))); }
clock() { printf '%d:%02d' $(($1 / 60)) $(($1 % 60)); }

# Runs a command for so many seconds at most, says now and then how far it is: 0, its own code, or 124.
attend() {  # seconds, log, command
  local most=$1 log=$2 pid now began shown code=0 line
  shift 2
  timeout --kill-after=5 "$most" "$@" >>"$log" 2>&1 </dev/null &
  pid=$!
  began=$(date +%s) shown=$began
  while kill -0 "$pid" 2>/dev/null; do
    sleep 0.2
    now=$(date +%s)
    ((now - shown >= kEvery)) || continue
    shown=$now
    line=$(tail -n 1 -- "$log")
    say "          $(clock $((now - began))) ${line:0:90}"
  done
  wait "$pid" || code=$?
  return "$code"
}

# Held, FAILED (with the code) or cut off.
verdict() {  # code
  case $1 in
    0) printf held ;;
    124 | 137) printf 'cut off' ;;
    *) printf 'FAILED (%s)' "$1" ;;
  esac
}

note() {  # part, verdict, seconds, words
  verdicts+=("$1|$2|$3|$4")
  printf '%s,%s,%s\n' "$1" "$2" "$3" >>"$out/checks.csv"
  say "          $2 after $(clock "$3")${4:+: $4}"
}

is_wanted() { ((${#wanted[@]} == 0)) || [[ " ${wanted[*]} " == *" $1 "* ]]; }

# What a part does not use is the others'.
run_part() {  # name, share, what
  local name=$1 what=$3 most began code=0 words=''
  most=$(($(left) * $2 / shares))
  shares=$((shares - $2))
  say "$(printf '%6s' "$(clock $(($(date +%s) - start)))")    $name: $what"
  if (($(left) < kLeast)); then
    note "$name" skipped 0 "the $minutes minutes are over"
    return
  fi
  ((most >= kLeast)) || most=$kLeast
  ((most <= $(left))) || most=$(left)
  began=$(date +%s)
  : >"$out/$name.log"  # of another run
  "part_${name//-/_}" "$most" "$out/$name.log" || code=$?
  note "$name" "$(verdict "$code")" $(($(date +%s) - began)) "$words"
}

# GoogleTest programs, one after the other: the worst code, and how many tests passed in `words`.
run_tests() {  # seconds, log, then program:filter
  local until=$(($(date +%s) + $1)) log=$2 test worst=0 code text passed=0 failed=()
  shift 2
  for test in "$@"; do
    code=124
    (($(date +%s) >= until)) || {
      code=0
      attend $((until - $(date +%s))) "$log" "$bin/${test%%:*}" "--gtest_filter=${test#*:}" || code=$?
    }
    # What fails weighs more than what was cut off.
    ((code == 0)) || [[ $worst != 0 && $code == 124 ]] || worst=$code
  done
  while IFS= read -r text; do
    case $text in
      '[       OK ] '*) passed=$((passed + 1)) ;;
      '[  FAILED  ] '*' ms)') failed+=("${text#'[  FAILED  ] '}") ;;
    esac
  done <"$log"
  words="$passed tests passed"
  ((${#failed[@]} == 0)) || { words+=", ${#failed[@]} failed: ${failed[*]}"; [[ $worst != 0 && $worst != 124 ]] || worst=1; }
  return "$worst"
}

# --- The parts: seconds, log ------------------------------------------------------------------

part_self_test() { attend "$1" "$2" "$bin/sim-server" --check-device "$device"; }

part_programs() {
  local until=$(($(date +%s) + $1))
  attend "$1" "$2" "$bin/sim-server" --scene basin --duration 2 --listen 127.0.0.1:0 --device "$device" \
    --record "$out/basin.osc" --report "$out/basin.json" || return
  attend $((until - $(date +%s) + 1)) "$2" "$bin/synth-server" --rig stereo --replay "$out/basin.osc" \
    --render "$out/basin.wav"
}

# Of the widths that kernels can be built for, the one that this device gets.
part_kernels() {
  local others='*8_lanes*'
  if [[ -z $scalar && $device_line == *'(CPU'* ]]; then others+=':*/1_lanes*'; else others+=':*16_lanes*'; fi
  run_tests "$1" "$2" "sim_fluid_test:NeighbourGrids.*:*Density*:*Acceleration*:*Reference*:*FluidStatsOf*:*KeepOut*\
:*HealthOf*:*Integrate*:*EitherSolver*:*Stretched*-$others" "sim_detect_test:*-$others" \
    "sim_free_bodies_test:*Films*:*Momentum*:*SpheresPart*:*DoTheSame*-$others" 'sim_gauge_test:*'
}

part_validation() { run_tests "$1" "$2" 'validation:*'; }

part_scenes() { attend "$1" "$2" "$bin/bench-scenes" --seconds 1 --runs 2 --out "$out/scenes"; }

part_determinism() { run_tests "$1" "$2" 'stress_test:*Repeats.*'; }

part_faults() { run_tests "$1" "$2" 'stress_test:*Faults.*'; }

part_yardstick() {
  mkdir -p "$out/yardstick"
  attend "$1" "$2" "$bin/bench-fluid" --part kernels --most-particles 60000 --out "$out/yardstick"
}

# What is measured up to the end of its time is worth as much as what comes after.
part_size() {
  local code=0
  mkdir -p "$out/size"
  begin_energy
  attend $(($1 + kLeast)) "$2" "$bin/bench-fluid" --part size --most-particles "$kMostParticles" --seconds "$1" \
    --out "$out/size" || code=$?
  end_energy
  return "$code"
}

part_stages() {
  mkdir -p "$out/stages"
  attend "$1" "$2" "$bin/bench-fluid" --part stages --part pool --part limits --most-particles 4000000 \
    --seconds $(($1 / 3)) --out "$out/stages"
}

# --- Energy, if the driver tells --------------------------------------------------------------

readonly kMeter=/sys/class/powercap/intel-rapl:0/energy_uj  # of the processor, where root may read it
sampler='' before='' since=''

begin_energy() {
  if command -v nvidia-smi >/dev/null && [[ $device_line == *NVIDIA* ]]; then
    nvidia-smi --query-gpu=timestamp,name,power.draw,clocks.sm,temperature.gpu,utilization.gpu \
      --format=csv -lms 500 >"$out/power.csv" 2>/dev/null </dev/null &
    sampler=$!
  elif [[ -r $kMeter && $device_line == *'(CPU'* ]]; then
    before=$(<"$kMeter") since=$(date +%s%N)
  fi
}

end_energy() {
  local line watts sum=0 count=0 most=0 now
  energy="The driver does not tell what it takes."
  if [[ -n $sampler ]]; then
    kill "$sampler" 2>/dev/null || true
    wait "$sampler" 2>/dev/null || true
    while IFS= read -r line; do  # in mW, since bash has no fractions
      [[ $line =~ ,\ ([0-9]+)\.([0-9][0-9])\ W ]] || continue
      watts=$((10#${BASH_REMATCH[1]}${BASH_REMATCH[2]} * 10))
      sum=$((sum + watts)) count=$((count + 1))
      ((watts <= most)) || most=$watts
    done <"$out/power.csv"
    ((count == 0)) || energy="While steps of all sizes were timed, the GPU took $((sum / count / 1000)) W in the mean, \
$((most / 1000)) W at most (power.csv)."
  elif [[ -n $before ]]; then
    now=$(($(date +%s%N) - since))
    energy="While steps of all sizes were timed, the processor took $((($(<"$kMeter") - before) * 1000 / now)) W in the mean."
  fi
}

# --- The report -------------------------------------------------------------------------------

quoted() {  # heading, log
  [[ -s $2 ]] || return 0
  printf '\n## %s\n\n```\n' "$1"
  cat -- "$2"
  printf '```\n'
}

# Of the bundle itself: how large, and which libraries.
contents() {
  local top=${bin%/*} size file
  size=$(du -sm -- "$top")
  printf '\n## The bundle\n\n%s MB unpacked, of these packages:\n\n```\n' "${size%%[[:space:]]*}"
  for file in "$top"/share/libraries*.txt; do [[ ! -e $file ]] || cat -- "$file"; done
  printf '```\n'
}

processor() {
  local line
  while IFS= read -r line; do
    [[ $line != 'model name'* ]] || { printf '%s' "${line#*: }"; return; }
  done </proc/cpuinfo
}

write_report() {
  local row name said seconds words
  {
    printf '# %s\n\n' "$device_name"
    printf '%s\n' "Left by splash-device-check, $(TZ=UTC date '+%Y-%m-%d %H:%M UTC'), $minutes minutes, on $(processor), \
$(nproc) cores, Linux $(uname -r)." '' '```' "$device_line" "${scalar:+kernels: scalar, as GPUs get them}" "$starts" '```' ''
    printf '| part | verdict | time | |\n| --- | --- | --- | --- |\n'
    for row in "${verdicts[@]}"; do
      IFS='|' read -r name said seconds words <<<"$row"
      printf '| %s | %s | %s | %s |\n' "$name" "$said" "$(clock "$seconds")" "$words"
    done
    printf '\nWhat each part holds:\n\n```\n%s\n```\n' "$(parts_of '')"
    [[ -z $energy ]] || printf '\nEnergy: %s\n' "$energy"
    quoted "Devices" "$out/devices.log"
    for name in scenes size stages yardstick validation; do quoted "$name" "$out/$name.log"; done
    contents
    printf '\nEach part has its words in PART.log, tables are beside them as CSV.\n'
  } >"$out/report.md"
}

# ----------------------------------------------------------------------------------------------

choose_device() {  # fills device, device_line, device_name
  local list
  "$bin/sim-server" --list-devices >"$out/devices.log" 2>&1 || fail 69 "$(<"$out/devices.log")"
  say "Devices:"
  cat -- "$out/devices.log"
  if [[ -n $wish ]]; then
    list=$("$bin/sim-server" --list-devices --device "$wish" 2>&1) || fail 69 "${list##*sim-server: }"
  else
    list=$("$bin/sim-server" --list-devices --device gpu 2>/dev/null || cat -- "$out/devices.log")
  fi
  device_line=${list%%$'\n'*}
  device=${device_line%%:*}
  device_name=${device_line#*: }
  device_name=${device_name%% (*}
  [[ $device =~ ^[0-9]+$ ]] || fail 69 "no device can be read from: $list"
  export SPLASH_DEVICE=$device
}

parse() {
  while (($#)); do
    case $1 in
      -h | --help) usage; exit ;;
      --scalar) scalar=1 ;;
      --device | --minutes | --part | --out)
        (($# > 1)) || fail 64 "$1 needs a value; --help says which"
        case $1 in
          --device) wish=$2 ;;
          --minutes) minutes=$2 ;;
          --part) wanted+=("$2") ;;
          --out) out=$2 ;;
        esac
        shift ;;
      *) fail 64 "unknown option $1; --help lists them" ;;
    esac
    shift
  done
  [[ $minutes =~ ^[1-9][0-9]{0,3}$ ]] || fail 64 "--minutes $minutes: a whole number from 1 to 9999"
  local name
  for name in "${wanted[@]}"; do [[ -n $(parts_of "$name") ]] || fail 64 "--part $name: there is no such part; --help lists them"; done
}

main() {
  local wish='' scalar='' minutes=10 out=splash-device-report wanted=() verdicts=() energy=''
  local device device_line device_name start end starts name share what row shares=0 bad=0 missing=0
  parse "$@"
  mkdir -p -- "$out" || fail 74 "$out cannot be made"
  out=$(readlink -f -- "$out")
  say "part,verdict,seconds" >"$out/checks.csv"
  start=$(date +%s)
  end=$((start + 60 * minutes))
  trap 'kill $(jobs -p) 2>/dev/null; exit 130' INT TERM
  starts=$(SPLASH_START=show "$bin/sim-server")
  [[ -z $scalar ]] || export SPLASH_SCALAR=1
  choose_device
  say "Taken: $device_line"
  while IFS='|' read -r name share what; do
    ! is_wanted "${name// /}" || shares=$((shares + ${share:-0}))
  done <<<"$kParts"
  while IFS='|' read -r name share what; do
    [[ -z ${name// /} ]] || ! is_wanted "${name// /}" || run_part "${name// /}" "${share// /}" "${what# }"
  done <<<"$kParts"
  for row in "${verdicts[@]}"; do
    case $row in
      *'|FAILED'*) bad=1 ;;
      *'|skipped|'* | *'|cut off|'*) missing=1 ;;
    esac
  done
  write_report
  say "Report: $out/report.md"
  ((bad == 0)) || { say "Something was not held."; exit 1; }
  ((missing == 0)) || { say "All that was tried was held; time was too short for the rest."; exit 2; }
  say "All was held."
}

main "$@"
