#!/bin/bash
# usage: xargs_bake.sh SHARDS JOBS FILE.mtlx [OPTION OF nacre bake]...
#
# Shares a bake among SHARDS runs on this machine, JOBS of them at a time, and puts together what
# they make. Run again after a failure it bakes what is missing. Where ssh reaches other machines
# that share the disk, the line with `bash -c` is the one to change.
set -euo pipefail
shards=$1
jobs=$2
shift 2
nacre=${NACRE:-nacre}
cores=$(nproc)
threads=$((cores > jobs ? cores / jobs : 1))

seq "$shards" | xargs -P "$jobs" -I {} \
  bash -c 'exec "$0" bake "${@:2}" --quiet --shard "$1"' "$nacre" "{}/$shards" "$@" \
  --threads "$threads"
"$nacre" bake "$@" --quiet --merge "$shards"
