#pragma once
// The shaders of shaders/mesher/, made ready to run: at once for who waits, aside for who rather goes on without.

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "backend/vulkan/pipeline_cache.h"
#include "backend/vulkan/pipelines.h"
#include "base/profile.h"

namespace sgm::vulkan {

enum Kernel : uint8_t {
  prune,
  refine,
  fill_signs,
  sample,
  census_body,
  census_seam,
  allocate,
  body_vertices,
  seam_vertices,
  plane_units,
  attributes,
  list_cells,
  triangles,
  seam_triangles,
  sums,
  kernels
};

inline constexpr uint32_t kKernelBuffers = 6;  ///< that each of them binds

using Pipelines = std::array<std::shared_ptr<const Pipeline>, kernels>;

/// Who hears of the making; each may be null, and is called on any thread.
struct KernelNews {
  std::function<void(const std::string&)> inform;  ///< that pipelines were made aside, and how long it took
  std::function<void(const std::string&)> warn;    ///< that they cannot be made, or not be kept
};

/// The pipelines of all kernels on one device. Software runs every branch of an interpreter; so there the interpreting
/// ones know the kinds of instruction that were asked for so far, and are made anew when there are more. Any thread may
/// use it.
class Kernels {
 public:
  /// device and cache must outlive it; cache: null for none.
  Kernels(Device& device, PipelineCache* cache, const Profiler& profiler, KernelNews news);
  /// Waits for the one pipeline that is being made aside, if any.
  ~Kernels();
  Kernels(const Kernels&) = delete;
  Kernels& operator=(const Kernels&) = delete;

  /// Those that know these kinds (Tape::kinds); makes what is missing, which may take seconds. Errors: as
  /// Pipeline::create. Throws std::bad_alloc.
  Result<Pipelines> get(uint64_t kinds);
  /// Whether get() would give them at once. Where not, a thread of its own makes them. Where there is no thread to be
  /// had it is true too: somebody has to wait then. Does not wait itself.
  bool ready(uint64_t kinds) noexcept;
  /// Whether that thread is at work.
  bool making() const { return making_.load(); }

  uint32_t width() const;  ///< invocations of a workgroup, of the kernels that leave it open

 private:
  struct Made {
    std::shared_ptr<const Pipeline> pipeline;
    uint64_t kinds = 0;
  };

  bool software() const { return device_.info().software(); }
  uint64_t kindsFor(uint64_t kinds) const;
  bool know(uint64_t kinds) const { return pipelines_[prune] && (kinds_ & kinds) == kinds; }
  Result<std::shared_ptr<const Pipeline>> makePipeline(Kernel kernel, uint64_t kinds) const;
  Result<void> make(bool aside);
  void makeAside() noexcept;
  void keep();

  Device& device_;
  PipelineCache* const cache_;
  const Profiler profiler_;
  const KernelNews news_;

  std::mutex making_mutex_;         ///< held while pipelines are made; taken before mutex_
  std::array<Made, kernels> made_;  ///< maybe not all of the same kinds yet
  bool warned_ = false;             ///< once is enough

  std::mutex mutex_;
  uint64_t kinds_ = 0;   ///< what the pipelines know
  uint64_t wanted_ = 0;  ///< what they are to know
  Pipelines pipelines_;  ///< all or none
  std::thread maker_;
  std::atomic<bool> making_{false}, stop_{false};
};

}  // namespace sgm::vulkan
