#!/usr/bin/env bash
# Tests that divergence.mjs finds the bugs in small test shaders, and that it finds none in the library's shaders.
#   divergence_test.sh SPIRV-DIS GLSLANG FOLDER-OF-SPIRV
set -euo pipefail
here=$(dirname "$0") dis=$1 glslang=$2 shaders=$3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# check EXPECTED-STATUS NAME BODY-OF-MAIN [FUNCTIONS]: compiles a shader with this main function and runs divergence.mjs
# on it.
check() {
  cat >"$work/$2.comp" <<END
#version 450
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_shuffle : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#extension GL_KHR_shader_subgroup_clustered : require
layout(local_size_x = 32) in;
layout(std430, binding = 0) buffer Words { uint words[]; };
uint kept;
uint word(uint i) { return subgroupShuffle(kept, i); }
${4-}
void main() {
  uint lane = gl_LocalInvocationID.x, group = gl_WorkGroupID.x, sum = 0u;
  kept = words[lane];
  $3
  words[lane] = sum;
}
END
  "$glslang" -V --quiet --target-env vulkan1.2 -o "$work/$2.spv" "$work/$2.comp"
  local status=0
  node "$here/divergence.mjs" "$dis" "$work/$2.spv" >"$work/out" || status=$?
  [[ $status == "$1" ]] && return
  echo "$2: status $status instead of $1"
  cat "$work/out"
  exit 1
}

check 3 right_of_and 'bool both = lane < 3u && word(1u) > 2u; if (both) sum = 1u;'
check 3 right_of_or 'bool one = kept < 3u || word(1u) > 2u; if (one) sum = 1u;'
check 3 choice 'sum = (lane & 1u) == 0u ? word(1u) : 2u;'
check 3 branch 'if (lane > group) sum = word(2u);'
check 3 deep 'if (kept == 0u) sum = twice(1u);' 'uint twice(uint i) { return 2u * word(i); }'
check 3 loop 'for (uint i = 0u; i < lane; ++i) sum += word(i);'
check 3 left_loop 'for (uint i = 0u; i < 9u; ++i) { if (kept == i) break; sum += word(i); }'
check 3 left_inner 'for (uint i = 0u; i < 9u; ++i) for (uint k = 0u; k < 9u; ++k) { if (kept == k) break; sum += word(i); }'
check 3 went_on 'for (uint i = 0u; i < 9u; ++i) { if (kept == i) continue; sum += word(i); }'
check 3 left_main 'if (lane > 3u) return; sum = word(1u);'
check 3 left_function 'sum = early(lane);' 'uint early(uint i) { if (i > 3u) return 0u; return word(1u); }'
check 3 left_within 'sum = within(lane);' 'uint within(uint i) { for (uint k = 0u; k < 4u; ++k) { if (i == k) return k; } return word(1u); }'
check 3 by_variable 'uint mine = 0u; if (lane > 3u) mine = 1u; if (mine > 0u) sum = word(1u);'
check 3 by_result 'if (mine(2u)) sum = word(1u);' 'bool mine(uint i) { return kept > i; }'
check 3 by_argument 'sum = asked(lane);' 'uint asked(uint i) { return i > 3u ? word(1u) : 0u; }'
check 3 by_out 'uint a; get(a); if (a > 3u) sum = word(1u);' 'void get(out uint x) { x = gl_LocalInvocationID.x; }'
check 3 by_global 'if (lane > 3u) set(); if (state > 0u) sum = word(1u);' 'uint state = 0u; void set() { state = 1u; }'
check 3 by_cluster 'if (subgroupClusteredAdd(group + lane, 4u) > 3u) sum = word(1u);'
check 3 elected 'if (subgroupElect()) sum = word(1u);'
check 3 barrier 'if (lane > 3u) barrier();'
check 3 barrier_of_some 'if (gl_SubgroupID == 0u) barrier();'
check 0 by_subgroup 'if (gl_SubgroupID == 0u) sum = word(1u);'
check 0 by_group 'if (group > 3u) sum = word(1u);'
check 0 by_buffer 'if (words[group] > 3u && words[7] < 2u) sum = word(1u);'
check 0 by_shuffle 'for (uint i = 0u; i < word(3u); ++i) sum += word(i);'
check 0 by_sum 'if (subgroupAdd(kept) > 9u) sum = word(1u);'
check 0 afterwards 'if (lane > 3u) sum = 1u; sum += word(1u); for (uint i = 0u; i < lane; ++i) sum += i; sum += word(2u);'
check 0 after_a_way_out 'for (uint i = 0u; i < 9u; ++i) { if (kept == i) break; sum += i; } sum += word(2u);'
check 0 read_before 'uint first = word(1u); bool both = lane < 3u && first > 2u; if (both) sum = 1u;'

node "$here/divergence.mjs" "$dis" "$shaders"/*.spv
