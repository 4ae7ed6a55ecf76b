// Prefix sums over a workgroup of 64 invocations. Subgroups must be full, and the workgroup must be one-dimensional.

shared uvec4 scan_sums[64];

// Returns the index of the invocation, 0..63, in the order in which scanWorkgroup adds.
uint placeInWorkgroup() { return gl_SubgroupID * gl_SubgroupSize + gl_SubgroupInvocationID; }

// Returns the sum over the invocations before this one (`before`), and the sum over all (`all`). Must be called once,
// in uniform control flow.
void scanWorkgroup(uvec4 own, out uvec4 before, out uvec4 all) {
  before = subgroupExclusiveAdd(own);
  if (gl_SubgroupInvocationID == gl_SubgroupSize - 1u) scan_sums[gl_SubgroupID] = before + own;
  barrier();
  all = uvec4(0u);
  uint subgroup = 0u;
  do {
    if (subgroup == gl_SubgroupID) before += all;
    all += scan_sums[subgroup];
    ++subgroup;
  } while (subgroup < gl_NumSubgroups);
}
