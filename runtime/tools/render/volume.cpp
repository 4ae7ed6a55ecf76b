#include "tools/render/volume.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <span>
#include <string>

#include "tools/render/frame.h"
#include "tools/render/lens.h"
#include "tools/render/renderer.h"
#include "tools/render/volume_pass.h"

namespace sgm {
namespace {

constexpr size_t kMaxVolumePoints = size_t{1} << 30;
constexpr uint32_t kMaxOctaves = 32;

Result<void> check(const VolumeScene& scene, const VkPhysicalDeviceLimits& limits) {
  if (auto camera = checkCamera(scene.camera); !camera) return camera.error();
  const auto invalid = [](const char* message) { return Error{Code::invalid_argument, message}; };
  const VolumeMedium& medium = scene.medium;
  if (!(medium.extinction >= 0 && std::isfinite(medium.extinction)))
    return invalid("the extinction must be a number of at least 0");
  if (!(medium.albedo >= 0 && medium.albedo <= 1)) return invalid("the albedo must be 0 to 1");
  if (!(std::abs(medium.forward) < 1)) return invalid("the mean cosine must be above -1 and below 1");
  if (medium.octaves < 1 || medium.octaves > kMaxOctaves) return invalid("there must be 1 to 32 octaves of scattering");
  if (!(scene.spacing > 0 && std::isfinite(scene.spacing))) return invalid("the spacing must be a number above 0");
  const float sun = glm::dot(scene.sun_direction, scene.sun_direction);
  if (!isFinite(scene.corner)) return invalid("the volume's corner must be finite");
  if (!(sun > 0 && std::isfinite(sun))) return invalid("the sun's direction must not be 0");
  if (!(scene.fog_distance > 0)) return invalid("the fog's distance must be above 0");
  if (scene.supersample < 1 || scene.supersample > 3) return invalid("a pixel must have 1, 2 or 3 rays on each side");
  const uint64_t light_bytes =
      sizeof(glm::vec4) * static_cast<uint64_t>(scene.camera.width) * static_cast<uint64_t>(scene.camera.height);
  if (light_bytes > limits.maxStorageBufferRange)
    return Error{Code::unsupported, "this device cannot draw so many pixels of fog: choose a smaller picture"};
  const uint32_t side = std::max({scene.size.x, scene.size.y, scene.size.z});
  if (std::min({scene.size.x, scene.size.y, scene.size.z}) < 2)
    return invalid("a volume must have at least 2 points on each axis");
  if (side > limits.maxImageDimension3D)
    return Error{Code::limit, "this device supports volumes of at most " + std::to_string(limits.maxImageDimension3D) +
                                  " points on an axis, not " + std::to_string(side) +
                                  ": choose a smaller region or larger cells"};
  const size_t points = size_t{scene.size.x} * scene.size.y * scene.size.z;
  if (points > kMaxVolumePoints)
    return Error{Code::limit, "the volume has more than 2^30 points: choose a smaller region or larger cells"};
  if (points != scene.density.size()) return invalid("a volume must have one density per point");
  return {};
}

}  // namespace

Result<VolumePicture> Renderer::render(const VolumeScene& scene) const {
  if (auto checked = check(scene, device_->limits()); !checked) return checked.error();
  VulkanScope scope(*device_);
  const auto pass = makeVolumePass(scope, scene);
  if (!pass) return pass.error();
  const auto drawn = device_->run([&](VkCommandBuffer commands) { recordVolume(device_->calls(), commands, *pass); });
  if (!drawn) return drawn.error();
  VolumePicture picture;
  picture.light.resize(size_t{pass->picture.width} * pass->picture.height);
  std::memcpy(picture.light.data(), pass->light.data, picture.light.size() * sizeof(glm::vec4));
  const std::span exposed(reinterpret_cast<const ExposedPixel*>(pass->pixels.data), picture.light.size());
  picture.image = developed(exposed, scene.camera.width, scene.camera.height);
  return picture;
}

}  // namespace sgm
