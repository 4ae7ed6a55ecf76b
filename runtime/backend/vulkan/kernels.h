#pragma once
// The pipelines of the shaders in shaders/mesher/, created synchronously or in the background.

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

inline constexpr uint32_t kKernelBuffers = 6;  ///< number of storage buffers that each kernel binds

using Pipelines = std::array<std::shared_ptr<const Pipeline>, kernels>;

/// Receives messages about the creation of pipelines. Each function may be null, and is called on any thread.
struct KernelNews {
  /// called after pipelines were created in the background; the message says how long it took
  std::function<void(const std::string&)> inform;
  std::function<void(const std::string&)> warn;  ///< called if pipelines cannot be created, or cannot be cached
};

/// The pipelines of all kernels on one device. A software device executes every branch of an interpreter. So there,
/// interpreting pipelines are specialised to the kinds of instructions that were requested so far, and created again
/// when more kinds are requested. Thread-safe.
class Kernels {
 public:
  /// device and cache must outlive it; cache may be null.
  Kernels(Device& device, PipelineCache* cache, const Profiler& profiler, KernelNews news);
  /// Waits for a pipeline that is being created in the background.
  ~Kernels();
  Kernels(const Kernels&) = delete;
  Kernels& operator=(const Kernels&) = delete;

  /// Returns pipelines that support these kinds of instructions (Tape::kinds). Creates missing pipelines, which may
  /// take seconds. Errors: same as Pipeline::create. Throws std::bad_alloc.
  Result<Pipelines> get(uint64_t kinds);
  /// Returns true if get() would return at once. If not, starts a background thread that creates the pipelines; if no
  /// thread can be started, returns true, so that the caller waits in get(). Never waits itself.
  bool ready(uint64_t kinds) noexcept;
  /// True while the background thread creates pipelines.
  bool making() const { return making_.load(); }

  uint32_t width() const;  ///< number of invocations in a workgroup, for kernels without a fixed number

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

  std::mutex making_mutex_;  ///< held while pipelines are created; locked before mutex_
  /// One pipeline per kernel. While the pipelines are being replaced, some may support more kinds of instructions than
  /// others.
  std::array<Made, kernels> made_;
  bool warned_ = false;  ///< true if a warning was sent (see KernelNews::warn); only one is sent

  std::mutex mutex_;
  uint64_t kinds_ = 0;   ///< kinds of instructions that the pipelines support
  uint64_t wanted_ = 0;  ///< kinds that pipelines must support when they are created next
  Pipelines pipelines_;  ///< null until all pipelines have been created
  std::thread maker_;
  std::atomic<bool> making_{false}, stop_{false};
};

}  // namespace sgm::vulkan
