#!/bin/sh
# slurm_task.sh FOLDER LIST FIRST: the patient on line FIRST - 1 + task number of LIST. Slurm runs a copy
# of this script, so FOLDER says where the others are.
P=$(sed -n "$(($3 - 1 + SLURM_ARRAY_TASK_ID))p" "$2")
exec "$1/one_patient.sh" "$P"
