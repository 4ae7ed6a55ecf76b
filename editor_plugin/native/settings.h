#pragma once
// The settings of an SgmWorld3D and their defaults.

#include <map>
#include <string>
#include <vector>

#include "godot/conversion.h"

namespace sgm_godot {

struct Settings {
  /// The work that follows a change: kLook and kPlacement at once, the others in the next frame. No effect includes the
  /// work of another.
  enum Effect : unsigned {
    kNothing = 0,
    kField = 1,    // another field for the same world
    kRestart = 2,  // another world
    kPaint = 4,    // other materials
    kRepack = 8,   // other slots
    kLook = 16,    // visibility, shadows, layers
    kPlacement = 32,
    kBodies = 64,  // collision layers
  };

#define SGM_SETTING(type, name, otherwise, ...) type name = otherwise;
#define SGM_SETTING_GROUP(title)
#include "settings.def"
#undef SGM_SETTING_GROUP
#undef SGM_SETTING

  // By names of the grammar, which the inspector lists as parameters/NAME, materials/NAME and colors/NAME.
  std::map<std::string, double> parameters;
  std::map<std::string, Variant> materials;
  std::map<std::string, Color> colors;
};

/// Whether a setting has the value already.
template <class T>
bool isSameSetting(const T& a, const T& b) {
  return a == b;
}
/// Never for dictionaries: a script may have changed the elements of the one that it sets again.
inline bool isSameSetting(const Dictionary&, const Dictionary&) { return false; }

}  // namespace sgm_godot
