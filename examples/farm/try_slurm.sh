#!/bin/bash
# usage: try_slurm.sh NACRE
#
# Tries slurm_bake.sh with a farm of its own on this machine: a slurmctld and three slurmd. While
# shards are baked one node is lost, with all that runs on it; its shard is queued again, and what
# comes together is compared with one undisturbed run, byte by byte. Exit status 77, which is
# "skipped" to CTest, without Slurm (Debian: slurmctld, slurmd, slurm-client, munge) or root.
set -euo pipefail
export PATH=$PATH:/usr/sbin
for program in munged slurmctld slurmd sbatch scontrol; do
  command -v "$program" > /dev/null || { echo "no $program: skipped"; exit 77; }
done
[ "$(id -u)" = 0 ] || { echo "not root: skipped"; exit 77; }

nacre=$(realpath "$1")
folder=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d)
chmod 755 "$work"
daemons=()
end() {
  [ -z "${array:-}" ] || scancel "$array" 2> /dev/null || true
  kill "${daemons[@]:1}" 2> /dev/null || true
  sleep 1
  kill "${daemons[0]}" 2> /dev/null || true
  wait 2> /dev/null || true
  rm -rf "$work"
}
trap end EXIT
say() { echo "$(date +%T) $*"; }

# Ports that nobody else has, as far as can be told.
port=$((20000 + $$ % 20000))
host=$(hostname -s)
mkdir -p "$work"/{munge,state,log,shared} "$work"/spool{1,2,3}
chmod 700 "$work/munge"
dd if=/dev/urandom of="$work/munge/key" bs=1 count=1024 status=none
chmod 400 "$work/munge/key"
export SLURM_CONF="$work/slurm.conf"
cat > "$SLURM_CONF" << EOF
ClusterName=try
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=$port
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket=$work/socket
CryptoType=crypto/munge
MpiDefault=none
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SchedulerParameters=batch_sched_delay=0,sched_interval=2
StateSaveLocation=$work/state
SlurmdSpoolDir=$work/spool%n
SlurmctldPidFile=$work/ctld.pid
SlurmdPidFile=$work/slurmd-%n.pid
SlurmctldLogFile=$work/log/ctld
SlurmdLogFile=$work/log/slurmd-%n
SlurmdTimeout=10
ReturnToService=2
MinJobAge=3600
JobRequeue=1
SlurmdParameters=config_overrides
$(for i in 1 2 3; do
    echo "NodeName=n$i NodeHostname=$host NodeAddr=127.0.0.1 Port=$((port + i)) CPUs=1 State=UNKNOWN"
  done)
PartitionName=farm Nodes=n[1-3] Default=YES MaxTime=INFINITE State=UP
EOF

munged --foreground --force --key-file="$work/munge/key" --socket="$work/socket" \
  --pid-file="$work/munge/pid" --log-file="$work/munge/log" --seed-file="$work/munge/seed" \
  &> "$work/log/munged" &
daemons+=($!)
for _ in $(seq 100); do [ -S "$work/socket" ] && break; sleep 0.1; done
slurmctld -D -i &> "$work/log/ctld.out" &
daemons+=($!)
declare -A node
start_node() {
  mkdir -p "$work/spooln$1"
  slurmd -D -N "n$1" &> "$work/log/n$1.out" &
  node[$1]=$!
  daemons+=($!)
}
for i in 1 2 3; do start_node $i; done
for _ in $(seq 120); do
  [ "$(sinfo -h -t idle -o %D 2> /dev/null)" = 3 ] && break
  sleep 0.5
done
sinfo

# What there is to bake: eight tiles of what takes a while.
cat > "$work/shared/a.mtlx" << EOF
<materialx version="1.39">
  <geominfo name="i" geom="/"><geomprop name="udimset" type="stringarray"
    value="1001,1002,1003,1004,1005,1006,1007,1008"/></geominfo>
  <nodegraph name="G">
    <fractal3d name="n" type="color3"><input name="octaves" type="integer" value="8"/></fractal3d>
    <output name="o" type="color3" nodename="n"/>
  </nodegraph>
  <standard_surface name="S" type="surfaceshader">
    <input name="base_color" type="color3" nodegraph="G" output="o"/>
  </standard_surface>
  <surfacematerial name="M" type="material">
    <input name="surfaceshader" type="surfaceshader" nodename="S"/>
  </surfacematerial>
</materialx>
EOF
cd "$work/shared"
bake=(a.mtlx --udim auto --size "${SIZE:-768}" --samples "${SAMPLES:-64}")
say "one run"
"$nacre" bake "${bake[@]}" --document one/b.mtlx --quiet > /dev/null 2>&1

say "four shards on three nodes"
export NACRE=$nacre
merge=$("$folder/slurm_bake.sh" 4 --output="$work/log/%x-%A_%a" -- "${bake[@]}" \
  --document farm/b.mtlx)
array=$((merge - 1))
# Once a shard has finished one image and begun another.
for _ in $(seq 600); do
  [ -e farm/nacre-bake.2-of-4.json ] && break
  sleep 0.1
done
lost=$(squeue -h -r -j "${array}_2" -o %N)
[ -n "$lost" ] || { say "shard 2 has ended already: try SAMPLES=256"; exit 1; }
say "shard 2 runs on $lost, which is lost now:"
squeue -r -j "$array" -o "%i %T %N"
# Its daemon, the daemon of the job's step, and what that has started.
job=$(squeue -h -r -j "${array}_2" -o %A)
mapfile -t of_job < <(pgrep -f "^slurmstepd: \[$job\." || true
  for id in $(pgrep -x 'nacre|bash|nacre-compile-w'); do
    grep -qsz "^SLURM_JOB_ID=$job$" "/proc/$id/environ" && echo "$id"
  done || true)
kill -KILL "${node[${lost#n}]}" "${of_job[@]}"
say "killed: slurmd of $lost and ${#of_job[@]} processes of its job;" \
  "partial files left: $(find farm -name '.nacre-*' | wc -l)"

for _ in $(seq 120); do
  state=$(sinfo -h -n "$lost" -o %T)
  [[ $state == down* ]] && break
  sleep 0.5
done
say "$lost is $state; its shard:"
squeue -r -j "$array" -o "%i %T %N %r"
sleep 1
say "$lost comes back"
start_node "${lost#n}"
for _ in $(seq 1200); do
  state=$(scontrol show job "$merge" | sed -n 's/.*JobState=\([A-Z]*\).*/\1/p')
  [[ $state == COMPLETED || $state == FAILED || $state == CANCELLED ]] && break
  sleep 0.5
done
for i in 1 2 3 4; do
  scontrol show job "${array}_$i" | tr ' ' '\n' |
    grep -E '^(ArrayTaskId|JobState|Restarts|NodeList|ExitCode)=' | tr '\n' ' '
  echo
done
say "the merge: $state"
cat "$work"/log/nacre-merge-* "$work/log/nacre-bake-${array}_2" || true
ls -A farm
[ "$state" = COMPLETED ]
restarts=$(scontrol show job "${array}_2" | sed -n 's/.*Restarts=\([0-9]*\).*/\1/p')
[ "$restarts" -ge 1 ]
diff -r -x '*.json' one farm
say "the same bytes as of one run: $(find farm -name '*.exr' | wc -l) images and the document"
