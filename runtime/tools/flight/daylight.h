#pragma once
// Whether the sun lights what a camera sees, or a lamp must: by rays cast over the real field, drawn or not.

#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "grammar/syntax/program.h"
#include "sgm/sgm.h"
#include "tools/flight/flight_curve.h"
#include "tools/render/camera.h"

namespace sgm::cli {

/// The first solid on a ray.
struct RayEnd {
  double distance = 0;  ///< metres
  Metres3 normal{0};    ///< out of the solid
  uint32_t material = 0;
  bool inside = false;  ///< the ray begins in the solid
};

/// Casts a ray of so many metres; nullopt: it meets nothing.
using CastRay =
    std::function<Result<std::optional<RayEnd>>(const Metres3& from, const Metres3& direction, double metres)>;

/// A world as light sees it.
struct LitWorld {
  CastRay cast;
  bool roofless = true;                 ///< false: rock without an end lies above everything
  double sky_metres = 256;              ///< a ray that meets nothing on this way up has come to the sky
  std::vector<bool> translucent;        ///< by material: light passes through, as through glass and clouds
  double clearance_metres = 1.0 / 256;  ///< from a surface, so that a ray does not meet what it starts from

  /// By the domain's kind: endless_height says that cells are stacked on each other without an end.
  static LitWorld of(bool solid, bool endless_height);
};

/// Whether light passes through a material of that name.
bool isTranslucent(std::string_view material);

/// Where a camera is in the world, metres, and what it sees.
struct CameraPlace {
  Metres3 position{0};
  Metres3 direction{0, 0, -1};  ///< not 0
  double fov_degrees = 68;      ///< across the picture's height
  double aspect = 16.0 / 9;     ///< the picture's width by its height
};

/// What a camera's light depends on.
struct Outlook {
  /// The share, 0..1, of the sky that is open to what the camera sees: the mean, over rays spread evenly over the
  /// picture, of how many of five directions upwards lie open where the ray ends.
  double daylight = 0;
  bool buried = false;  ///< the camera is in the solid itself: nothing else is known then
  double depth = 1;     ///< typical distance in metres to what is seen, at most 256
};

/// Errors: those of the rays.
Result<Outlook> lookOut(const LitWorld& world, const CameraPlace& camera);

/// "sun", "lamp" and "none"; nullopt: the name is another one, such as "auto".
std::optional<Light> lightNamed(std::string_view name);
const char* lightName(Light light);

/// From this share on one photographs by daylight.
inline constexpr double kEnoughDaylight = 0.03;
/// Sun from kEnoughDaylight on, else the lamp.
Light lightAt(double daylight);

/// The light of pictures that follow each other, which must not flicker: it changes where two looks one after the other
/// are clearly for the other light.
class SteadyLight {
 public:
  /// anew: the camera has come from far away, and what it saw there does not count.
  Light next(double daylight, bool anew);

 private:
  std::optional<Light> light_;
  bool doubted_ = false;  ///< by the look before
};

}  // namespace sgm::cli
