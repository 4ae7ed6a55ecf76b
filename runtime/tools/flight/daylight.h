#pragma once
// Decides whether the sun or a lamp lights what a camera sees, by rays cast over the field itself, drawn or not.

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
  bool inside = false;  ///< the ray starts in the solid
};

/// Casts a ray of `metres` length; nullopt if it hits nothing.
using CastRay =
    std::function<Result<std::optional<RayEnd>>(const Metres3& from, const Metres3& direction, double metres)>;

/// A world for computing light.
struct LitWorld {
  CastRay cast;
  bool roofless = true;                 ///< false: endless rock lies above everything
  double sky_metres = 256;              ///< a ray upwards that hits nothing within this distance has reached the sky
  std::vector<bool> translucent;        ///< by material: transmits light, as glass and clouds do
  double clearance_metres = 1.0 / 256;  ///< offset from a surface, so that a ray does not hit the surface where it
                                        ///< starts

  /// By the domain's kind. endless_height: cells are stacked without end.
  static LitWorld of(bool solid, bool endless_height);
};

/// Whether a material of that name transmits light.
bool isTranslucent(std::string_view material);

/// Position and view of a camera in the world, metres.
struct CameraPlace {
  Metres3 position{0};
  Metres3 direction{0, 0, -1};  ///< not 0
  double fov_degrees = 68;      ///< across the picture's height
  double aspect = 16.0 / 9;     ///< the picture's width by its height
};

/// The data that decide on a camera's light.
struct Outlook {
  /// The share, 0..1, of the sky that is visible from what the camera sees: for rays spread evenly over the picture,
  /// the mean share of five upward directions that are open at the ray's end.
  double daylight = 0;
  bool buried = false;  ///< the camera is in the solid: then nothing else is known
  double depth = 1;     ///< typical distance in metres to what is seen, at most 256
};

/// Errors: those of the rays.
Result<Outlook> lookOut(const LitWorld& world, const CameraPlace& camera);

/// "sun", "lamp" and "none"; nullopt for other names, such as "auto".
std::optional<Light> lightNamed(std::string_view name);
const char* lightName(Light light);

/// Share of the sky from which pictures are taken by daylight.
inline constexpr double kEnoughDaylight = 0.03;
/// Sun for kEnoughDaylight or more, otherwise the lamp.
Light lightAt(double daylight);

/// The light of successive pictures, without flicker: it changes only if two successive looks clearly call for the
/// other light.
class SteadyLight {
 public:
  /// anew: the camera has come from far away, so its earlier looks do not count.
  Light next(double daylight, bool anew);

 private:
  std::optional<Light> light_;
  bool doubted_ = false;  ///< by the previous look
};

}  // namespace sgm::cli
