#!/usr/bin/env bash
# On a bare Debian 12, as root or with sudo: meshes 192 m of the infinite cave, draws a picture inside it, then flies
# through the streamed cave for 20 seconds of game time. Installs missing packages, and prints their names.
#
#   bash samples/demo.sh [--no-install]
#
#   --no-install    installs nothing: stops if a package is missing, and prints its name
#
# Writes out/demo/cave.glb, out/demo/cave.png and out/demo/flight.png.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root"
die() { echo "samples/demo.sh: error: $1" >&2; exit 1; }

source samples/setup_debian.sh
case "$#$*" in
  0) sgm_setup "${SGM_BUILD_PACKAGES[@]}" ;;
  1--no-install) sgm_need "${SGM_BUILD_PACKAGES[@]}" ;;
  *) die "usage: bash samples/demo.sh [--no-install]" ;;
esac

mkdir -p build out/demo
log=build/demo.log

# Shows the progress of a build: on a terminal in one changing line, otherwise with a line for each tenth of it.
show_progress() {
  local line done all tenth last=-1
  while IFS= read -r line; do
    printf '%s\n' "$line" >>"$log"
    [[ $line =~ ^\[([0-9]+)/([0-9]+)\] ]] || continue
    done=${BASH_REMATCH[1]} all=${BASH_REMATCH[2]}
    tenth=$((10 * done / all))
    if [[ -t 1 ]]; then
      printf '\rdemo: built %d of %d parts, %d s ' "$done" "$all" $((SECONDS - started))
    elif ((tenth > last && all > 10)); then
      printf 'demo: built %d of %d parts, %d s\n' "$done" "$all" $((SECONDS - started))
      last=$tenth
    fi
  done
  [[ ! -t 1 || -z ${all:-} ]] || echo
}

if [[ ! -f build/release/build.ninja ]]; then
  echo "demo: configuring build/release with the core commands (cmake --preset release adds the rest)"
  # The CUDA kernels take long to compile, so they are built only if a driver that could run them is installed.
  cuda=OFF
  [[ $(/sbin/ldconfig -p 2>/dev/null) != *libcuda.so.1* ]] || cuda=AUTO
  cmake --preset release -D SGM_TOOLS=core -D SGM_CUDA=$cuda -D SGM_SERVICE=OFF -D SGM_BUILD_TESTS=OFF -D SGM_BUILD_BENCH=OFF \
    -D SGM_BUILD_SAMPLES=OFF >"$log" 2>&1 || {
    cat "$log" >&2
    die "configuring failed"
  }
fi
[[ -x build/release/bin/sgm ]] || echo "demo: building build/release/bin/sgm, which takes some minutes the first time"
started=$SECONDS
: >"$log"
# The library is built too: it is linked from the same objects as the command, and then both can be installed.
cmake --build --preset release --target sgm_cli sgm 2>&1 | show_progress || {
  cat "$log" >&2
  die "building failed"
}

sgm=build/release/bin/sgm
cave=samples/grammars/cave.sgm
region=0,-8,0:192,16,192
"$sgm" mesh "$cave" --out out/demo/cave.glb --region "$region" --cell 0.25 --seed 3
"$sgm" render "$cave" --out out/demo/cave.png --region "$region" --cell 0.25 --seed 3 --size 1600x900
"$sgm" fly "$cave" --cell 0.25 --seed 3 --speed 20 --frames 1200 --png 6 --out out/demo/flight.png

echo
echo "Mesh:    $root/out/demo/cave.glb (opens in Blender, Godot, any glTF viewer)"
echo "Picture: $root/out/demo/cave.png"
echo "Flight:  $root/out/demo/flight.png"
