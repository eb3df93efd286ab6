#!/bin/bash
# usage: demo.sh BUILD OUT
# Shows what the nacre tool of a build can do: renders every document beside
# this script on the built-in scene, bakes its graphs, renders what moves, and puts all on
# two sheets.
set -euo pipefail
build=${1:?usage: demo.sh BUILD OUT}
out=${2:?usage: demo.sh BUILD OUT}
here=$(dirname "$0")
size=${DEMO_SIZE:-384}
spp=${DEMO_SPP:-64}
baked=${DEMO_BAKED:-512}
# Matplotlib comes from Debian, so Debian's Python it is.
python=${PYTHON:-/usr/bin/python3}

nacre=$build/bin/nacre
if [[ ! -x $nacre ]]; then
  echo "demo: no nacre tool in $build" >&2
  exit 1
fi
mkdir -p "$out/rendered" "$out/baked"

for document in "$here"/documents/*.mtlx; do
  name=$(basename "$document" .mtlx)
  echo "== $name"
  "$nacre" render "$document" --spp "$spp" --size "$size" --out "$out/rendered/$name.png"
  # Documents without a graph output have nothing to bake.
  if grep -q '<output ' "$document"; then
    "$nacre" bake "$document" --size "$baked" --format png --out "$out/baked/$name"
  fi
done

# A fifth of a second.
echo "== motion"
"$python" "$here/motion/scene.py" "$out/motion.gltf"
"$nacre" render "$here/motion/motion.mtlx" --scene "$out/motion.gltf" --time 0.2 --shutter -0.1 0.1 \
  --spp "$spp" --size "$size" --out "$out/rendered/motion.png"

# More samples: what is within is lit by light that paths happen to meet.
echo "== volumes"
"$nacre" render "$here/volumes/smoke.mtlx" --spp $((2 * spp)) --size "$size" --out "$out/rendered/smoke.png"

echo "== displacement"
"$nacre" render "$here/displacement/pebbles.mtlx" --spp "$spp" --size "$size" \
  --out "$out/rendered/pebbles.png"

# Maps of what only a mesh has: where little light gets to, and where it bulges.
echo "== worn"
"$python" "$here/worn/urn.py" "$out/urn.gltf"
"$nacre" bake "$here/worn/worn.mtlx" --scene "$out/urn.gltf" --mesh urn --size "$baked" --rays 64 \
  --format png --document "$out/worn/worn.mtlx"
"$nacre" render "$out/worn/worn.mtlx" --scene "$out/urn.gltf" --ground --spp "$spp" --size "$size" \
  --out "$out/rendered/worn.png"

# A closed room: light of a window and of a lamp with a measured profile, a floor of cobbles.
echo "== room"
"$python" "$here/room/scene.py" "$out/room.gltf"
"$nacre" render "$here/room/room.mtlx" --scene "$out/room.gltf" --environment-scale 0 --dice 2 \
  --max-depth 8 --spp "$spp" --size "$size" --out "$out/rendered/room.png"

echo "== brushed"
"$python" "$here/brushed/scene.py" "$out/disc.gltf"
"$nacre" render "$here/brushed/disc.mtlx" --scene "$out/disc.gltf" --ground --environment-scale 0.25 \
  --spp "$spp" --size "$size" --out "$out/rendered/disc.png"

# Shares of light, as they are.
echo "== films"
"$python" "$here/films/scene.py" "$out/films.gltf"
"$nacre" render "$here/films/films.mtlx" --scene "$out/films.gltf" --environment-scale 0 --white 0 \
  --spp 16 --size "$size" --out "$out/rendered/films.png"

# Light followed below surfaces, as skin above is too, and beside it the diffuse limit.
echo "== subsurface"
"$python" "$here/subsurface/candle.py" "$out/candle.gltf"
candle=("$here/subsurface/candle.mtlx" --scene "$out/candle.gltf" --ground --environment-scale 0.1)
few=$(((spp + 3) / 4))
"$nacre" render "${candle[@]}" --spp "$spp" --size "$size" --out "$out/rendered/candle_walk.png"
"$nacre" render "${candle[@]}" --subsurface diffuse --spp "$few" --size "$size" \
  --out "$out/rendered/candle_diffuse.png"
"$nacre" render "$here/documents/skin.mtlx" --subsurface diffuse --spp "$few" --size "$size" \
  --out "$out/rendered/skin_diffuse.png"

echo "== lights"
"$nacre" render "$here/lights/room.mtlx" --scene "$here/lights/room.obj" --spp "$spp" --size "$size" \
  --out "$out/rendered/lights.png"
"$python" "$here/lights/strings/strings.py" "$out/strings.obj"
"$nacre" render "$here/lights/strings/strings.mtlx" --scene "$out/strings.obj" --environment-scale 0 \
  --exposure 2 --spp "$spp" --size "$size" --out "$out/rendered/strings.png"

# Paths are long: in and out of glass, drink and ice.
echo "== nested"
"$python" "$here/nested/scene.py" "$out/drink.obj"
"$nacre" render "$here/nested/drink.mtlx" --scene "$out/drink.obj" --ground --spp "$spp" --size "$size" \
  --max-depth 32 --out "$out/rendered/drink.png"

# Thirty thousand of them.
echo "== hair"
"$python" "$here/fibres/ball.py" "$out/ball.hair"
"$nacre" render "$here/fibres/hair.mtlx" --scene "$out/ball.hair" --ground --spp "$spp" --size "$size" \
  --max-depth 24 --out "$out/rendered/hair.png"

"$python" "$here/contact_sheet.py" "$out/rendered.png" "$out"/rendered/*.png --columns 5 --size 208
for picture in "$out"/baked/*/*.png; do
  cp "$picture" "$out/baked/$(basename "$(dirname "$picture")").$(basename "$picture" .png | sed 's/^[^.]*\.//').png"
done
"$python" "$here/contact_sheet.py" "$out/baked.png" "$out"/baked/*.png --columns 5 --size 192

echo
echo "Pictures:"
find "$out" -maxdepth 2 -name '*.png' | sort
