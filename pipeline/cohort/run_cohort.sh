#!/bin/sh
# run_cohort.sh: takes many patients through the whole chain, several at a time, then writes the tables
# and the page. A patient that fails does not stop the others; exit code 1 if any did.
# Environment: DATA, RESULTS, FORCE, BIN as for run_patient.sh; PATIENTS (names, separated by blanks;
# default all of DATA), ONLY (failed: those of RESULTS/failed.tsv), ENGINE (local or slurm),
# JOBS (patients at a time), CONFIG (see cohort.conf), FRONT_DOOR ("make").
set -u
COHORT_HERE=$(cd "$(dirname "$0")" && pwd)
export COHORT_HERE
here=$COHORT_HERE
. "$here/../patient_name.sh"
config=${CONFIG:-$here/cohort.conf}
state=$RESULTS/.cohort

say() { echo "cohort: $*" >&2; }
fail() { say "$*"; exit 2; }

# setting KEY: its value in $config
setting() { sed -n "s/^$1 *= *//p" "$config"; }

least() { printf '%s\n' "$@" | sort -n | head -n 1; }

require_whole_number() { # NAME VALUE
  case "$2" in '' | *[!0-9]* | 0*) fail "$1 is '$2'; expected a whole number from 1" ;; esac
}

all_patients() {
  for folder in "$DATA"/*/; do
    [ -f "$folder/patient.toml" ] || continue
    name=$(basename "$folder")
    if is_kept_name "$name"; then continue; fi
    if is_plain_name "$name"; then echo "$name"; else say "left out, not a plain name: $folder"; fi
  done
}

named_patients() {
  set -f
  for name in $PATIENTS; do
    is_plain_name "$name" || fail "PATIENTS: '$name' is not a plain name"
    ! is_kept_name "$name" || fail "PATIENTS: $name is kept for the program's own results"
    echo "$name"
  done
}

selected_patients() {
  if [ -n "${PATIENTS:-}" ]; then named_patients; else all_patients; fi
}

only_failed() {
  [ -f "$RESULTS/failed.tsv" ] || fail "ONLY=failed: there is no $RESULTS/failed.tsv yet"
  tail -n +2 "$RESULTS/failed.tsv" | cut -f1 | sort > "$state/failed.txt"
  comm -12 "$state/selected.txt" "$state/failed.txt"
}

list_patients() {
  selected_patients > "$state/unsorted.txt" || exit
  sort -u "$state/unsorted.txt" > "$state/selected.txt"
  [ -s "$state/selected.txt" ] || fail "DATA=$DATA holds no folder with a patient.toml"
  case "${ONLY:-}" in
    '') cp "$state/selected.txt" "$state/to_run.txt" ;;
    failed) only_failed > "$state/to_run.txt" || exit ;;
    *) fail "ONLY=$ONLY: expected failed" ;;
  esac
}

LC_ALL=C
export LC_ALL
[ -n "$RESULTS" ] || fail "RESULTS is empty: name the folder that results go to"
[ -d "$DATA" ] || fail "DATA=$DATA: no such folder"
[ -f "$config" ] || fail "CONFIG=$config: no such file"
mkdir -p "$state/logs" "$state/exit_codes" || fail "RESULTS=$RESULTS cannot be written; name another"
: > "$state/finished.txt" || fail "RESULTS=$RESULTS cannot be written; name another"
list_patients
[ -z "${JOBS:-}" ] || require_whole_number JOBS "$JOBS"
for key in memory_mb cpus; do require_whole_number "$config: $key" "$(setting "$key")"; done

engine=${ENGINE:-local}
case "$engine" in
  local | slurm) . "$here/engine_$engine.sh" ;;
  *) fail "ENGINE=$engine: expected local or slurm" ;;
esac
if [ -s "$state/to_run.txt" ]; then
  run_all "$state/to_run.txt" || engine_failed=1
else
  say "nothing to run"
fi
"$BIN/mammotwin-cohort" "$RESULTS" --patients "$state/selected.txt" \
  --front-door "${FRONT_DOOR:-make}" && [ -z "${engine_failed:-}" ]
