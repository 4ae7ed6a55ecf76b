#pragma once
// Draws pictures of meshes off-screen.

#include <memory>
#include <string>
#include <vector>

#include "base/jobs.h"
#include "base/result.h"
#include "tools/render/image.h"
#include "tools/render/scene.h"
#include "tools/render/volume.h"
#include "tools/render/vulkan_device.h"

namespace sgm {

/// Draws scenes on one Vulkan device, which may be a software device. Not thread-safe.
///
/// The CPU traces the light that reaches each pixel's surface. The device draws the mesh into position, normal and
/// material planes, supersampled; then a compute shader lights each visible sample once, and averages them into pixels.
/// The same scene gives the same bytes on the same device and driver.
class Renderer {
 public:
  /// Error: unsupported if there is no usable device; the message names the package to install.
  static Result<Renderer> create(const GpuOptions& options = {});

  ~Renderer();
  Renderer(Renderer&&) noexcept;
  Renderer& operator=(Renderer&&) noexcept;

  /// Draws a mesh. Errors: invalid_argument (a size, an index or a vertex is out of range, or there is no material),
  /// out_of_memory, unsupported; cancelled if scene.go_on returns false.
  Result<Image> render(const RenderScene& scene) const;

  /// Draws fog. Errors: invalid_argument (a camera, a size or a number is out of range), limit, out_of_memory,
  /// unsupported.
  Result<VolumePicture> render(const VolumeScene& scene) const;

  const vulkan::DeviceInfo& info() const { return device_->info(); }
  /// Messages of Vulkan's validation layer; see GpuOptions::validation.
  std::vector<std::string> messages() const { return device_->messages(); }

 private:
  struct Kept;

  /// Implements render(), but may throw std::bad_alloc.
  Result<Image> draw(const RenderScene& scene) const;

  Renderer(std::unique_ptr<VulkanDevice> device, std::unique_ptr<JobSystem> jobs);

  std::unique_ptr<VulkanDevice> device_;
  std::unique_ptr<JobSystem> jobs_;
  std::unique_ptr<Kept> kept_;  ///< pipelines and buffers that are reused for the next picture
};

}  // namespace sgm
