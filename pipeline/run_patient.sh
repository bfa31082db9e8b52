#!/bin/sh
# run_patient.sh STAGE: takes patient $P through the stages up to STAGE (all of them for "patient"),
# and on to a scene for 3D Slicer ("slicer") or series for ParaView ("paraview"), or makes a synthetic one ("synthesize", in DICOM: "exam"; environment: SEED).
# Environment: P (name of the patient's folder), DATA, RESULTS (folders), FORCE (1: run anyway),
# BIN (folder of the programs).
set -u
. "$(dirname "$0")/patient_name.sh"
last=$1

fail() { echo "$*" >&2; exit 2; }

[ -n "${RESULTS:-}" ] || fail "RESULTS is empty: name the folder that results go to"
[ -n "${DATA:-}" ] || fail "DATA is empty: name the folder of patients"
[ -n "${P:-}" ] || fail "name a patient: make $last P=042 (a folder of $DATA)"
is_plain_name "$P" ||
  fail "P is not a plain name: use letters, digits, '.', '_' and '-', beginning with a letter or digit"
! is_kept_name "$P" || fail "P=$P: that name is kept for the program's own results"
[ "$last" != synthesize ] || exec "$BIN/mammotwin-synthesize" "$DATA/$P" --seed "${SEED:-42}"
[ "$last" != exam ] || exec "$BIN/mammotwin-synthesize-exam" "$DATA/$P" --seed "${SEED:-42}"
toml=$DATA/$P/patient.toml
[ -f "$toml" ] || fail "$toml: no such file (DATA=$DATA is the folder of patients, P=$P one of them)"

# With less the system cannot load the programs' libraries, and says so in its own words.
least_mib=256
memory_kib=$(ulimit -v)
[ "$memory_kib" = unlimited ] || [ "$memory_kib" -ge $((least_mib * 1024)) ] || {
  echo "memory is limited to $((memory_kib / 1024)) MiB (by ulimit -v or the batch system); the programs need $least_mib MiB to begin with" >&2
  exit 1
}

out=$RESULTS/$P
not_converged=3
lost=  # the view that no equilibrium was found in, where one was found in the other
export MAMMOTWIN_ENDS_WITH_ITS_PARENT=1  # make, told to stop, ends this script and not what it runs
set -- --patient "$toml"
[ -z "${FORCE:-}" ] || set -- "$@" --force

segment() { "$BIN/mammotwin-segment" "$out/segmentation.seg.nrrd" "$@"; }
fit() { "$BIN/mammotwin-fit" "$out/segmentation.seg.nrrd" "$out/fractions.nrrd" "$out/prone.vtu" "$@"; }
unload() { "$BIN/mammotwin-unload" "$out/segmentation.seg.nrrd" "$out/fractions.nrrd" "$out/prone.vtu" "$out/unloaded.vtu" "$@"; }
compress() {
  lost=
  for view in cc mlo; do
    "$BIN/mammotwin-compress" "$view" "$out/segmentation.seg.nrrd" "$out/fractions.nrrd" "$out/unloaded.vtu" "$out/$view.vtu" "$@" && continue
    status=$?
    [ "$status" -eq "$not_converged" ] && [ -z "$lost" ] || return "$status"
    lost=$view
  done
}
register() { "$BIN/mammotwin-register" "$out/segmentation.seg.nrrd" "$out/fractions.nrrd" "$out/cc.vtu" "$out/mlo.vtu" "$out/lesions.csv" "$@"; }
report() { "$BIN/mammotwin-report" "$out" "$out/report.html" "$@"; }
slicer() { "$BIN/mammotwin-slicer" "$out" "$out/scene.mrml" "$@"; }
paraview() {
  for view in cc mlo; do
    [ "$view" != "$lost" ] || continue
    "$BIN/mammotwin-paraview" "$out/$view.vtu" "$out/${view}_course.pvd" "$@" || return
  done
}

for stage in segment fit unload compress register report; do
  "$stage" "$@" || {
    status=$?
    if [ "$stage" != report ] && report "$@"; then
      echo "$P stopped at $stage; what is known is in $out/report.html" >&2
    else
      echo "$P stopped at $stage; there is no page of it: mend what is said above first" >&2
    fi
    exit "$status"
  }
  [ "$stage" != "$last" ] || break
done

case $last in
  slicer | paraview) "$last" "$@" || exit ;;
  patient) echo; echo "Results of $P: $out (open $out/report.html)" ;;
esac
[ -z "$lost" ] || {
  echo "$P stopped at compress; without $lost, the rest is in $out" >&2
  exit "$not_converged"
}
