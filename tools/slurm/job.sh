#!/usr/bin/env bash
# The job that tools/slurm/submit submits: the tasks of an array, and the merge after them. By hand:
#   sbatch --array=0-63 tools/slurm/job.sh task PROGRAM LIST FOLDER SHARDS 64 [OPTIONS OF vkhausdorff batch]
#   sbatch --dependency=afterany:ARRAY tools/slurm/job.sh merge PROGRAM LIST FOLDER [OPTIONS OF vkhausdorff merge]
# Paths are absolute, on file systems that all nodes share. Task i of 64 does shards i, i + 64, i + 128 ... of SHARDS.
#
# The end of a task:
#   killed program  say for memory: the task is requeued, and goes on after the last whole line
#   time limit      USR1 comes two minutes before it: the batch ends, and the task is requeued
#   preempted       TERM: the batch ends; Slurm requeues the task, where the partition's PreemptMode says so
#   cancelled       TERM: the batch ends; submit again to go on
#   lost node       Slurm requeues the task; it waits for a former process that lives on
#   exit codes      those of `vkhausdorff batch`, the worst of the task's shards; none of them is requeued
#SBATCH --job-name=vkhausdorff
#SBATCH --requeue
#SBATCH --open-mode=append
#SBATCH --signal=B:USR1@120
set -euo pipefail

kTries=3          # so often in a row a task is requeued that has written no new line
kLockSeconds=600  # approximate wait of a task for its own former process

say() { echo "$(date +%FT%T) $(hostname) ${task:+task $task: }$*"; }

# The worst of a batch's codes is the first of 5 4 6 2 1 3 0 among them. Any other code is worse.
worst() {
  local code known
  for code; do
    [[ $code == [0-6] ]] || { echo "$code"; return; }
  done
  for known in 5 4 6 2 1 3 0; do
    for code; do
      [ "$code" != $known ] || { echo $known; return; }
    done
  done
}

# A trap runs this: a task that stops gives the program time to end with whole lines.
# shellcheck disable=SC2317
stop() {
  stopped=$1
  [ -z "$child" ] || kill -TERM "$child" 2>/dev/null || true
}

# Any other end is this script's own failure, such as a full disk. Bash would return 1, which is
# FAIL.
trap 'exit 6' EXIT
end() {
  trap - EXIT
  exit "$1"
}

# Waits until no process writes a shard's results; `batch` would be refused. It checks for a signal
# each second.
wait_for_former() {
  local code=75 left=$kLockSeconds
  while [ $code = 75 ] && [ -z "$stopped" ] && [ "$left" -gt 0 ]; do
    code=0
    flock --wait 1 --conflict-exit-code 75 "$1" true || code=$?
    [ $code != 75 ] || [ "$left" != $kLockSeconds ] || say "waits for another process that writes $1"
    left=$((left - 1))
  done
  [ $code != 75 ] || [ -n "$stopped" ] || say "another process still writes $1"
  [ $code != 75 ] && [ -z "$stopped" ]
}

# Vulkan does not heed CUDA_VISIBLE_DEVICES: if a site's cgroups do not hide the others, each task would take the best.
warn_of_other_gpus() {
  local file open=0
  for file in /dev/nvidia[0-9]*; do
    if { : <"$file"; } 2>/dev/null; then open=$((open + 1)); fi
  done
  [ $open -le "${SLURM_GPUS_ON_NODE:-$open}" ] ||
    say "$open GPUs are open to a task of $SLURM_GPUS_ON_NODE: docs/clusters.md says what to do"
}

# The number of lines of the task's shards, from all attempts.
lines() {
  local shard count=0
  for ((shard = task; shard < shards; shard += tasks)); do
    [ ! -e "$folder/results-$shard.jsonl" ] || count=$((count + $(wc -l <"$folder/results-$shard.jsonl")))
  done
  echo $count
}

# Runs one shard and leaves its exit code in `code`. If a trap breaks off bash's wait, the next one
# may return -1 in place of the code (bash 5.2.15: of one child in five that a signal ended together
# with this script). So it checks each second.
run_shard() {
  local results=$folder/results-$1.jsonl
  if ! wait_for_former "$results"; then
    code=6
    [ -z "$stopped" ] || code=3
    return
  fi
  "$program" batch "$list" --out "$results" --shard "$1/$shards" --resume "${@:2}" &
  child=$!
  [ -z "$stopped" ] || kill -TERM "$child" 2>/dev/null || true  # it came before there was a child
  while kill -0 "$child" 2>/dev/null; do { sleep 1 || true; } 2>/dev/null; done
  code=0
  wait "$child" || code=$?
  child=''
}

# Requeues the task by its name in the array: the last task's SLURM_JOB_ID is that of the whole
# array.
requeue() {
  local now was=-1 times=0
  now=$(lines)
  [ ! -e "$folder/tries-$task" ] || read -r was times <"$folder/tries-$task"
  [ "$now" = "$was" ] || times=0
  [ "$times" -lt $kTries ] || { say "$1: $kTries requeues brought no line, and there is no other"; return; }
  echo "$now $((times + 1))" >"$folder/tries-$task"
  say "$1 after $now lines: requeued"
  scontrol requeue "${SLURM_ARRAY_JOB_ID}_$task" || { say "Slurm does not requeue it"; return; }
  end 0  # Slurm ends it, if it has not yet
}

run_task() {
  local shards=$1 tasks=$2 shard code codes=() killed=''
  shift 2
  task=$SLURM_ARRAY_TASK_ID child='' stopped=''
  trap 'stop limit' USR1
  trap 'stop ended' TERM
  [ -d "$folder" ] || { say "no $folder on this node: is it on a shared file system?"; end 6; }
  export LP_NUM_THREADS="${LP_NUM_THREADS:-$SLURM_CPUS_ON_NODE}"  # lavapipe takes all that it sees
  warn_of_other_gpus
  rm -f "$folder/code-$task"
  for ((shard = task; shard < shards; shard += tasks)); do
    [ -z "$stopped" ] || { codes+=(3); break; }
    run_shard $shard "$@"
    say "shard $shard/$shards: exit code $code"
    [ $code -lt 128 ] || { killed=$((code - 128)); code=3; }  # unfinished pairs are not closed
    codes+=("$code")
  done
  [ "$stopped" != limit ] || requeue "told that its time ends"
  { [ -n "$stopped" ] || [ -z "$killed" ]; } || requeue "killed by signal $killed"
  worst "${codes[@]}" >"$folder/code-$task.new"
  mv "$folder/code-$task.new" "$folder/code-$task"
  end "$(<"$folder/code-$task")"
}

# Exits with the worst of the pairs and the tasks: a task without a device, say, has no line that shows it.
run_merge() {
  local code=0 file codes=() files=("$folder"/results-*.jsonl)
  [ -e "${files[0]}" ] || { say "no task wrote anything: see $folder/logs"; end 3; }
  "$program" merge "${files[@]}" --list "$list" --out "$folder/all.jsonl" --csv="$folder/all.csv" --junit="$folder/all.xml" "$@" ||
    code=$?
  for file in "$folder"/code-*; do
    [ ! -e "$file" ] || codes+=("$(<"$file")")
  done
  end "$(worst "$code" "${codes[@]}")"
}

mode=$1 program=$2 list=$3 folder=$4 task=''
shift 4
case $mode in
  task) run_task "$@" ;;
  merge) run_merge "$@" ;;
  *) echo "job.sh: task or merge, not $mode" >&2; end 2 ;;
esac
