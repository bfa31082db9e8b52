#!/bin/sh
# verify_patient.sh: are patient $P's results in $RESULTS still what their sidecars say? BIN: programs.
set -u
. "$(dirname "$0")/../patient_name.sh"
if ! is_plain_name "${P:-}"; then
  echo "name a patient by a plain name: make verify-results P=042 (a folder of $RESULTS)" >&2
  exit 2
fi
exec "$BIN/mammotwin-verify" "$RESULTS/$P"
