#!/bin/sh
# verify_patient.sh: are patient $P's results in $RESULTS still what their sidecars say, and what they were made of
# in $DATA? BIN: programs.
set -u
. "$(dirname "$0")/../patient_name.sh"
if ! is_plain_name "${P:-}"; then
  echo "name a patient by a plain name: make verify-results P=042 (a folder of $RESULTS)" >&2
  exit 2
fi
data=${DATA:+$DATA/$P}
[ -d "$data" ] || data=
exec "$BIN/mammotwin-verify" "$RESULTS/$P" ${data:+--data "$data"}
