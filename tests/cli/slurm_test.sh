#!/usr/bin/env bash
# Tests sgm bake --slurm on a real Slurm cluster of three nodes: its store must equal that of a single process, even if
# a node dies during the bake.
source "$(dirname "$0")/slurm_cluster.sh"
source "$(dirname "$0")/common.sh"
cave=$SOURCE/tests/bench/grammars/cave.sgm
world=("$cave" --seed 3 --region 0,0,0:512,512,256 --levels 0..6 --cell 0.25 --backend cpu)

# Without Slurm, there must be one clear error.
expect 4 env PATH=/nowhere "$SGM" bake "$cave" --seed 3 --region 0,0,0:64,64,64 --levels 0 --backend cpu --out none --slurm 2
err_has 'sbatch cannot be run'
err_has 'samples/bake'
one_line
rm -r none
# If only a part of Slurm is installed, there must also be one clear error: it names the missing command.
mkdir part
printf '#!/bin/sh\necho 1\n' >part/sbatch
chmod +x part/sbatch
expect 4 env PATH="$PWD/part" "$SGM" bake "$cave" --seed 3 --region 0,0,0:64,64,64 --levels 0 --backend cpu --out none --slurm 2
err_has 'squeue cannot be run'
rm -r none part

skip() {
  echo "skipped: $1"
  exit 77
}
for program in slurmctld slurmd sbatch munged; do
  [[ -n $(command -v $program) ]] || skip "$program is missing: install slurm-wlm and munge"
done
((EUID == 0)) || skip "a cluster of one machine needs root"
trap 'cluster_stop; cleanup' EXIT
if ! cluster_start "$work/cluster" 3; then
  failed "the cluster does not start: $(tail -n 3 "$work"/cluster/log/*.log 2>&1)"
  finish
fi

expect 0 "$SGM" bake "${world[@]}" --out alone
expect 0 "$SGM" bake "${world[@]}" --out shared --slurm 7 --json
json 'j.baked && j.failed === 0 && j.merge === "COMPLETED" && j.verification === "COMPLETED"'
err_has 'are submitted'
expect 0 diff -r -x slurm alone shared
expect 0 bash -c 'grep -h "complete and closed" shared/slurm/*/verify.txt'
expect 0 "$SGM" bake "${world[@]}" --out shared --slurm 7
out_has 'already baked'

# Kills a node while it bakes: Slurm must restart the shard of this node on another node, even if the other shards ended
# long before.
expect 0 "$SGM" bake "${world[@]}" --out hurt --slurm 3 --detach
out_has '0 failed'
cluster_kill_node_of "$work/hurt.*--shard [0-9]+/3" || failed "no shard has been met"
# Slurm delays the restart of a dead node's shard by two minutes; this loop makes Slurm restart it at once.
(
  for _ in $(seq 120); do
    sleep 0.5
    squeue -h -r -t PENDING -o '%i %r' | while read -r job reason; do
      [[ $reason != BeginTime ]] || scontrol update JobId="$job" StartTime=now
    done
  done
) >/dev/null 2>&1 &
hurry=$!
# A bake in progress must not be started again, whatever number of shards is given.
expect 0 "$SGM" bake "${world[@]}" --out hurt --slurm 5 --detach --json
err_has 'are under way'
json 'j.shards === 3'
expect 0 "$SGM" bake "${world[@]}" --out hurt --slurm 3 --json
err_has 'are under way'
json 'j.baked && j.failed === 0 && j.verification === "COMPLETED"'
kill $hurry
expect 0 diff -r -x slurm alone hurt
grep -q "Requeuing\|requeue" cluster/log/slurmctld.log || failed "no shard was started anew"

# If sbatch refuses a job, its own message must be reported, and no job must be left in the queue.
expect 4 "$SGM" bake "$cave" --seed 3 --region 0,0,0:64,64,64 --levels 0 --backend cpu --out none --slurm 2 \
  --sbatch=--partition=none
err_has 'invalid partition'
[[ ! $err =~ samples/bake ]] || failed "where there is a Slurm, other schedulers are named"
[[ -z $(squeue -h) ]] || failed "jobs wait: $(squeue)"
finish
