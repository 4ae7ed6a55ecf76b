// Sums over a workgroup of 64, by invocation. Subgroups are full and the workgroup has one dimension.

shared uvec4 scan_sums[64];

// Which of the 64 an invocation is: the order in which scanWorkgroup adds.
uint placeInWorkgroup() { return gl_SubgroupID * gl_SubgroupSize + gl_SubgroupInvocationID; }

// What the invocations before have, and what all have. Called once, in uniform control flow.
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
