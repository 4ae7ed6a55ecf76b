#pragma once
// Kernel that samples the field: it computes the values and their signs in every item of the list that the pruning
// kernel has made (Batch::sampled). One block per item.

#include "cuda/kernels/field.h"
#include "cuda/kernels/grid.h"

namespace sgm::cuda {

struct Sample {
  static constexpr uint32_t kThreads = 128;
  struct Shared {
    uint32_t unused;
  };

  template <class Block>
  SGM_KERNEL static void run(Block& block, const Batch& b, Shared&) {
    for (uint32_t entry = block.number(); entry < b.head->sampled; entry += block.count()) {
      const uint32_t number = b.sampled[entry];
      const Item& item = b.items[number];
      const Lattice lattice(b, number);
      block.each([&](uint32_t thread) {
        const ProgramView view = viewOf(b, item);
        for (uint32_t i = kSamplesTogether * thread; i < lattice.count(); i += kSamplesTogether * kThreads) {
          take(view, lattice, i);
        }
      });
      block.each([&](uint32_t thread) {
        for (uint32_t row = thread; row < lattice.size[1] * lattice.size[2]; row += kThreads) lattice.sign(row);
      });
    }
  }

  /// The samples of an item: their world positions, and the addresses for their values Q and signs.
  struct Lattice {
    Int3 origin, step_x, step_y, step_z;  ///< in units
    uint32_t size[3];
    int32_t* samples;
    uint32_t stride_y, stride_z;  ///< distances between rows and between layers in `samples`, in elements; neighbours
                                  ///< along x are adjacent
    uint64_t* signs;              ///< for a brick: address of the sign word of its first row; otherwise null
    uint32_t* coarse_signs;       ///< for a coarse face plane: address of the sign word of its first row; otherwise
                                  ///< null
    uint32_t shift;               ///< bit number, within a sign word, of the first sample of a row

    SGM_KERNEL Lattice(const Batch& b, uint32_t item)
        : step_x{}, step_y{}, step_z{}, signs(nullptr), coarse_signs(nullptr) {
      const bool plane = item >= kBricks * b.chunk_count;
      const uint32_t seam_number = (item - kBricks * b.chunk_count) / 2;
      const uint32_t chunk_number = plane ? b.seams[seam_number].chunk : item / kBricks;
      const Chunk& chunk = b.chunks[chunk_number];
      origin = gridOf(chunk).origin;
      if (plane) {
        // The positions of the samples are the same as in coarseFacePoint (mesh/seam.h).
        const auto face = static_cast<Face>(b.seams[seam_number].face);
        const int axis = faceAxis(face);
        origin[axis] += faceIsHigh(face) ? kChunkCells * chunk.cell : 0;
        step_x[(axis + 1) % 3] = 2 * chunk.cell;
        step_y[(axis + 2) % 3] = 2 * chunk.cell;
        size[0] = size[1] = kCoarseSide;
        size[2] = 1;
        samples = b.coarse_samples + size_t{kCoarsePlane} * seam_number;
        stride_y = kCoarseSide;
        stride_z = 0;
        coarse_signs = b.coarse_signs + size_t{kCoarseSide} * seam_number;
        shift = 0;
        return;
      }
      const Brick brick(item % kBricks);
      for (int axis = 0; axis < 3; ++axis) {
        origin[axis] += brick.first(axis) * chunk.cell;
        size[axis] = static_cast<uint32_t>(brick.count(axis));
      }
      step_x.x = step_y.y = step_z.z = chunk.cell;
      const size_t first_row = rowOf(brick.first(1), brick.first(2));
      samples = b.samples + size_t{kSamples} * chunk_number + first_row * kSide + static_cast<size_t>(brick.first(0));
      stride_y = kSide;
      stride_z = kRows;
      signs = b.signs + size_t{kRows} * chunk_number + first_row;
      shift = static_cast<uint32_t>(brick.first(0));
    }

    SGM_KERNEL uint32_t count() const { return size[0] * size[1] * size[2]; }
    SGM_KERNEL void place(uint32_t i, uint32_t (&at)[3]) const {
      at[0] = i % size[0];
      at[1] = i / size[0] % size[1];
      at[2] = i / size[0] / size[1];
    }
    SGM_KERNEL int32_t& sample(const uint32_t (&at)[3]) const {
      return samples[at[0] + size_t{stride_y} * at[1] + size_t{stride_z} * at[2]];
    }
    SGM_KERNEL void sign(uint32_t row) const {
      uint32_t at[3] = {0, row % size[1], row / size[1]};
      uint64_t bits = 0;
      for (; at[0] < size[0]; ++at[0]) bits |= uint64_t{sample(at) < 0} << at[0];
      if (coarse_signs != nullptr) {
        coarse_signs[row] = static_cast<uint32_t>(bits);
      } else if (bits != 0) {
        setBits(signs[rowOf(static_cast<int>(at[1]), static_cast<int>(at[2]))], bits << shift);
      }
    }
  };

  /// Evaluates kSamplesTogether samples, the first of which has number i. If there are fewer left, the last sample is
  /// repeated, and the repetitions are discarded.
  SGM_KERNEL static void take(const ProgramView& view, const Lattice& lattice, uint32_t i) {
    uint32_t at[kSamplesTogether][3];
    int32_t points[3][kSamplesTogether], q[kSamplesTogether];
    for (uint32_t k = 0; k < kSamplesTogether; ++k) {
      lattice.place(i + k < lattice.count() ? i + k : lattice.count() - 1, at[k]);
      for (int axis = 0; axis < 3; ++axis) {
        points[axis][k] = lattice.origin[axis] + static_cast<int32_t>(at[k][0]) * lattice.step_x[axis] +
                          static_cast<int32_t>(at[k][1]) * lattice.step_y[axis] +
                          static_cast<int32_t>(at[k][2]) * lattice.step_z[axis];
      }
    }
    sampleField(view, points, q);
    for (uint32_t k = 0; k < kSamplesTogether; ++k) {
      if (i + k < lattice.count()) lattice.sample(at[k]) = q[k];
    }
  }
};

}  // namespace sgm::cuda
