#!/usr/bin/env bash
# One share of a bake as an array job of any scheduler, and the end of it. With Slurm there is sgm bake --slurm.
#
#   share.sh SHARES sgm bake FILE.sgm ... --out STORE     the share that the scheduler's own number says
#   share.sh end sgm bake FILE.sgm ... --out STORE        when all shares have ended well: merges, and verifies
#
#   PBS, OpenPBS:   qsub -J 0-15 -- share.sh 16 sgm bake ...        then   qsub -W depend=afterok:ID -- share.sh end sgm bake ...
#   Grid Engine:    qsub -t 1-16 share.sh 16 sgm bake ...           then   qsub -hold_jid ID share.sh end sgm bake ...
#   LSF:            bsub -J 'bake[1-16]' share.sh 16 sgm bake ...   then   bsub -w 'done(bake)' share.sh end sgm bake ...
#   by hand:        SHARE=3 share.sh 16 sgm bake ...
#
# Shares need the same STORE: a folder that all machines see. One that has failed, or was stopped, is just run again.
set -euo pipefail
shares=${1:?the number of shares, or end}
shift

if [[ $shares == end ]]; then
  "$@" --merge
  while (($# > 0)) && [[ $1 != --out && $1 != --out=* ]]; do shift; done
  if [[ ${1:-} == --out ]]; then exec sgm store verify "$2"; fi
  exec sgm store verify "${1#--out=}"
fi
if [[ -n ${SHARE:-} ]]; then share=$SHARE
elif [[ -n ${JOB_COMPLETION_INDEX:-} ]]; then share=$JOB_COMPLETION_INDEX             # Kubernetes, from 0
elif [[ -n ${PBS_ARRAY_INDEX:-${PBS_ARRAYID:-}} ]]; then share=${PBS_ARRAY_INDEX:-$PBS_ARRAYID}  # from 0, as above
elif [[ ${SGE_TASK_ID:-undefined} != undefined ]]; then share=$((SGE_TASK_ID - 1))    # from 1
elif [[ ${LSB_JOBINDEX:-0} != 0 ]]; then share=$((LSB_JOBINDEX - 1))                  # from 1
else
  echo "share.sh: error: no scheduler says which share this is: set SHARE, from 0 to $((shares - 1))" >&2
  exit 2
fi
exec "$@" --shard "$share/$shares"
