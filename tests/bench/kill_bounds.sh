#!/bin/bash
# kill_bounds.sh BIN [KILLS] [DOMAIN]: kills the daemon with SIGKILL 50 times, starts it again each
# time, and prints how many shared-memory files of the bus there are after each restart and how long
# the restart took. A watching client lives through all of it. BIN: directory of poinsotd and poinsot.
set -euo pipefail

bin=$1 kills=${2:-50} domain=${3:-178}
log=$(mktemp)
trap 'kill -9 $daemon $watcher 2>/dev/null || true; rm -f "$log"' EXIT

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
"$bin/poinsot" watch --json --domain "$domain" >/dev/null 2>&1 &
watcher=$!
sleep 1
echo "kill  files  ready [ms]"
most=0
for ((i = 1; i <= kills; ++i)); do
  kill -9 "$daemon"
  wait "$daemon" 2>/dev/null || true
  start
  sleep 0.2
  count=$(files)
  if ((count > most)); then most=$count; fi
  printf '%4d  %5d  %5d\n' "$i" "$count" "$took"
done
kill -0 "$watcher" && echo "the watching client is still there"
echo "most files: $most"
