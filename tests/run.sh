#!/bin/bash
# run.sh [arguments of ctest]: installs what is missing, builds everything, runs all tests (or those
# that the arguments select, like `-L unit` or `-R Inertia`). The last line counts them.
set -uo pipefail

root=$(dirname "$(dirname "$(realpath "$0")")")
build=$root/build/release
results=$build/tests.xml

"$root/docker/install_packages.sh" build test || exit 1

# What .ci/run or the user has configured stays as it is; only the tests are switched on.
if [[ ! -e $build/build.ninja ]] || ! grep -q '^POINSOT_BUILD_TESTS:BOOL=ON' "$build/CMakeCache.txt"; then
  echo "Configuring $build" >&2
  mkdir -p "$build"
  cmake -S "$root" -B "$build" -G Ninja -DPOINSOT_BUILD_TESTS=ON >"$build/configure.log" 2>&1 ||
    { cat "$build/configure.log" >&2; exit 1; }
fi
echo "Building" >&2
quiet=--quiet
if [[ -t 2 ]]; then quiet=; fi
ninja -C "$build" $quiet >&2 || exit 1

run_ctest() {
  ctest --test-dir "$build" --output-on-failure --no-tests=error -j "$(nproc)" \
    --output-junit "$results" "$@" </dev/null
}
rm -f "$results"
if [[ -t 1 ]]; then
  run_ctest --progress "$@"
  code=$?
else
  run_ctest "$@" | grep -v '^ *Start '
  code=${PIPESTATUS[0]}
fi

# The counts stand in the first lines of the JUnit file: tests="…" failures="…" disabled="…" skipped="…".
if [[ -e $results ]]; then
  head -c 2000 "$results" | tr ' \n\t' '\n\n\n' | awk -F '"' '
    !($1 in n) { n[$1] = $2 }
    END {
      failed = n["failures="]
      printf "%d passed, %d failed\n", n["tests="] - failed - n["disabled="] - n["skipped="], failed
    }'
fi
exit $code
