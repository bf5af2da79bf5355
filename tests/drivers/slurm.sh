#!/usr/bin/env bash
# tests/drivers/slurm.sh [--kill]
# The Slurm recipe on a cluster of two nodes on this machine: the merged film has the bytes of one process. With --kill
# one node is killed with its task in the middle, which takes Slurm four minutes to mend. As root; installs Debian's
# slurm-wlm where it is missing. TRIAD names the program (default: build/bin/triad).
set -euo pipefail
root=$(cd "$(dirname "$0")/../.." && pwd)
export TRIAD=${TRIAD:-$root/build/bin/triad}
kill=0
[[ ${1:-} == --kill ]] && kill=1
if ! command -v slurmd >/dev/null && ((EUID == 0)); then
    echo "slurm.sh: installing slurm-wlm" >&2
    DEBIAN_FRONTEND=noninteractive apt-get -qq install -y --no-install-recommends slurm-wlm >/dev/null || true
fi
for program in slurmctld slurmd sbatch; do
    command -v $program >/dev/null || { echo "slurm.sh: there is no $program (apt-get install slurm-wlm)" >&2; exit 77; }
done
folder=$(mktemp -d)
cleanup() {
    exec 2>/dev/null # bash tells of every daemon that it kills
    pkill -KILL -f "$folder" || true
    rm -rf "$folder"
}
trap cleanup EXIT
mkdir "$folder/state" "$folder/spool-n1" "$folder/spool-n2"
plugins=$(dirname "$(find /usr/lib -name cred_none.so | head -n 1)")
cat >"$folder/slurm.conf" <<CONF
ClusterName=test
SlurmctldHost=localhost
SlurmctldPort=26817
SlurmUser=root
SlurmdUser=root
AuthType=auth/none
CredType=cred/none
PluginDir=$plugins
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
MpiDefault=none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
ReturnToService=2
SlurmdTimeout=10
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool-%n
SlurmctldPidFile=$folder/ctld.pid
SlurmdPidFile=$folder/%n.pid
SlurmctldLogFile=$folder/ctld.log
SlurmdLogFile=$folder/%n.log
NodeName=n1 NodeHostname=localhost Port=26818 CPUs=1 State=UNKNOWN
NodeName=n2 NodeHostname=localhost Port=26819 CPUs=1 State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
CONF
export SLURM_CONF=$folder/slurm.conf
slurmctld -D -f "$SLURM_CONF" >"$folder/ctld.out" 2>&1 &
slurmd -D -N n1 -f "$SLURM_CONF" >"$folder/n1.out" 2>&1 &
slurmd -D -N n2 -f "$SLURM_CONF" >"$folder/n2.out" 2>&1 &
n2=$!
for ((i = 0; i < 60; ++i)); do
    [[ $(sinfo -h -t idle -o %D 2>/dev/null) == 2 ]] && break
    sleep 0.5
done
[[ $(sinfo -h -t idle -o %D) == 2 ]] || { echo "slurm.sh: the nodes do not come up" >&2; tail -n 5 "$folder"/*.log "$folder"/*.out >&2; exit 1; }

options=(--size 256x256 --seed 5 --threads 1)
spp=768
"$TRIAD" render "${options[@]}" --spp $spp --film "$folder/whole.film" -q
started=$SECONDS
cd "$folder"
"$root/docs/recipes/slurm/render.sh" -n $spp -k 4 -f "$folder/picture" -- "${options[@]}" >"$folder/submitted"
if ((kill)); then
    for ((i = 0; i < 100; ++i)); do # until the second node has a task
        squeue -h -t R -o %N | grep -q n2 && break
        sleep 0.1
    done
    sleep 2
    task=$(squeue -h -t R -w n2 -o %i | head -n 1)
    echo "task $task is killed with its node"
    share=${task##*_}
    pkill -KILL -f "share-$share.film" || true
    pkill -KILL -f "slurmstepd.*${task%%_*}" || true
    kill -KILL "$n2"
    sleep 20
    slurmd -D -N n2 -f "$SLURM_CONF" >>"$folder/n2.out" 2>&1 & # it comes back
fi
limit=$((kill ? 600 : 120))
while [[ ! -e $folder/picture/picture.exr ]]; do
    ((SECONDS - started < limit)) || { echo "slurm.sh: not done after $limit s" >&2; squeue >&2; tail -n 20 "$folder"/picture/*.log "$folder/ctld.log" >&2; exit 1; }
    sleep 0.5
done
cmp "$folder/whole.film" "$folder/picture/picture.film"
grep -h "submitted again" "$folder/picture/merge.log" || true
echo "The merged film has the bytes of one process; $((SECONDS - started)) s."
