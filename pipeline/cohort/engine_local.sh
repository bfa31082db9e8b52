# Sourced by run_cohort.sh. One machine: make -k -j, one target a patient.

# What the machine has available, or less where a control group (a container) allows less.
available_mb() {
  free=$(awk '/^MemAvailable:/ { print int($2 / 1024) }' /proc/meminfo)
  group=/sys/fs/cgroup/memory
  allowed=$(cat $group.max 2>/dev/null)
  case "$allowed" in
    '' | max) echo "$free" ;;
    *) least "$free" $(((allowed - $(cat $group.current)) / 1048576)) ;;
  esac
}

# The largest of cohort.conf's figure and what any patient has needed so far.
patient_mb() {
  measured=0
  [ ! -f "$RESULTS/cohort_times.tsv" ] || measured=$(awk -F '\t' '
    NR == 1 { for (i = 1; i <= NF; i++) if ($i == "peak_memory_mb") column = i; next }
    $column > most { most = $column }
    END { print int(most + 0.999) }' "$RESULTS/cohort_times.tsv")
  configured=$(setting memory_mb)
  if [ "$measured" -gt "$configured" ]; then echo "$measured"; else echo "$configured"; fi
}


# How many at a time: JOBS, or the cores divided by a patient's; never more than fit in memory.
num_jobs() {
  fitting=$(($1 / $2))
  by_cores=$(($(nproc) / $(setting cpus)))
  jobs=$(least "${JOBS:-$by_cores}" "$fitting")
  if [ "$jobs" -lt 1 ]; then echo 1; else echo "$jobs"; fi
}

run_all() { # LIST
  available=$(available_mb)
  each=$(patient_mb)
  jobs=$(num_jobs "$available" "$each")
  say "$(wc -l < "$1") patients, $jobs at a time ($(nproc) cores, $available MB available, $each MB a patient)"
  [ "${JOBS:-0}" -le "$jobs" ] || say "JOBS=$JOBS lowered to $jobs: more do not fit in memory"
  # Told to stop, this script ends and make with it, which tells its patients.
  LIST=$1 TOTAL=$(wc -l < "$1") setpriv --pdeathsig TERM make --no-print-directory -s -r -k -j "$jobs" -f "$here/each_patient.mk" ||
    say "the engine reports an error; the tables say what is known"
}
