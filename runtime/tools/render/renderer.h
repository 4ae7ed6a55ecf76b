#pragma once
// Draws pictures of meshes and of fog off-screen.

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

/// Draws scenes on one Vulkan device, which may be a software device. Not thread-safe. The CPU traces rays for the
/// light at the surface of each pixel. The device rasterizes the mesh into images of positions and normals, with
/// several samples for each pixel. A compute shader then lights each visible sample once and averages the samples of
/// each pixel. The same scene gives the same bytes on the same device and driver.
class Renderer {
 public:
  /// Error: unsupported if there is no usable device; the message then names the package to install.
  static Result<Renderer> create(const GpuOptions& options = {});

  ~Renderer();
  Renderer(Renderer&&) noexcept;
  Renderer& operator=(Renderer&&) noexcept;

  /// Draws a mesh. Errors: invalid_argument if a size, an index or a vertex is out of range, or if there is no
  /// material; out_of_memory; unsupported; cancelled if scene.go_on returns false.
  Result<Image> render(const RenderScene& scene) const;

  /// Draws a volume of fog. Errors: invalid_argument if the camera, a size or a number is out of range; limit;
  /// out_of_memory; unsupported.
  Result<VolumePicture> render(const VolumeScene& scene) const;

  const vulkan::DeviceInfo& info() const { return device_->info(); }
  /// Messages of Vulkan's validation layer; empty unless GpuOptions::validation is set.
  std::vector<std::string> messages() const { return device_->messages(); }

 private:
  struct Kept;

  /// Does the work of render(). May throw std::bad_alloc, which render() catches.
  Result<Image> draw(const RenderScene& scene) const;

  Renderer(std::unique_ptr<VulkanDevice> device, std::unique_ptr<JobSystem> jobs);

  std::unique_ptr<VulkanDevice> device_;
  std::unique_ptr<JobSystem> jobs_;
  std::unique_ptr<Kept> kept_;  ///< pipelines that are reused for the next picture
};

}  // namespace sgm
