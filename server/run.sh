#!/bin/bash
# run.sh [SCENE] [options of poinsotd run]: installs what is missing, builds, runs the daemon in the
# foreground. SCENE is a file or the name of a shipped scene (server/scenes); push_me if there is none.
set -euo pipefail

root=$(dirname "$(dirname "$(realpath "$0")")")
build=$root/build/release

"$root/docker/install_packages.sh" build

if [[ ! -e $build/build.ninja ]]; then
  echo "Configuring $build" >&2
  mkdir -p "$build"
  cmake -S "$root" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DPOINSOT_BUILD_TESTS=OFF \
    >"$build/configure.log" 2>&1 || { cat "$build/configure.log" >&2; exit 1; }
fi
echo "Building poinsotd and poinsot" >&2
quiet=--quiet
if [[ -t 2 ]]; then quiet=; fi
ninja -C "$build" $quiet poinsotd poinsot_cli >&2

exec "$build/bin/poinsotd" run "$@"
