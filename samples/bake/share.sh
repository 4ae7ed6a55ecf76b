#!/usr/bin/env bash
# Bakes one share of a world as a task of an array job, or completes the bake. For Slurm use sgm bake --slurm instead.
#
#   share.sh SHARES sgm bake FILE.sgm ... --out STORE     bakes the share whose number the scheduler sets
#   share.sh end sgm bake FILE.sgm ... --out STORE        when all shares have succeeded: merges and verifies them
#
# With S=/where/it/is/share.sh:
#
#   PBS, OpenPBS:   qsub -J 0-15 -- $S 16 sgm bake ...      then   qsub -W depend=afterok:'ID[]' -- $S end sgm bake ...
#   Torque:         echo "$S 16 sgm bake ..." | qsub -t 0-15 then  echo "$S end sgm bake ..." | qsub -W depend=afterokarray:'ID[]'
#   Grid Engine:    qsub -S /bin/bash -cwd -t 1-16 $S 16 sgm bake ...   then   qsub -S /bin/bash -cwd -hold_jid ID $S end sgm bake ...
#   LSF:            bsub -J 'bake[1-16]' $S 16 sgm bake ...   then   bsub -w 'done(bake)' $S end sgm bake ...
#   by hand:        SHARE=3 $S 16 sgm bake ...
#
# All calls need the same command, and the same STORE, a folder that all machines can access. A failed or interrupted
# share can be run again.
set -euo pipefail
fail() { echo "share.sh: error: $1 ('head -n 20 $0' shows its use)" >&2 && exit 2; }
(($# > 1)) || fail "say the number of shares, or 'end', and the command that bakes"
shares=$1
shift
[[ $shares == end || $shares =~ ^[1-9][0-9]*$ ]] || fail "'$shares' is neither a number of shares nor 'end'"
[[ ${PBS_ENVIRONMENT:-} != PBS_BATCH ]] || cd "$PBS_O_WORKDIR"  # PBS starts jobs in the user's home folder

if [[ $shares == end ]]; then
  "$@" --merge
  words=("$@") program=() store=
  for ((i = 0; i < $#; ++i)); do
    case ${words[i]} in
      bake) program=("${words[@]:0:i}") ;;  # the words before the last "bake" are the program
      --out) store=${words[i + 1]:-} && break ;;
      --out=*) store=${words[i]#--out=} && break ;;
    esac
  done
  ((${#program[@]} > 0)) && [[ -n $store ]] || fail "to verify it takes 'sgm bake' and --out in the command"
  exec "${program[@]}" store verify "$store"
fi
if [[ -n ${JOB_COMPLETION_INDEX:-} ]]; then share=$JOB_COMPLETION_INDEX  # set by Kubernetes; counts from 0
elif [[ -n ${PBS_ARRAY_INDEX:-} ]]; then share=$PBS_ARRAY_INDEX  # counts from 0
elif [[ -n ${PBS_ARRAYID:-} ]]; then share=$PBS_ARRAYID  # set by Torque; counts from 0
elif [[ ${SGE_TASK_ID:-undefined} != undefined ]]; then share=$((SGE_TASK_ID - 1))  # counts from 1
elif [[ ${LSB_JOBINDEX:-0} != 0 ]]; then share=$((LSB_JOBINDEX - 1))  # counts from 1
elif [[ -n ${SHARE:-} ]]; then share=$SHARE
else fail "no scheduler says which share this is: set SHARE, from 0 to $((shares - 1))"
fi
exec "$@" --shard "$share/$shares"
