#!/bin/bash
# usage: demo.sh BUILD OUT
# Shows what the nacre tool of a build can do; pictures go to OUT.
set -euo pipefail
build=${1:?usage: demo.sh BUILD OUT}
out=${2:?usage: demo.sh BUILD OUT}

nacre=$(find "$build" -type f -name nacre -perm -u+x -print -quit)
if [[ -z $nacre ]]; then
  echo "demo: no nacre tool in $build" >&2
  exit 1
fi
mkdir -p "$out"

for document in "$(dirname "$0")"/documents/*.mtlx; do
  [[ -e $document ]] || continue
  echo "== $document"
  "$nacre" bake "$document" --size 512 --format png --out "$out/$(basename "$document" .mtlx)"
done

echo "Pictures:"
find "$out" -type f \( -name '*.png' -o -name '*.exr' \) | sort
