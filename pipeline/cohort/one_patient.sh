#!/bin/sh
# one_patient.sh NAME: one patient of a cohort. Its log and exit code go to RESULTS/.cohort, and the exit
# code of this script is 0 however the patient fared: the tables tell.
set -u
P=$1
export P
state=$RESULTS/.cohort
log=$state/logs/$P.txt
code=$state/exit_codes/$P

rm -f "$code"
start=$(date +%s)
setpriv --pdeathsig TERM "$(dirname "$0")/../run_patient.sh" patient > "$log" 2>&1
status=$?
echo "$status" > "$code.new" && mv "$code.new" "$code"

echo "$P" >> "$state/finished.txt"
how=done
[ "$status" -eq 0 ] || how="stopped with exit code $status, see $log"
echo "cohort: [$(wc -l < "$state/finished.txt")/${TOTAL:-?}] $P: $how ($(($(date +%s) - start)) s)" >&2
