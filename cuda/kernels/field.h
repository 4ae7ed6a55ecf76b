#pragma once
// Evaluates values and attributes of field programs at points, in one GPU thread, with the same interpreter as on the
// CPU.

#include <cstdint>
#include <cstring>

#include "base/kernel.h"
#include "field/program.h"
#include "mesh/vertex.h"

namespace sgm::cuda {

namespace at_point {

#include "common/common.h"

inline constexpr size_t kLanes = 1;
FN Real loadReal(const uint32_t* p) { return uniformFloat(*p); }
FN Int loadInt(const uint32_t* p) { return static_cast<Int>(*p); }
FN void storeReal(Real r, uint32_t* p) { *p = realToBits(r); }
FN void storeInt(Int i, uint32_t* p) { *p = static_cast<uint32_t>(i); }

namespace together {

/// Number of samples that a thread evaluates together, so that it reads each instruction once for all of them.
inline constexpr size_t kEvalBlock = 4;
#include "field/evaluate_kernel.inl"

}  // namespace together

namespace alone {

inline constexpr size_t kEvalBlock = 1;
#include "field/evaluate_kernel.inl"

}  // namespace alone

}  // namespace at_point

inline constexpr uint32_t kSamplesTogether = at_point::together::kEvalBlock;

/// Computes the quantised field values at several points. points: the x coordinates of all points, then the y, then the
/// z coordinates.
SGM_KERNEL void sampleField(const ProgramView& program, const int32_t (&points)[3][kSamplesTogether],
                            int32_t (&q)[kSamplesTogether]) {
  using namespace at_point::together;
  uint32_t registers[(kMaxRegisters + 2) * kRegisterWords<false>];
  uint32_t places[kMaxPlaces * 3 * kEvalBlock];
  const BlockFrame frame{registers, places, nullptr};
  for (uint32_t axis = 0; axis < 3; ++axis) {
    for (uint32_t i = 0; i < kEvalBlock; ++i) at_point::storeInt(points[axis][i], places + axis * kEvalBlock + i);
  }
  runBlock<false>(program, frame, kEvalBlock);
  for (uint32_t i = 0; i < kEvalBlock; ++i) {
    q[i] = at_point::quantise(loadDual<false>(frame, kFoldRegister, i).v, program.q_scale);
  }
}

/// Sets the normal and the label of a vertex from the field at position `at`.
SGM_KERNEL void giveAttributes(const ProgramView& program, Int3 at, Vertex& vertex) {
  using namespace at_point::alone;
  uint32_t registers[(kMaxRegisters + 2) * kRegisterWords<true>];
  uint32_t places[kMaxPlaces * 3], jacobians[kMaxPlaces * 9];
  const BlockFrame frame{registers, places, jacobians};
  at_point::storeInt(at.x, places);
  at_point::storeInt(at.y, places + 1);
  at_point::storeInt(at.z, places + 2);
  runBlock<true>(program, frame, 1);
  const at_point::Dual d = loadDual<true>(frame, kFoldRegister, 0);
  const at_point::PackedNormal normal =
      at_point::packNormal(at_point::unsignedZero(d.x), at_point::unsignedZero(d.y), at_point::unsignedZero(d.z));
  vertex.normal_x = static_cast<int16_t>(normal.x);
  vertex.normal_y = static_cast<int16_t>(normal.y);
  vertex.material = static_cast<uint16_t>(d.label);
  vertex.tag = static_cast<uint16_t>(static_cast<uint32_t>(d.label) >> 16);
}

}  // namespace sgm::cuda
