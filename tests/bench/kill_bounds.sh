#!/bin/bash
# kill_bounds.sh BIN [KILLS] [DOMAIN]: kills the daemon with SIGKILL 50 times, starts it again each
# time, and prints how many shared-memory files of the bus there are after each restart and how long
# the restart took. A client watches all the time and must get frames from the last daemon as well.
# BIN: directory of poinsotd and poinsot. Counts all files of the bus: nothing else should use it.
set -euo pipefail

bin=$1 kills=${2:-50} domain=${3:-178}
log=$(mktemp) poses=$(mktemp)
trap 'kill -9 $daemon $watcher 2>/dev/null || true; rm -f "$log" "$poses"' EXIT

files() { find /dev/shm -maxdepth 1 \( -name '*fastrtps_*' -o -name 'fast_datasharing_*' \) | wc -l; }
milliseconds() { echo $(($(date +%s%N) / 1000000)); }

start() {
  : >"$log"
  local begin
  begin=$(milliseconds)
  "$bin/poinsotd" run push_me --domain "$domain" >"$log" 2>/dev/null &
  daemon=$!
  until grep -q 'poinsot' "$log"; do sleep 0.002; done
  took=$(($(milliseconds) - begin))
}

echo "files of the bus before: $(files)"
watcher=
start
"$bin/poinsot" watch --json --domain "$domain" >"$poses" 2>/dev/null &
watcher=$!
sleep 1
echo "kill  files  ready [ms]"
most=0 slowest=0
for ((i = 1; i <= kills; ++i)); do
  kill -9 "$daemon"
  wait "$daemon" 2>/dev/null || true
  start
  sleep 0.2
  count=$(files)
  if ((count > most)); then most=$count; fi
  if ((took > slowest)); then slowest=$took; fi
  printf '%4d  %5d  %5d\n' "$i" "$count" "$took"
done
sleep 2  # a client meets a new daemon within a third of a second
before=$(wc -l <"$poses")
sleep 2
echo "frames that the same client got in 2 s after the last restart: $(($(wc -l <"$poses") - before))"
kill "$watcher"
echo "most files: $most, slowest restart: $slowest ms"
kill -9 "$daemon"
wait "$daemon" 2>/dev/null || true
sleep 6
start
sleep 0.2
echo "after another restart, the client gone: $(files)"
