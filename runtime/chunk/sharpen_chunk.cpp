#include "chunk/sharpen_chunk.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "backend/cpu/instruction_sets.h"
#include "field/prune.h"
#include "mesh/sharpen.h"
#include "mesh/split_creases.h"

namespace sgm {
namespace {

constexpr int kBrickCells = 8;

/// Samples a program around a chunk. Groups the points by bricks (small boxes), and prunes the program to each brick.
class BrickSampler {
 public:
  BrickSampler(const FieldProgram& program, const Int3& origin, int32_t cell, std::pmr::memory_resource* memory)
      : program_(program),
        origin_(origin),
        edge_(int64_t{kBrickCells} * cell),
        pruning_(memory),
        scratch_(memory),
        bricks_(memory),
        brick_of_(memory),
        order_(memory),
        x_(memory),
        y_(memory),
        z_(memory),
        value_(memory),
        gradient_(memory),
        normal_(memory) {}

  void operator()(std::span<const Int3> points, std::span<FieldSample> samples, Sampled what) {
    std::array<uint32_t, kElsewhere + 2> ends{};
    brick_of_.resize(points.size());
    order_.resize(points.size());
    for (size_t i = 0; i < points.size(); ++i) {
      brick_of_[i] = brickOf(points[i]);
      ++ends[brick_of_[i] + 1];
    }
    for (size_t brick = 1; brick < ends.size(); ++brick) ends[brick] += ends[brick - 1];
    for (uint32_t i = 0; i < points.size(); ++i) order_[ends[brick_of_[i]]++] = i;
    uint32_t begin = 0;
    for (uint32_t brick = 0; brick <= kElsewhere; ++brick) {
      const uint32_t end = ends[brick];
      if (end > begin) sample(programOf(brick), std::span(order_).subspan(begin, end - begin), points, samples, what);
      begin = end;
    }
  }

 private:
  /// Number of bricks along an axis: those of the chunk, and one more on each side.
  static constexpr int32_t kBricks = kChunkCells / kBrickCells + 2;
  static constexpr uint32_t kElsewhere = kBricks * kBricks * kBricks;

  uint32_t brickOf(const Int3& point) const {
    uint32_t brick = 0;
    for (int k = 2; k >= 0; --k) {
      const int64_t at = int64_t{point[k]} - origin_[k] + edge_;
      if (at < 0 || at >= kBricks * edge_) return kElsewhere;
      brick = brick * kBricks + static_cast<uint32_t>(static_cast<uint64_t>(at) / static_cast<uint64_t>(edge_));
    }
    return brick;
  }

  ProgramView programOf(uint32_t brick) {
    if (brick == kElsewhere) return program_.view();
    if (bricks_.empty()) bricks_.resize(kElsewhere);
    std::optional<PrunedProgram>& known = bricks_[brick];
    if (!known) {
      IntBox box;
      for (int k = 0; k < 3; ++k, brick /= kBricks) {
        const int64_t low = origin_[k] + (int64_t{brick % kBricks} - 1) * edge_;
        box.lo[k] = saturate(low);
        box.hi[k] = saturate(low + edge_);
      }
      prune(program_.view(), box, pruning_, known.emplace(bricks_.get_allocator().resource()), Uniform::keep);
    }
    return known->view();
  }

  void sample(const ProgramView& program, std::span<const uint32_t> own, std::span<const Int3> points,
              std::span<FieldSample> samples, Sampled what) {
    const size_t count = own.size();
    if (x_.size() < count) {
      for (auto* at : {&x_, &y_, &z_}) at->resize(count);
      value_.resize(count);
      gradient_.resize(3 * count);
      normal_.resize(2 * count);
    }
    for (size_t i = 0; i < count; ++i) {
      const Int3& p = points[own[i]];
      x_[i] = p.x, y_[i] = p.y, z_[i] = p.z;
    }
    float *const gx = gradient_.data(), *const gy = gx + count, *const gz = gy + count;
    int16_t *const nx = normal_.data(), *const ny = nx + count;
    Attributes attributes;
    attributes.value = value_.data();
    if (what == Sampled::all) {
      attributes.gradient_x = gx;
      attributes.gradient_y = gy;
      attributes.gradient_z = gz;
      attributes.normal_x = nx;
      attributes.normal_y = ny;
    }
    bestKernels().attributes(program, {x_.data(), y_.data(), z_.data(), count}, scratch_, attributes);
    for (size_t i = 0; i < count; ++i) {
      FieldSample& sample = samples[own[i]];
      sample = {value_[i], quantised(value_[i])};
      if (what == Sampled::all)
        sample.gradient = {gx[i], gy[i], gz[i]}, sample.normal_x = nx[i], sample.normal_y = ny[i];
    }
  }

  /// Quantises a field value in the same way as the kernels (quantise() of shaders/common/real.h).
  int32_t quantised(float value) const {
    const float q = value * program_.q_scale;
    return static_cast<int32_t>(std::floor(std::clamp(q + 0.5f, -float{kMaxQ}, float{kMaxQ})));
  }

  const FieldProgram& program_;
  const Int3 origin_;
  const int64_t edge_;  ///< edge of a brick, in units
  PruneScratch pruning_;
  EvalScratch scratch_;
  /// program of each brick; nullopt until a point in the brick is sampled
  std::pmr::vector<std::optional<PrunedProgram>> bricks_;
  std::pmr::vector<uint32_t> brick_of_;  ///< index of the brick of each point
  std::pmr::vector<uint32_t> order_;     ///< indices of the points, sorted by brick
  /// coordinates of the points of one brick, as the kernels read them
  std::pmr::vector<int32_t> x_, y_, z_;
  std::pmr::vector<float> value_, gradient_;
  std::pmr::vector<int16_t> normal_;
};

}  // namespace

void sharpenChunk(const ChunkGrid& grid, const FieldProgram& field, const FieldProgram* coarse, ChunkMesh& mesh,
                  std::pmr::memory_resource* memory) {
  BrickSampler own(field, grid.origin, grid.cell, memory);
  mesh.on_device = {};
  if (!mesh.body.indices.empty()) {
    mesh.rounded = sharpenBody(grid, std::ref(own), mesh.body, memory);
    splitCreases(mesh.body, memory);
  }
  if (coarse == nullptr) return;
  BrickSampler above(*coarse, grid.origin, 2 * grid.cell, memory);
  for (size_t f = 0; f < mesh.seams.size(); ++f) {
    sharpenSeam(grid, static_cast<Face>(f), std::ref(own), std::ref(above), mesh.seams[f], memory);
  }
}

}  // namespace sgm
