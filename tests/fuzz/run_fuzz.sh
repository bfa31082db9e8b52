#!/bin/sh
# run_fuzz.sh FOLDER [READER...]: gives every reader (or those named) RUNS inputs (default 10000) that begin from the
# seeds, one after the other, and writes FOLDER.json, a line a reader. What fails goes to FOLDER/failed/READER.
# Targets: build/fuzz/bin (preset fuzz); what readers start as mammotwin-try-read asks a server (try_read_server.cpp) that
# forks what users have, for its libraries take 20 ms to load.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
bin=$here/../../build/fuzz/bin
out=$1
shift
[ $# -gt 0 ] || set -- $(ls "$here/seeds")
mkdir -p "$out/logs"
release=$here/../../build/release/bin
cp "$release/fuzz_try_read_client" "$bin/try" && mv "$bin/try" "$bin/mammotwin-try-read"
socket_folder=$(mktemp -d)
export MAMMOTWIN_TRY_READ="$socket_folder/socket"
"$release/fuzz_try_read_server" "$MAMMOTWIN_TRY_READ" &
server=$!
trap 'kill "$server"; rm -r "$socket_folder"' EXIT
while [ ! -S "$MAMMOTWIN_TRY_READ" ]; do kill -0 "$server"; sleep 0.1; done
export ASAN_OPTIONS=allocator_may_return_null=0:detect_leaks=0 UBSAN_OPTIONS=print_stacktrace=1
for reader; do
  log=$out/logs/$reader.txt
  new=$out/new/$reader
  mkdir -p "$new" "$out/failed/$reader"
  "$bin/fuzz_$reader" -runs="${RUNS:-10000}" -seed=1 -timeout=20 -report_slow_units=20 -rss_limit_mb=2048 -max_len=65536 -print_final_stats=1 \
    -artifact_prefix="$out/failed/$reader/" "$new" "$here/seeds/$reader" >"$log" 2>&1 || echo "$reader: failed, see $log" >&2
done
{
  echo '{"cases": ['
  comma=
  for log in "$out"/logs/*.txt; do
    reader=$(basename "$log" .txt)
    awk -v reader="$reader" -v comma="$comma" -v failed="$(ls "$out/failed/$reader" | wc -l)" '
      /^stat::number_of_executed_units/ { inputs = $2 }
      /^stat::slowest_unit_time_sec/ { seconds = $2 }
      /^stat::peak_rss_mb/ { memory = $2 }
      / cov: / { for (i = 1; i < NF; i++) if ($i == "cov:") edges = $(i + 1) }
      END { printf "%s{\"reader\": \"%s\", \"inputs\": %d, \"failed\": %d, \"slowest_s\": %d, \"memory_mb\": %d, \"edges\": %d}\n",
              comma, reader, inputs, failed, seconds, memory, edges }' "$log"
    comma=", "
  done
  echo ']}'
} >"$out.json"
