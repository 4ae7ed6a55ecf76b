#!/usr/bin/env bash
# Tests patterns.cmake: it translates all of the renderer's patterns for Godot, fails at a line that it cannot
# translate, and replaces the files atomically and only if they change.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failed=0
wrong() { echo "FAILED: $1" >&2; failed=1; }
out=$work/out/patterns.gdshaderinc
mkdir "$work/out"
make() { cmake -DSHADERS="$1" -DOUTPUT="$work/out" -P "$root/editor_plugin/patterns.cmake" >"$work/log" 2>&1; }

make "$root/shaders" || wrong "the patterns are not made: $(cat "$work/log")"
# Each pattern of the enum SurfacePattern must have a branch in the result.
count=$(sed -n '/^enum class SurfacePattern/,/^};/p' "$root/runtime/tools/materials/material.h" | grep -cE '^  [a-z_]+,')
((count > 20)) || wrong "only $count patterns are found in material.h"
for ((i = 0; i < count; ++i)); do
  grep -q "defined(SGM_PATTERN_$i)$" "$out" || wrong "pattern $i is not there"
done
touch -d '2001-01-01' "$out"
make "$root/shaders" || wrong "the patterns are not made again"
[[ $(stat -c %Y "$out") == $(date -d '2001-01-01' +%s) ]] || wrong "the same text is written again"

# refused WHAT FILE SED: with a changed line, patterns.cmake must fail, name the file, and leave the previous result.
refused() {
  rm -rf "$work/shaders"
  cp -r "$root/shaders" "$work/shaders"
  sed -i "$3" "$work/shaders/render/$2"
  ! cmp -s "$root/shaders/render/$2" "$work/shaders/render/$2" || wrong "$1: nothing was changed"
  ! make "$work/shaders" || wrong "$1 goes through"
  grep -q "$2" "$work/log" || wrong "$1: the message does not name the file: $(cat "$work/log")"
}
refused "a pattern that asks for another one" materials.glsl 's/has(7u)/has(8u)/'
refused "a pattern that is asked for in another way" materials.glsl 's/if (pattern == 7u/if (7u == pattern/'
refused "another declaration of the patterns" materials.glsl 's/constant_id = 0/constant_id = 5/'
refused "a name that shaders ask for and is gone" patterns.h 's/kLeafy/kLeaves/'
refused "a line that goes on in the next one" materials.glsl 's/return paving(at);/return \\/'
refused "what Godot has nothing like" cloud_layer.glsl '$abuffer Clouds { float base; };'
refused "an attribute that Godot has nothing like" noise.glsl 's/dont_unroll/unroll/'
refused "a vector of whole numbers" noise.glsl '$avec2 corner(vec2 a) { return a + vec2(1, 0); }'
cmp -s <(ls "$work/out") <(printf '%s\n' clouds.gdshaderinc patterns.gdshaderinc) || wrong "files are left behind: $(ls "$work/out")"
make "$root/shaders" || wrong "the patterns are not made in the end"
[[ $(stat -c %Y "$out") == $(date -d '2001-01-01' +%s) ]] || wrong "a failure has changed the file"
exit "$failed"
