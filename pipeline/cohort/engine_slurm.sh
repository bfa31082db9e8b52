# Sourced by run_cohort.sh. A cluster: a job array, one task a patient, on a file system that the nodes
# share. Waits for the end; where it is cut off the jobs go on, and `make cohort` again gathers them.

max_array_size() { scontrol show config | sed -n 's/^MaxArraySize *= *//p'; }

submit() { # LIST FIRST COUNT: the patients on COUNT lines of LIST from line FIRST
  partition=$(setting partition)
  sbatch --wait --quiet --job-name=mammotwin --array="1-$3${JOBS:+%$JOBS}" --output=/dev/null \
    --mem="$(setting memory_mb)M" --cpus-per-task="$(setting cpus)" --time="$(setting time)" \
    ${partition:+"--partition=$partition"} "$here/slurm_task.sh" "$here" "$1" "$2"
}

run_all() { # LIST
  command -v sbatch >/dev/null || fail "ENGINE=slurm: there is no sbatch here; install Slurm's client or leave ENGINE out"
  most=$(max_array_size)
  [ -n "$most" ] || fail "ENGINE=slurm: slurmctld does not answer (scontrol show config)"
  total=$(wc -l < "$1")
  say "$total patients as Slurm job arrays of at most $((most - 1))"
  first=1
  waiting=
  while [ "$first" -le "$total" ]; do
    count=$(least "$((most - 1))" "$((total - first + 1))")
    submit "$1" "$first" "$count" &
    waiting="$waiting $!"
    first=$((first + count))
  done
  all_fine=0
  for job in $waiting; do wait "$job" || all_fine=1; done
  [ "$all_fine" -eq 0 ] || say "Slurm ended some jobs or took none (squeue, sacct); the tables say what is known"
  return "$all_fine"
}
