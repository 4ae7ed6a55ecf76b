#include "backend/vulkan/kernels.h"

#include <chrono>
#include <new>
#include <span>
#include <system_error>
#include <utility>

#include "backend/vulkan/batch_layout.h"
#include "spirv/allocate_comp.h"
#include "spirv/attributes_comp.h"
#include "spirv/attributes_rte_comp.h"
#include "spirv/body_vertices_comp.h"
#include "spirv/census_body_comp.h"
#include "spirv/census_seam_comp.h"
#include "spirv/fill_signs_comp.h"
#include "spirv/list_cells_comp.h"
#include "spirv/plane_units_comp.h"
#include "spirv/prune_comp.h"
#include "spirv/refine_comp.h"
#include "spirv/sample_comp.h"
#include "spirv/sample_rte_comp.h"
#include "spirv/seam_triangles_comp.h"
#include "spirv/seam_vertices_comp.h"
#include "spirv/sums_comp.h"
#include "spirv/triangles_comp.h"

namespace sgm::vulkan {

namespace {

// On a software device, a workgroup is a single subgroup. With several subgroups, data shared by a workgroup would be
// loaded once for each subgroup.
constexpr uint32_t kSoftwareWidth = 8, kHardwareWidth = 64;
constexpr uint64_t kAllKinds = ~uint64_t{0};
// The creation of pipelines is reported only if it takes longer than this, in seconds.
constexpr double kNoticedSeconds = 1;

bool interprets(Kernel kernel) {
  return kernel == prune || kernel == refine || kernel == sample || kernel == attributes;
}

}  // namespace

Kernels::Kernels(Device& device, PipelineCache* cache, const Profiler& profiler, KernelNews news)
    : device_(device), cache_(cache), profiler_(profiler), news_(std::move(news)) {}

Kernels::~Kernels() {
  stop_.store(true);
  if (maker_.joinable()) maker_.join();
}

uint32_t Kernels::width() const { return software() ? kSoftwareWidth : kHardwareWidth; }

uint64_t Kernels::kindsFor(uint64_t kinds) const { return software() ? kinds : kAllKinds; }

Result<Pipelines> Kernels::get(uint64_t kinds) {
  kinds = kindsFor(kinds);
  {
    const std::scoped_lock lock(mutex_);
    if (know(kinds)) return pipelines_;
    wanted_ |= kinds;
  }
  const std::scoped_lock making(making_mutex_);
  {
    const std::scoped_lock lock(mutex_);
    if (know(kinds)) return pipelines_;
  }
  if (Result<void> made = make(false); !made) return made.error();
  keep();
  const std::scoped_lock lock(mutex_);
  return pipelines_;
}

bool Kernels::ready(uint64_t kinds) noexcept {
  kinds = kindsFor(kinds);
  const std::scoped_lock lock(mutex_);
  if (know(kinds)) return true;
  wanted_ |= kinds;
  if (making_.load()) return false;
  if (maker_.joinable()) maker_.join();
  making_.store(true);
  try {
    maker_ = std::thread([this] { makeAside(); });
    return false;
  } catch (const std::system_error&) {
  } catch (const std::bad_alloc&) {
  }
  making_.store(false);
  return true;
}

Result<std::shared_ptr<const Pipeline>> Kernels::makePipeline(Kernel kernel, uint64_t kinds) const {
  const bool rte = device_.info().exact;
  struct Source {
    const char* name;
    std::span<const uint32_t> spirv;
  };
  const std::array<Source, kernels> sources{{
      {"prune", spirv::kPruneComp},
      {"refine", spirv::kRefineComp},
      {"fill_signs", spirv::kFillSignsComp},
      {"sample",
       rte ? std::span<const uint32_t>(spirv::kSampleRteComp) : std::span<const uint32_t>(spirv::kSampleComp)},
      {"census_body", spirv::kCensusBodyComp},
      {"census_seam", spirv::kCensusSeamComp},
      {"allocate", spirv::kAllocateComp},
      {"body_vertices", spirv::kBodyVerticesComp},
      {"seam_vertices", spirv::kSeamVerticesComp},
      {"plane_units", spirv::kPlaneUnitsComp},
      {"attributes",
       rte ? std::span<const uint32_t>(spirv::kAttributesRteComp) : std::span<const uint32_t>(spirv::kAttributesComp)},
      {"list_cells", spirv::kListCellsComp},
      {"triangles", spirv::kTrianglesComp},
      {"seam_triangles", spirv::kSeamTrianglesComp},
      {"sums", spirv::kSumsComp},
  }};
  const bool wide = interprets(kernel) || kernel == fill_signs || kernel == body_vertices || kernel == plane_units;
  const std::array<uint32_t, 3> constants{width(), static_cast<uint32_t>(kinds), static_cast<uint32_t>(kinds >> 32)};
  PipelineDesc desc;
  desc.name = sources[kernel].name;
  desc.spirv = sources[kernel].spirv;
  desc.buffers = kKernelBuffers;
  desc.push_bytes = sizeof(batch::Sizes);
  desc.constants = std::span(constants).first(interprets(kernel) ? 3 : wide ? 1 : 0);
  Result<Pipeline> made = Pipeline::create(device_, desc, cache_);
  if (!made) return made.error();
  return std::make_shared<const Pipeline>(std::move(*made));
}

/// Creates the missing pipelines. If more kinds of instructions are requested meanwhile, starts again with these kinds.
/// aside: true if the background thread calls this.
Result<void> Kernels::make(bool aside) {
  const ProfileScope scope(profiler_, zone::kShaders);
  for (;;) {
    uint64_t kinds = 0;
    const auto grown = [&] {
      const std::scoped_lock lock(mutex_);
      return std::exchange(kinds, wanted_) != wanted_;
    };
    static_cast<void>(grown());
    size_t k = 0;
    for (; k < kernels; ++k) {
      if (aside && stop_.load()) return Error{Code::cancelled, "the creation of pipelines was cancelled"};
      const auto kernel = static_cast<Kernel>(k);
      if (made_[k].pipeline && (made_[k].kinds == kinds || !interprets(kernel))) continue;
      Result<std::shared_ptr<const Pipeline>> pipeline = makePipeline(kernel, kinds);
      if (!pipeline) return pipeline.error();
      made_[k] = {std::move(*pipeline), kinds};
      if (grown()) break;
    }
    if (k < kernels) continue;
    const std::scoped_lock lock(mutex_);
    for (k = 0; k < kernels; ++k) pipelines_[k] = made_[k].pipeline;
    kinds_ = kinds;
    if (kinds_ == wanted_) return {};
  }
}

void Kernels::makeAside() noexcept {
  profiler_.nameThread("sgm kernels");
  try {
    const auto begun = std::chrono::steady_clock::now();
    const std::scoped_lock making(making_mutex_);
    const Result<void> made = make(true);
    if (made) {
      const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begun;
      if (news_.inform && took.count() > kNoticedSeconds) {
        news_.inform("the shaders for " + device_.info().name + " were compiled in " +
                     std::to_string(static_cast<int>(took.count() + 0.5)) + " s; until then the CPU meshed the chunks");
      }
      keep();
    } else if (made.error().code != Code::cancelled && news_.warn && !std::exchange(warned_, true)) {
      news_.warn("the CPU continues to mesh in place of " + device_.info().name + ": " + made.error().message);
    }
  } catch (const std::bad_alloc&) {
    // The failure is handled like all others: the CPU continues, and the next request tries again.
  }
  making_.store(false);
}

/// Saves the cache at once, so that it is not lost if the process is killed.
void Kernels::keep() {
  if (cache_ == nullptr) return;
  const Result<void> saved = cache_->save();
  if (saved || !news_.warn || std::exchange(warned_, true)) return;
  news_.warn("compiled pipelines are not cached: " + saved.error().message);
}

}  // namespace sgm::vulkan
