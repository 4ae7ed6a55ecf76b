// Defines kLanes, and the loads and stores that evaluate_kernel.inl and evaluate_blocks.inl require, for a single lane:
// samples are evaluated one by one.

inline constexpr size_t kLanes = 1;
FN Real loadReal(const uint32_t* p) { return uniformFloat(*p); }
FN Int loadInt(const uint32_t* p) { return static_cast<Int>(*p); }
FN void storeReal(Real r, uint32_t* p) { *p = realToBits(r); }
FN void storeInt(Int i, uint32_t* p) { *p = static_cast<uint32_t>(i); }
FN uint64_t signMask(const uint32_t* p, size_t count) {
  uint64_t mask = 0;
  for (size_t i = 0; i < count; ++i) mask |= uint64_t{p[i] >> 31} << i;
  return mask;
}
