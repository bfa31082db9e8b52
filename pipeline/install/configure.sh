#!/bin/sh
# configure.sh [-D NAME=VALUE]: configures build/release, where that has not been done or NAME has another value there.
set -eu
cache=build/release/CMakeCache.txt
setting=${2:-MAMMOTWIN_TESTS=}  # without tests, if they are not asked for and nobody has configured them
if [ -f build/release/build.ninja ] && grep -q "^${setting%%=*}:BOOL=${setting#*=}" "$cache"; then exit; fi

log=$(mktemp)
trap 'rm -f "$log"' EXIT
echo 'Configuring the build' >&2
cmake --preset release -D MAMMOTWIN_TESTS=OFF "$@" >"$log" 2>&1 || {
  cat "$log" >&2
  exit 1
}
