#pragma once
// Kernel that computes the sums over the triangles of parts, for chunks that do not request meshes.

#include "cuda/kernels/batch.h"
#include "cuda/kernels/block.h"
#include "mesh/triangle_terms.h"

namespace sgm::cuda {

/// Kernel: adds up the sums of each part. kSlices blocks share the triangles of a part.
struct SumTriangles {
  static constexpr uint32_t kThreads = 128;
  static constexpr uint32_t kSlices = 4;
  struct Shared {
    Sums sums;
  };

  template <class Block>
  SGM_KERNEL static void run(Block& block, const Batch& b, Shared& shared) {
    const uint32_t number = block.number() / kSlices, slice = block.number() % kSlices;
    const Part& part = b.parts[number];
    if (part.indices == 0 || part.first_index == kNone) return;
    block.each([&](uint32_t thread) {
      if (thread == 0) shared.sums = {};
    });
    block.each([&](uint32_t thread) {
      TermSums own;
      for (uint32_t i = kThreads * slice + thread; i < part.indices / 3; i += kThreads * kSlices) {
        const Vertex* const vertices = b.vertices + part.first_vertex;
        const uint32_t* const corners = b.indices + part.first_index + 3 * i;
        addTerms(termsOf(vertices[corners[0]], vertices[corners[1]], vertices[corners[2]]), own);
      }
      give({wordOf(own.area), {wordOf(own.x), wordOf(own.y), wordOf(own.z)}, wordOf(own.six_volumes)}, shared.sums);
    });
    block.each([&](uint32_t thread) {
      if (thread == 0) give(shared.sums, b.sums[number]);
    });
  }

  SGM_KERNEL static uint64_t wordOf(int64_t value) { return static_cast<uint64_t>(value); }

  SGM_KERNEL static void give(const Sums& from, Sums& to) {
    addTo(to.area, from.area);
    for (int axis = 0; axis < 3; ++axis) addTo(to.cross[axis], from.cross[axis]);
    addTo(to.six_volumes, from.six_volumes);
  }
};

}  // namespace sgm::cuda
