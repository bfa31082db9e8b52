#!/bin/bash
# build.sh TARGET...: builds in build/release, with the count of steps done on one line that is written over on a
# terminal, every ten seconds elsewhere. What the compiler has to say is always shown.
set -euo pipefail
cd build/release

# A compiler takes up to 2 GB: no more at a time than there are cores, and memory for.
free_gb=$(awk '/^MemAvailable:/ { print int($2 / 1024 / 1024) }' /proc/meminfo)
cores=$(nproc)
jobs=$((free_gb / 2 < cores ? free_gb / 2 : cores))
build() { ninja -j $((jobs > 0 ? jobs : 1)) "$@"; }

export NINJA_STATUS='Building, step %f of %t: '
if [ -t 1 ]; then
  build "$@"
  exit
fi

seconds_between_lines=10
next=0
build "$@" | while IFS= read -r line; do
  if [[ $line != "Building, step "* ]]; then
    [ "$line" = 'ninja: no work to do.' ] || printf '%s\n' "$line"
  elif [ $SECONDS -ge $next ]; then
    echo "${line%%:*}"
    next=$((SECONDS + seconds_between_lines))
  fi
done
