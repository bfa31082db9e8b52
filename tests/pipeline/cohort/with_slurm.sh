#!/bin/sh
# with_slurm.sh FOLDER COMMAND...: runs COMMAND on a Slurm cluster of this one machine, made in FOLDER
# for the purpose and stopped afterwards. Needs root and Debian's slurm-wlm and munge.
# Exit code: COMMAND's; 77 where Slurm cannot be had here.
set -u
folder=$1
shift

skip() { echo "skipped: $*" >&2; exit 77; }
[ "$(id -u)" -eq 0 ] || skip "slurmctld and slurmd need root here"
for program in munged slurmctld slurmd sbatch scontrol; do
  PATH=$PATH:/usr/sbin command -v "$program" >/dev/null || skip "there is no $program (packages slurm-wlm, munge)"
done
PATH=$PATH:/usr/sbin

# free_port FIRST: the first port from FIRST on which nothing listens
free_port() {
  port=$1
  while grep -qi ":$(printf '%04X' "$port") 00000000:0000 0A" /proc/net/tcp; do port=$((port + 1)); done
  echo "$port"
}

mkdir -p "$folder/state" "$folder/spool"
controller_port=$(free_port 26817)
node_port=$(free_port "$((controller_port + 1))")
host=$(hostname -s)
cat > "$folder/slurm.conf" <<END
ClusterName=test
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=$controller_port
SlurmdPort=$node_port
AuthType=auth/munge
AuthInfo=socket=$folder/munge.socket
SlurmUser=root
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd.pid
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
ReturnToService=2
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU_Memory
SchedulerParameters=sched_interval=1,batch_sched_delay=0
MaxArraySize=${MAX_ARRAY_SIZE:-1001}
NodeName=$host NodeAddr=127.0.0.1 CPUs=$(nproc) RealMemory=$(awk '/^MemTotal/ { print int($2 / 1024) }' /proc/meminfo)
PartitionName=short Nodes=$host Default=YES MaxTime=60
END
SLURM_CONF=$folder/slurm.conf
export SLURM_CONF

dd if=/dev/urandom of="$folder/munge.key" bs=1024 count=1 2>/dev/null
chmod 400 "$folder/munge.key"
munged --foreground --force --key-file="$folder/munge.key" --socket="$folder/munge.socket" \
  --pid-file="$folder/munge.pid" --seed-file="$folder/munge.seed" > "$folder/munged.log" 2>&1 &
munged=$!
tries=0
until [ -S "$folder/munge.socket" ] || [ "$tries" -ge 50 ]; do tries=$((tries + 1)); sleep 0.1; done
slurmctld -D > "$folder/slurmctld.log" 2>&1 &
slurmctld=$!
slurmd -D > "$folder/slurmd.log" 2>&1 &
slurmd=$!
stop() { kill "$slurmd" "$slurmctld" "$munged" 2>/dev/null; wait "$slurmd" "$slurmctld" "$munged" 2>/dev/null; }
trap stop EXIT

tries=0
until sinfo --noheader --format=%T 2>/dev/null | grep -q idle; do
  tries=$((tries + 1))
  if [ "$tries" -ge 150 ]; then
    tail -n 5 "$folder"/*.log >&2
    echo "with_slurm.sh: the cluster did not come up in 15 s" >&2
    exit 1
  fi
  sleep 0.1
done
"$@"
