#!/bin/bash
# usage: slurm_bake.sh SHARDS [SBATCH OPTION]... -- FILE.mtlx [OPTION OF nacre bake]...
#
# Shares a bake among the elements of a Slurm array, and puts together what they make once all
# have ended well. Prints the number of the job that does that: its exit status is the bake's.
#
#   slurm_bake.sh 32 --cpus-per-task=8 --mem=2G -- wall.mtlx --udim auto --size 4096 --out /shared/wall
set -euo pipefail
folder=$(cd "$(dirname "$0")" && pwd)
shards=$1
shift
of_sbatch=()
while [ "$1" != -- ]; do
  of_sbatch+=("$1")
  shift
done
shift

bake=$(sbatch --parsable "${of_sbatch[@]}" --array="1-$shards" "$folder/bake_shard.sbatch" "$@")
merge=(exec "${NACRE:-nacre}" bake "$@" --quiet --merge "$shards")
sbatch --parsable "${of_sbatch[@]}" --job-name=nacre-merge --dependency="afterok:$bake" \
  --kill-on-invalid-dep=yes --wrap="$(printf '%q ' "${merge[@]}")"
