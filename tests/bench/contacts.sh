#!/bin/bash
# contacts.sh [options] [CASE...]: the contact scenes in Poinsot and in the engines of Debian, in one
# run: installs what is missing, builds, runs all programs in turn, prints one table per case.
#   CASE           names of contact_cases.cpp, or accuracy, piles, all (default all)
#   --out DIR      for contacts.csv, .md and .svg (default build/bench/contacts)
#   --rounds N     costs are the least of N rounds (default 1)
#   --limit S      CPU time of a run [s] (default 60); a run cut there says how far it came
#   --defaults     each engine as it comes only, not its other settings
#   --ours "..."   options of bench_contacts, such as "--profile fast" or "--solver NAME --step S";
#                  may be given several times
#   --only NAME    one engine: poinsot bullet dart mujoco ode; may be given several times
#   --build DIR    a build that is there already, with POINSOT_BUILD_BENCH and POINSOT_BUILD_PEERS
# All engines run on one thread, without sleeping.
set -euo pipefail

root=$(dirname "$(dirname "$(dirname "$(realpath "$0")")")")
build= out= rounds=1 options=() cases=() ours=() engines=()
while [[ $# -gt 0 ]]; do
  case $1 in
    --out) out=$2 && shift 2 ;;
    --rounds) rounds=$2 && shift 2 ;;
    --limit) options+=(--limit "$2") && shift 2 ;;
    --defaults) options+=(--defaults) && shift ;;
    --ours) ours+=("$2") && shift 2 ;;
    --only) engines+=("$2") && shift 2 ;;
    --build) build=$2 && shift 2 ;;
    -*) echo "unknown option '$1'; see the head of $0" >&2 && exit 2 ;;
    *) cases+=("$1") && shift ;;
  esac
done
[[ ${#cases[@]} -gt 0 ]] || cases=(all)
[[ ${#engines[@]} -gt 0 ]] || engines=(poinsot bullet dart mujoco ode)
[[ ${#ours[@]} -gt 0 ]] || ours=("")
out=${out:-$root/build/bench/contacts}

if [[ -z $build ]]; then
  build=$root/build/bench
  "$root/docker/install_packages.sh" build test peers
  mkdir -p "$build"
  echo "Configuring $build" >&2
  cmake -S "$root" -B "$build" -G Ninja -DPOINSOT_BUILD_BUS=OFF -DPOINSOT_BUILD_BENCH=ON \
    -DPOINSOT_BUILD_PEERS=ON >"$build/configure.log" 2>&1 || { cat "$build/configure.log" >&2; exit 1; }
fi
targets=()
for engine in "${engines[@]}"; do
  [[ $engine == poinsot ]] && targets+=(bench_contacts) || targets+=("bench_contacts_$engine")
done
echo "Building" >&2
ninja -C "$build" --quiet "${targets[@]}" >&2

mkdir -p "$out"
rm -f "$out"/round_*.csv "$out/messages.log"
program() {
  [[ $1 == poinsot ]] && echo "$build/tests/bench/bench_contacts" ||
    echo "$build/tests/bench/peers/bench_contacts_$1"
}
# Engines take turns within a case, so that what else the machine does falls on all of them.
names=$("$(program "${engines[0]}")" --list "${cases[@]}")
for ((round = 1; round <= rounds; ++round)); do
  for name in $names; do
    for engine in "${engines[@]}"; do
      choices=("")
      [[ $engine != poinsot ]] || choices=("${ours[@]}")
      for choice in "${choices[@]}"; do
        echo "Round $round of $rounds: $name, $engine $choice" >&2
        # shellcheck disable=SC2086 -- the choice is several words
        "$(program "$engine")" --header $choice "${options[@]}" "$name" >>"$out/round_$round.csv" \
          2>>"$out/messages.log"
      done
    done
  done
done
/usr/bin/python3 "$root/tests/bench/contacts_report.py" "$out" "$out"/round_*.csv
cat "$out/contacts.md"
