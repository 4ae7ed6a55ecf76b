# Sourced by tests: starts a real Slurm cluster of several nodes on this one machine, as processes of our own that end
# with the caller's shell. Needs root, and Debian's packages slurm-wlm and munge. The system's own munge and Slurm stay
# untouched.

# cluster_start FOLDER NODES: starts the cluster in FOLDER, and sets SLURM_CONF.
cluster_start() {
  cluster=$1
  local nodes=$2 host
  host=$(hostname -s)
  mkdir -p "$cluster"/{spool,state,log,munge}
  chmod 700 "$cluster/munge"
  (umask 077 && head -c 1024 /dev/urandom >"$cluster/munge/key")
  munged --force --key-file="$cluster/munge/key" --socket="$cluster/munge/socket" --pid-file="$cluster/munge/pid" \
    --log-file="$cluster/munge/log" --seed-file="$cluster/munge/seed" || return 1
  export SLURM_CONF=$cluster/slurm.conf
  cat >"$SLURM_CONF" <<CONF
ClusterName=test
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=27817
AuthType=auth/munge
AuthInfo=socket=$cluster/munge/socket
CredType=cred/munge
SlurmUser=root
SlurmdUser=root
StateSaveLocation=$cluster/state
SlurmdSpoolDir=$cluster/spool/%n
SlurmctldPidFile=$cluster/slurmctld.pid
SlurmdPidFile=$cluster/slurmd-%n.pid
SlurmctldLogFile=$cluster/log/slurmctld.log
SlurmdLogFile=$cluster/log/%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
ReturnToService=2
MpiDefault=none
SlurmdTimeout=5
NodeName=n[1-$nodes] NodeHostname=$host NodeAddr=127.0.0.1 Port=[27001-$((27000 + nodes))] CPUs=1 State=UNKNOWN
PartitionName=main Nodes=n[1-$nodes] Default=YES MaxTime=INFINITE State=UP
CONF
  slurmctld || return 1
  local i
  for i in $(seq "$nodes"); do
    mkdir -p "$cluster/spool/n$i"
    slurmd -N "n$i" || return 1
  done
  for _ in $(seq 60); do
    [[ $(sinfo -h -t idle -o %D 2>/dev/null) == "$nodes" ]] && return 0
    sleep 0.5
  done
  return 1
}

# cluster_kill_node_of PATTERN: waits for a process of a job whose command line matches, and kills all processes of its
# node, as a power failure would; sets `victim` to the node's name. Status 1 if no such process appeared.
cluster_kill_node_of() {
  local pid parent
  victim=
  for _ in $(seq 1500); do
    for pid in $(pgrep -f -- "$1"); do
      victim=$(tr '\0' '\n' <"/proc/$pid/environ" 2>/dev/null | sed -n 's/^SLURMD_NODENAME=//p')
      [[ -z $victim ]] || break 2
    done
    sleep 0.02
  done
  [[ -n $victim ]] || return 1
  # Kill slurmstepd first, since it would report the end of the job to the controller.
  parent=$(sed -n 's/^PPid:\t//p' "/proc/$pid/status" 2>/dev/null)
  [[ $(cat "/proc/$parent/comm" 2>/dev/null) == slurmstepd ]] || return 1
  kill -9 "$parent" "$(<"$cluster/slurmd-$victim.pid")" "$pid"
}

cluster_stop() {
  local file
  for file in "$cluster"/slurmctld.pid "$cluster"/slurmd-*.pid "$cluster"/munge/pid; do
    [[ -s $file ]] && kill "$(<"$file")" 2>/dev/null
  done
  for file in "$cluster"/slurmctld.pid "$cluster"/slurmd-*.pid "$cluster"/munge/pid; do
    for _ in $(seq 50); do
      [[ -s $file ]] && kill -0 "$(<"$file")" 2>/dev/null || break
      sleep 0.1
    done
  done
  return 0
}
