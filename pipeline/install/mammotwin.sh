#!/bin/sh
# mammotwin: the front door of an installed Mammotwin; takes the same targets and settings as `make`.
set -u

usage() {
  cat <<END
mammotwin: prone breast MRI -> compressed mechanical model and lesion positions in mammograms
Usage: mammotwin TARGET [NAME=value ...]

Targets:
  patient          MRI to lesion positions in CC and MLO, and a report
  segment          the same, up to and including that stage
  fit              likewise
  unload           likewise
  compress         likewise
  register         likewise
  report           likewise
  slicer           the whole chain, and a scene for 3D Slicer
  paraview         the whole chain, and each load step as a series for ParaView
  synthesize       a synthetic patient in DATA/P
  exam             a synthetic MRI series and mammograms, in DICOM, in DATA/P
  cohort           every patient of DATA: tables and a page
  verify-results   are all files of a patient still those that were written?

Settings:
  P=name           the patient: a folder of DATA that holds a patient.toml
  DATA=folder      of patient folders; default: the sample patients that come with the program
  RESULTS=folder   where results go; default: results
  FORCE=1          runs stages that are up to date, too
  SEED=number      synthesize, exam: another number, another patient
  PATIENTS=names   cohort: only these, separated by blanks
  JOBS=number      cohort: patients at a time; default: what cores and memory allow
  ONLY=failed      cohort: those of RESULTS/failed.tsv
  ENGINE=engine    cohort: local or slurm
  CONFIG=file      cohort: memory, cores, time and partition of one patient

Options:
  --help           print this help
  --version        print the version
END
}

bad_usage() {
  echo "mammotwin: $*; mammotwin --help says more" >&2
  exit 2
}

BIN=$(dirname "$(readlink -f "$0")")
scripts=$BIN/../share/mammotwin
DATA=$scripts/sample_data
RESULTS=results
FRONT_DOOR=mammotwin
export BIN DATA RESULTS FRONT_DOOR

target=${1:---help}
[ $# -eq 0 ] || shift
for word in "$@"; do
  case "$word" in
    P=* | DATA=* | RESULTS=* | FORCE=* | SEED=* | PATIENTS=* | JOBS=* | ONLY=* | ENGINE=* | CONFIG=*) export "${word?}" ;;
    *) bad_usage "$word is not a setting" ;;
  esac
done

case "$target" in
  patient | segment | fit | unload | compress | register | report | slicer | paraview | synthesize | exam) exec "$scripts/run_patient.sh" "$target" ;;
  cohort) exec "$scripts/cohort/run_cohort.sh" ;;
  verify-results) exec "$scripts/cohort/verify_patient.sh" ;;
  help | -h | --help) usage ;;
  --version) exec "$BIN/mammotwin-segment" --version ;;
  *) bad_usage "$target is not a target" ;;
esac
