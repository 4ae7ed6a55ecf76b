#include "api/region_sharp.h"

#include <algorithm>
#include <map>
#include <optional>
#include <tuple>

#include "backend/cpu/instruction_sets.h"
#include "mesh/chunk.h"

namespace sgm::api {
namespace {

/// Samples a world's field chunk by chunk, and keeps the chunks' programs for the next call.
class ChunkwiseSampler {
 public:
  ChunkwiseSampler(const WorldField& world, JobSystem& jobs, int level) : world_(world), jobs_(jobs), level_(level) {}

  Result<void> operator()(std::span<const Int3> points, std::span<FieldSample> samples) {
    std::pmr::vector<std::pair<Int3, uint32_t>> placed(world_.memory());
    placed.reserve(points.size());
    const int64_t edge = int64_t{kChunkCells} * world_.cellAt(level_);
    for (size_t i = 0; i < points.size(); ++i) {
      Int3 block;
      for (int axis = 0; axis < 3; ++axis) block[axis] = static_cast<int32_t>(floorDiv(points[i][axis], edge));
      placed.emplace_back(block, static_cast<uint32_t>(i));
    }
    std::sort(placed.begin(), placed.end());
    std::pmr::vector<size_t> borders(world_.memory());
    for (size_t i = 0; i < placed.size(); ++i) {
      if (i == 0 || placed[i].first != placed[i - 1].first) borders.push_back(i);
    }
    const size_t blocks = borders.size();
    borders.push_back(placed.size());

    // The programs' places first: the map must not change while threads fill it.
    std::pmr::vector<std::shared_ptr<const FieldProgram>*> programs(world_.memory());
    for (size_t b = 0; b < blocks; ++b) programs.push_back(&programs_[placed[borders[b]].first]);
    std::pmr::vector<std::optional<Error>> errors(blocks, world_.memory());
    parallelFor(jobs_, blocks, [&](size_t b) {
      const auto own = std::span(placed).subspan(borders[b], borders[b + 1] - borders[b]);
      if (*programs[b] == nullptr) {
        Result<std::shared_ptr<const FieldProgram>> compiled = world_.compile(boxOf(own.front().first, edge), level_);
        if (!compiled) {
          errors[b] = compiled.error();
          return;
        }
        *programs[b] = std::move(*compiled);
      }
      sample(**programs[b], own, points, samples);
    });
    for (const std::optional<Error>& error : errors) {
      if (error) return *error;
    }
    return {};
  }

 private:
  static IntBox boxOf(const Int3& block, int64_t edge) {
    IntBox box;
    for (int axis = 0; axis < 3; ++axis) {
      box.lo[axis] = saturate(block[axis] * edge);
      box.hi[axis] = saturate((block[axis] + 1) * edge);
    }
    return box;
  }

  void sample(const FieldProgram& program, std::span<const std::pair<Int3, uint32_t>> own, std::span<const Int3> points,
              std::span<FieldSample> samples) const {
    const size_t count = own.size();
    std::pmr::memory_resource* memory = world_.memory();
    std::pmr::vector<int32_t> x(count, memory), y(count, memory), z(count, memory);
    std::pmr::vector<float> value(count, memory), gx(count, memory), gy(count, memory), gz(count, memory);
    std::pmr::vector<int16_t> normal_x(count, memory), normal_y(count, memory);
    std::pmr::vector<uint32_t> label(count, memory);
    for (size_t i = 0; i < count; ++i) {
      const Int3& p = points[own[i].second];
      x[i] = p.x, y[i] = p.y, z[i] = p.z;
    }
    EvalScratch scratch(memory);
    bestKernels().attributes(
        program.view(), {x.data(), y.data(), z.data(), count}, scratch,
        {value.data(), gx.data(), gy.data(), gz.data(), normal_x.data(), normal_y.data(), label.data()});
    for (size_t i = 0; i < count; ++i) {
      samples[own[i].second] = {value[i], {gx[i], gy[i], gz[i]}, normal_x[i], normal_y[i]};
    }
  }

  const WorldField& world_;
  JobSystem& jobs_;
  const int level_;
  std::map<Int3, std::shared_ptr<const FieldProgram>> programs_;
};

}  // namespace

Result<WorldMesh> sharpenRegion(const WorldField& world, JobSystem& jobs, const WorldMesh& mesh, int level) {
  ChunkwiseSampler sampler(world, jobs, level);
  return sharpen(mesh, world.cellAt(level), std::ref(sampler), world.memory());
}

}  // namespace sgm::api
