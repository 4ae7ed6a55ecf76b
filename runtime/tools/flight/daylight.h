#pragma once
// Decides whether pictures from a camera should be lit by the sun or by a lamp, by casting rays through the field. The
// chunks need not be meshed for this.

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

/// The first hit of a ray with a solid surface.
struct RayEnd {
  double distance = 0;  ///< metres from the ray's start
  Metres3 normal{0};    ///< unit normal, points out of the solid
  uint32_t material = 0;
  bool inside = false;  ///< true if the ray starts in the solid
};

/// Casts a ray of `metres` length. Returns nullopt if the ray hits nothing.
using CastRay =
    std::function<Result<std::optional<RayEnd>>(const Metres3& from, const Metres3& direction, double metres)>;

/// The properties of a world that determine its light.
struct LitWorld {
  CastRay cast;
  bool roofless = true;           ///< false if endless rock lies above everything
  double sky_metres = 256;        ///< length of upward rays; a ray that hits nothing within this length counts as
                                  ///< reaching the sky
  std::vector<bool> translucent;  ///< for each material index: whether it transmits light, as glass and clouds do
  /// Distance from a surface at which rays from that surface start, so that they do not hit it again.
  double clearance_metres = 1.0 / 256;

  /// Returns the properties of a world with this kind of domain; `cast` and `translucent` are not set. solid: the
  /// domain is rock with hollows. endless_height: its grammar cells are stacked without end.
  static LitWorld of(bool solid, bool endless_height);
};

/// Whether the material with this name transmits light.
bool isTranslucent(std::string_view material);

/// Position, direction and field of view of a camera in the world. Lengths are in metres.
struct CameraPlace {
  Metres3 position{0};
  Metres3 direction{0, 0, -1};  ///< not 0
  double fov_degrees = 68;      ///< vertical field of view
  double aspect = 16.0 / 9;     ///< width of the picture divided by its height
};

/// The quantities from which the light of a camera's picture is chosen. They are measured by casting rays from the
/// camera.
struct Outlook {
  /// Share of the sky, 0..1, that is visible from the surfaces in the picture. Rays are spread evenly over the picture;
  /// at the end of each ray, five upward directions are tested, and the share of unobstructed directions is averaged
  /// over all rays.
  double daylight = 0;
  bool buried = false;  ///< true if the camera is inside a solid; in this case the other members are not set
  double depth = 1;     ///< typical distance in metres to the visible surfaces, at most 256
};

/// Computes the outlook of a camera. Errors: those of casting rays.
Result<Outlook> lookOut(const LitWorld& world, const CameraPlace& camera);

/// The light with this name: "sun", "lamp" or "none"; nullopt for other names, such as "auto".
std::optional<Light> lightNamed(std::string_view name);
const char* lightName(Light light);

/// If Outlook::daylight is at least this value, pictures are lit by the sun, otherwise by a lamp.
inline constexpr double kEnoughDaylight = 0.03;
/// Returns Light::sun if daylight is at least kEnoughDaylight, otherwise Light::lamp.
Light lightAt(double daylight);

/// Chooses the light of successive pictures without flicker: it changes the light only after two successive values of
/// daylight that both clearly call for the other light.
class SteadyLight {
 public:
  /// Returns the light for the next picture. anew: the camera has jumped, so earlier values of daylight do not count.
  Light next(double daylight, bool anew);

 private:
  std::optional<Light> light_;
  bool doubted_ = false;  ///< true if the previous value of daylight was clearly on the other side of kEnoughDaylight
                          ///< than the current light
};

}  // namespace sgm::cli
