#pragma once
// The settings of an SgmWorld3D and their defaults.

#include <map>
#include <string>
#include <vector>

#include "godot/conversion.h"

namespace sgm_godot {

struct Settings {
  /// The work that follows a change of a setting. kLook and kPlacement are done at once, the other kinds in the next
  /// frame. No kind includes the work of another kind.
  enum Effect : unsigned {
    kNothing = 0,
    kField = 1,    // the world gets another field
    kRestart = 2,  // another world
    kPaint = 4,    // other materials
    kRepack = 8,   // other slots
    kLook = 16,    // visibility, shadows or render layers change
    kPlacement = 32,
    kBodies = 64,  // collision layers
  };

#define SGM_SETTING(type, name, otherwise, ...) type name = otherwise;
#define SGM_SETTING_GROUP(title)
#include "settings.def"
#undef SGM_SETTING_GROUP
#undef SGM_SETTING

  // Values by the names that the grammar gives them. The inspector lists them as parameters/NAME, materials/NAME and
  // colors/NAME.
  std::map<std::string, double> parameters;
  std::map<std::string, Variant> materials;
  std::map<std::string, Color> colors;
};

/// Whether the new value of a setting equals the old one.
template <class T>
bool isSameSetting(const T& a, const T& b) {
  return a == b;
}
/// Dictionaries never count as equal: a script may change the elements of a dictionary and set the same dictionary
/// again.
inline bool isSameSetting(const Dictionary&, const Dictionary&) { return false; }

}  // namespace sgm_godot
