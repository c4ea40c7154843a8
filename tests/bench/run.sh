#!/bin/bash
# run.sh [--rounds N] [--update-readme]: speed against error, of Poinsot and of five other engines on
# the same cases, in one run: installs what is missing, builds, runs all programs in turn, N rounds
# (default 3), and takes medians of the cost. Writes build/bench/report/speed_against_error.csv, .md and
# .svg and prints the tables. --update-readme puts them into README.md and beside this script.
set -euo pipefail

root=$(dirname "$(dirname "$(dirname "$(realpath "$0")")")")
build=$root/build/bench
report=$build/report
rounds=3 update=
while [[ $# -gt 0 ]]; do
  case $1 in
    --rounds) rounds=$2 && shift 2 ;;
    --update-readme) update=1 && shift ;;
    *) echo "unknown argument '$1': --rounds N or --update-readme" >&2 && exit 2 ;;
  esac
done

"$root/docker/install_packages.sh" build test peers
mkdir -p "$build" "$report"
echo "Configuring $build" >&2
cmake -S "$root" -B "$build" -G Ninja -DPOINSOT_BUILD_BUS=OFF -DPOINSOT_BUILD_BENCH=ON \
  -DPOINSOT_BUILD_PEERS=ON >"$build/configure.log" 2>&1 || { cat "$build/configure.log" >&2; exit 1; }
echo "Building; the reference solutions take a minute or two" >&2
ninja -C "$build" --quiet bench_speed_against_error bench_reference bench_peers >&2

bench=$build/tests/bench
programs=("$bench/bench_speed_against_error" "$bench"/peers/bench_peer_*)
rm -f "$report"/round_*.csv "$report/left_out.log"
for ((round = 1; round <= rounds; ++round)); do
  for program in "${programs[@]}"; do
    echo "Round $round of $rounds: $(basename "$program")" >&2
    "$program" --reference "$bench/reference.bin" >>"$report/round_$round.csv" 2>>"$report/left_out.log"
  done
done

/usr/bin/python3 "$root/tests/bench/report.py" "$report" "$report"/round_*.csv
cat "$report/speed_against_error.md"
if [[ -n $update ]]; then
  cp "$report/speed_against_error.svg" "$root/tests/bench/"
  sed -i -e '/<!-- speed against error: begin -->/,/<!-- speed against error: end -->/{
    /<!-- speed against error: begin -->/r '"$report/speed_against_error.md"'
    /<!-- speed against error: \(begin\|end\) -->/!d
  }' "$root/README.md"
fi
