#pragma once
// Decides whether the sun or a lamp lights the places that a camera sees, by rays cast through the field itself. Chunks
// need not be meshed for this.

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

/// The first solid surface on a ray.
struct RayEnd {
  double distance = 0;  ///< metres from the ray's start
  Metres3 normal{0};    ///< points out of the solid
  uint32_t material = 0;
  bool inside = false;  ///< true if the ray starts in the solid
};

/// Casts a ray of `metres` length. Returns nullopt if the ray hits nothing.
using CastRay =
    std::function<Result<std::optional<RayEnd>>(const Metres3& from, const Metres3& direction, double metres)>;

/// The properties of a world from which its light is computed.
struct LitWorld {
  CastRay cast;
  bool roofless = true;           ///< false if endless rock lies above everything
  double sky_metres = 256;        ///< a ray upwards that hits nothing within this distance counts as reaching the sky
  std::vector<bool> translucent;  ///< by material index: whether the material transmits light, as glass and clouds do
  /// Distance by which a ray starts off its surface, so that it does not hit that surface.
  double clearance_metres = 1.0 / 256;

  /// The properties for a kind of domain. solid: the domain is solid outside its hollows. endless_height: its cells are
  /// stacked without end.
  static LitWorld of(bool solid, bool endless_height);
};

/// Whether the material with this name transmits light.
bool isTranslucent(std::string_view material);

/// Position and view of a camera in the world, metres.
struct CameraPlace {
  Metres3 position{0};
  Metres3 direction{0, 0, -1};  ///< not 0
  double fov_degrees = 68;      ///< across the picture's height
  double aspect = 16.0 / 9;     ///< the picture's width by its height
};

/// The quantities that decide on the light of a camera's picture.
struct Outlook {
  /// Share of the sky, 0..1, that is visible from the surfaces in the picture: for rays spread evenly over the picture,
  /// the mean share of five upward directions that are unobstructed at the ray's end.
  double daylight = 0;
  bool buried = false;  ///< the camera is in the solid; the other members are then not set
  double depth = 1;     ///< typical distance in metres to the visible surfaces, at most 256
};

/// Computes the outlook of a camera. Errors: those of casting rays.
Result<Outlook> lookOut(const LitWorld& world, const CameraPlace& camera);

/// The light named "sun", "lamp" or "none"; nullopt for other names, such as "auto".
std::optional<Light> lightNamed(std::string_view name);
const char* lightName(Light light);

/// Daylight (Outlook::daylight) from which on pictures are lit by the sun.
inline constexpr double kEnoughDaylight = 0.03;
/// Light::sun for kEnoughDaylight or more, otherwise Light::lamp.
Light lightAt(double daylight);

/// Chooses the light of successive pictures without flicker: the light changes only if two successive values of
/// daylight are clearly on the other side of the threshold.
class SteadyLight {
 public:
  /// Returns the light for the next picture. anew: the camera has come from far away, so its previous values do not
  /// count.
  Light next(double daylight, bool anew);

 private:
  std::optional<Light> light_;
  bool doubted_ = false;  ///< the previous value of daylight was clearly on the other side of the threshold
};

}  // namespace sgm::cli
