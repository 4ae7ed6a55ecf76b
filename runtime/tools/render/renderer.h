#pragma once
// Pictures of meshes, drawn off-screen.

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

/// Draws scenes on one Vulkan device, software ones included. One thread at a time may use it.
///
/// Processors trace the light that reaches what each pixel sees. The device draws the mesh into position, normal and
/// material planes, supersampled; then a compute shader lights each sample once, however much of the mesh lay behind
/// it, and averages them into pixels. The same scene gives the same bytes on the same device and driver.
class Renderer {
 public:
  /// Errors: unsupported, with what to install.
  static Result<Renderer> create(const GpuOptions& options = {});

  ~Renderer();
  Renderer(Renderer&&) noexcept;
  Renderer& operator=(Renderer&&) noexcept;

  /// Errors: invalid_argument (a size, an index or a vertex out of range, no material), out_of_memory, unsupported;
  /// cancelled, where scene.go_on says so.
  Result<Image> render(const RenderScene& scene) const;

  /// Errors: invalid_argument (a camera, a size or a number out of range), limit, out_of_memory, unsupported.
  Result<VolumePicture> render(const VolumeScene& scene) const;

  const vulkan::DeviceInfo& info() const { return device_->info(); }
  /// What the validation layer had to say; see GpuOptions::validation.
  std::vector<std::string> messages() const { return device_->messages(); }

 private:
  struct Kept;

  /// May throw std::bad_alloc.
  Result<Image> draw(const RenderScene& scene) const;

  Renderer(std::unique_ptr<VulkanDevice> device, std::unique_ptr<JobSystem> jobs);

  std::unique_ptr<VulkanDevice> device_;
  std::unique_ptr<JobSystem> jobs_;
  std::unique_ptr<Kept> kept_;  ///< from picture to picture
};

}  // namespace sgm
