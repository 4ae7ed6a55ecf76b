#include "stream/sharpen_chunk.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "backend/cpu/instruction_sets.h"
#include "field/prune.h"
#include "mesh/sharpen.h"
#include "mesh/split_creases.h"

namespace sgm {
namespace {

constexpr int kBrickCells = 8;

/// Samples a program around a chunk, brick by brick, each by what of the program matters there.
class BrickSampler {
 public:
  BrickSampler(const FieldProgram& program, const Int3& origin, int32_t cell, std::pmr::memory_resource* memory)
      : program_(program),
        origin_(origin),
        edge_(int64_t{kBrickCells} * cell),
        memory_(memory),
        pruning_(memory),
        scratch_(memory),
        bricks_(memory) {}

  void operator()(std::span<const Int3> points, std::span<FieldSample> samples, Sampled what) {
    std::pmr::vector<std::pair<Int3, uint32_t>> placed(memory_);
    placed.reserve(points.size());
    for (uint32_t i = 0; i < points.size(); ++i) {
      Int3 brick;
      for (int k = 0; k < 3; ++k) {
        brick[k] = static_cast<int32_t>(floorDiv(int64_t{points[i][k]} - origin_[k], edge_));
      }
      placed.emplace_back(brick, i);
    }
    std::sort(placed.begin(), placed.end());
    for (size_t first = 0, end = 0; first < placed.size(); first = end) {
      while (end < placed.size() && placed[end].first == placed[first].first) ++end;
      sample(programOf(placed[first].first), std::span(placed).subspan(first, end - first), points, samples, what);
    }
  }

 private:
  ProgramView programOf(const Int3& brick) {
    const auto [known, is_new] = bricks_.try_emplace(brick, memory_);
    if (is_new) {
      IntBox box;
      for (int k = 0; k < 3; ++k) {
        box.lo[k] = saturate(origin_[k] + brick[k] * edge_);
        box.hi[k] = saturate(origin_[k] + (brick[k] + int64_t{1}) * edge_);
      }
      prune(program_.view(), box, pruning_, known->second, Uniform::keep);
    }
    return known->second.view();
  }

  void sample(const ProgramView& program, std::span<const std::pair<Int3, uint32_t>> own, std::span<const Int3> points,
              std::span<FieldSample> samples, Sampled what) {
    const size_t count = own.size();
    std::pmr::vector<int32_t> x(count, memory_), y(count, memory_), z(count, memory_);
    std::pmr::vector<float> value(count, memory_), gx(count, memory_), gy(count, memory_), gz(count, memory_);
    std::pmr::vector<int16_t> normal_x(count, memory_), normal_y(count, memory_);
    for (size_t i = 0; i < count; ++i) {
      const Int3& p = points[own[i].second];
      x[i] = p.x, y[i] = p.y, z[i] = p.z;
    }
    Attributes attributes;
    attributes.value = value.data();
    if (what == Sampled::all) {
      attributes.gradient_x = gx.data();
      attributes.gradient_y = gy.data();
      attributes.gradient_z = gz.data();
      attributes.normal_x = normal_x.data();
      attributes.normal_y = normal_y.data();
    }
    bestKernels().attributes(program, {x.data(), y.data(), z.data(), count}, scratch_, attributes);
    for (size_t i = 0; i < count; ++i) {
      samples[own[i].second] = {value[i], quantised(value[i]), {gx[i], gy[i], gz[i]}, normal_x[i], normal_y[i]};
    }
  }

  /// As the kernels quantise a sample (quantise() of shaders/common/real.h).
  int32_t quantised(float value) const {
    const float q = value * program_.q_scale;
    return static_cast<int32_t>(std::floor(std::clamp(q + 0.5f, -float{kMaxQ}, float{kMaxQ})));
  }

  const FieldProgram& program_;
  const Int3 origin_;
  const int64_t edge_;  ///< of a brick, units
  std::pmr::memory_resource* memory_;
  PruneScratch pruning_;
  EvalScratch scratch_;
  std::pmr::map<Int3, PrunedProgram> bricks_;
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
