#!/usr/bin/env bash
# check_slurm.sh [GENU]: a sweep on a real Slurm. Starts munge and Slurm with two nodes on the loopback interface, each in a PID
# namespace of its own, and stops them. An array of 40 shards runs through `genu sweep submit --slurm`; in the middle everything on
# one node is killed with SIGKILL, and the node comes back; one shard then runs twice at once. The merged files must be those of
# one process, byte for byte. Needs root, slurm-wlm and munge (tools/install-packages slurm); exit code 77 where one is lacking.
#   GENU_SLURM_SAMPLES: samples of the study (20000: some 50 s of one core)
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
genu=$(realpath "${1:-build/bin/genu}") samples=${GENU_SLURM_SAMPLES:-20000} shards=40
skip() { echo "skipped: $*"; exit 77; }
[ "$(id -u)" -eq 0 ] || skip "needs root"
[ -x "$genu" ] || skip "there is no $genu"
for program in munged slurmctld slurmd sbatch squeue scontrol unshare; do
  command -v $program >/dev/null || skip "$program is not installed (tools/install-packages slurm)"
done
unshare --pid --fork --mount-proc true 2>/dev/null || skip "no PID namespaces here"

work=$(mktemp -d)
daemons=()
stop() {
  exec 2>/dev/null  # the shell tells of every process that is killed
  for pid in "${daemons[@]}"; do kill -KILL "$pid" 2>/dev/null || true; done
  wait 2>/dev/null || true
  rm -rf --one-file-system "$work"
}
trap stop EXIT
fail() { echo "check_slurm: $*" >&2; tail -n 15 "$work"/*.log >&2 2>/dev/null || true; exit 1; }
# wait_until SECONDS WHAT COMMAND...: fails where the command does not succeed in time.
wait_until() {
  local end=$((SECONDS + $1)) what=$2
  shift 2
  until "$@"; do
    [ $SECONDS -lt $end ] || fail "$what: not after the time allowed"
    sleep 0.2
  done
}

# munge with a key and a socket of its own
mkdir "$work/munge" "$work/state" "$work/n1" "$work/n2"
chmod 755 "$work" "$work/munge"
(umask 077 && head -c 1024 /dev/urandom >"$work/munge/key")
munged --foreground --force --key-file="$work/munge/key" --socket="$work/munge/socket" --pid-file="$work/munge/pid" \
  --seed-file="$work/munge/seed" --log-file="$work/munged.log" 2>>"$work/munged.log" &
daemons+=($!)
wait_until 20 "munged answers" test -S "$work/munge/socket"

# a controller and two nodes of one core
port=$((20000 + $$ % 20000))
cat >"$work/slurm.conf" <<END
ClusterName=loopback
SlurmctldHost=$(hostname -s)(127.0.0.1)
SlurmctldPort=$port
AuthType=auth/munge
AuthInfo=socket=$work/munge/socket
CryptoType=crypto/munge
SlurmUser=root
SlurmdUser=root
StateSaveLocation=$work/state
SlurmdSpoolDir=$work/%n
SlurmctldPidFile=$work/slurmctld.pid
SlurmdPidFile=$work/%n.pid
SlurmctldLogFile=$work/slurmctld.log
SlurmdLogFile=$work/%n.log
ProctrackType=proctrack/pgid
TaskPlugin=task/none
SwitchType=switch/none
MpiDefault=none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SchedulerType=sched/backfill
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SlurmdParameters=config_overrides
ReturnToService=2
SlurmdTimeout=8
JobRequeue=1
InactiveLimit=0
KillWait=2
MinJobAge=3600
NodeName=n1 NodeHostname=$(hostname -s) NodeAddr=127.0.0.1 Port=$((port + 1)) CPUs=1 State=UNKNOWN
NodeName=n2 NodeHostname=$(hostname -s) NodeAddr=127.0.0.1 Port=$((port + 2)) CPUs=1 State=UNKNOWN
PartitionName=all Nodes=n1,n2 Default=YES MaxTime=INFINITE State=UP
END
export SLURM_CONF=$work/slurm.conf
slurmctld -D -c >>"$work/slurmctld.out.log" 2>&1 &
daemons+=($!)

# start_node NAME: its processes end with `unshare`, whose PID namespace they share, as those of a machine without power.
node_pid=()
start_node() {
  unshare --pid --fork --mount-proc --kill-child slurmd -D -N "$1" >>"$work/$1.out.log" 2>&1 &
  node_pid[${1#n}]=$!
  daemons+=($!)
}
start_node n1
start_node n2
up() { [ "$(sinfo -h -N -o '%T' 2>/dev/null | grep -cE '^(idle|mixed|allocated)$')" -eq 2 ]; }
wait_until 60 "two nodes are up" up
echo "slurm $(sbatch --version | sed 's/slurm-wlm //'): two nodes are up"

study=$work/sweep.toml
sed -e "s/^samples = .*/samples = $samples/" -e "s|^scene = .*|scene = \"$PWD/meshes/dortmans1984/scene.toml\"|" \
  meshes/dortmans1984/sweep.toml >"$study"
out=$work/cluster
"$genu" sweep "$study" --out "$out" --plan $shards >/dev/null
job=$("$genu" sweep submit "$out" --slurm --time 0:30:00 --cores 1 | sed -n 's/^Submitted batch job //p')
[ -n "$job" ] || fail "sbatch submitted no job"
there() { find "$out" -name 'shard-*-of-*.csv' | wc -l; }

# In the middle of a shard on the second node, which has kept finished rows of it, the node loses its power.
middle() {
  task=$(squeue -h -j "$job" -t RUNNING -w n2 -o %K 2>/dev/null | sed -n 1p)
  [ -n "$task" ] && [ "$(there)" -ge 4 ] && part=$out/shard-$(printf %02d "$task")-of-$shards.csv.part && [ -s "$part" ]
}
wait_until 300 "a shard is in its middle on the second node" middle
kill -KILL "${node_pid[2]}"
wait "${node_pid[2]}" 2>/dev/null || true
before=$(there) kept=$(wc -l <"$part")
[ ! -e "${part%.part}" ] || fail "shard $task was finished before its node was killed"
echo "node n2 killed in the middle of shard $task with $kept finished rows; $before of $shards shards are there"
queued_again() { grep -qiE "requeue.*JobId=${job}_$task\(|requeue.*JobId=${job}_$task |JobId=${job}_$task.*[Rr]equeu" "$work/slurmctld.log"; }
wait_until 90 "Slurm has queued the shard again" queued_again
start_node n2

ended() { [ -z "$(squeue -h -j "$job" -o %i 2>/dev/null)" ]; }
wait_until 900 "the array ends" ended
[ -z "$("$genu" sweep missing "$out")" ] || fail "shards are missing: $("$genu" sweep missing "$out")"
restarts=$(scontrol show job "${job}_$task" | sed -n 's/.*Restarts=\([0-9]*\).*/\1/p')
[ "${restarts:-0}" -ge 1 ] || fail "shard $task was not started again"
grep -q "of an earlier start" "$out"/slurm-*_"$task".log || fail "shard $task did not continue with its finished rows"
echo "the array of $shards shards ended; shard $task was started $((restarts + 1)) times and continued with its rows"

# The same shard twice at once, once on each node.
rm "$out/shard-07-of-$shards.csv"
"$genu" sweep submit "$out" --time 0:30:00 --cores 1 >/dev/null
first=$(sbatch --parsable "$out/sweep.sbatch") second=$(sbatch --parsable "$out/sweep.sbatch")
both_ended() { [ -z "$(squeue -h -j "$first,$second" -o %i 2>/dev/null)" ]; }
wait_until 300 "both tasks of shard 7 end" both_ended
for id in "$first" "$second"; do
  grep -qE "runs, |another process computes this shard" "$out/slurm-${id}_7.log" || fail "job $id did not run shard 7"
done
"$genu" sweep merge "$out" --quiet >/dev/null
"$genu" sweep "$study" --out "$work/one" --quiet >/dev/null
compared=0
for file in "$work"/one/*; do
  name=${file##*/}
  [[ $name == shard-* || $name == sweep.json ]] && continue
  cmp "$file" "$out/$name" || fail "$name is another than that of one process"
  compared=$((compared + 1))
done
[ "$compared" -ge 7 ] || fail "only $compared files to compare"
echo "$shards shards of $samples samples on two nodes, one killed and one shard run twice: $compared merged files are those of one process"
