#!/bin/bash
# usage: try_xargs.sh NACRE RECIPE
#
# Five shards, two at a time, with a run before them that is killed; then compared with one run.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
cat > a.mtlx << EOF
<materialx version="1.39">
  <nodegraph name="G">
    <noise2d name="n" type="color3"/><noise2d name="m" type="float"/>
    <output name="o" type="color3" nodename="n"/><output name="p" type="float" nodename="m"/>
  </nodegraph>
</materialx>
EOF
bake=(a.mtlx --udim 1001,1002,1013 --size 256 --cache "$work/cache")
"$1" bake "${bake[@]}" --out one --quiet > /dev/null 2>&1
timeout --signal=KILL 0.3 "$1" bake "${bake[@]}" --out farm --shard 1/5 > /dev/null 2>&1 || true
NACRE=$1 "$2" 5 2 "${bake[@]}" --out farm > /dev/null 2>&1
diff -r -x '*.json' one farm
[ "$(find one -name '*.exr' | wc -l)" = 6 ]
# What is missing ends it.
rm farm/G.o.1002.exr farm/nacre-bake.json
if "$1" bake "${bake[@]}" --out farm --merge 5 > /dev/null 2> said; then exit 1; fi
grep -q 'G.o.1002.exr (it is gone)' said
