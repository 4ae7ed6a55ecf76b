#pragma once
// Random unions and cuts of boxes, prisms and balls in any orientation. They have all kinds of edges and corners that
// sharp features must handle, including concave ones, and thin walls.

#include <random>

#include "measured_surface.h"

namespace sgm::test {

/// The two cell sizes with which solids are meshed, in metres; the second is not a power of two in units.
inline constexpr double kSolidCells[] = {0.5, 0.3};

inline double between(std::mt19937& random, double low, double high) {
  return low + (high - low) * static_cast<double>(random()) / 4294967295.0;
}

inline std::string metresText(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3fm", value);
  return text;
}

/// A random rotation. One in four is by a multiple of 45 degrees, with which faces and edges coincide with the grid and
/// with each other.
inline std::string turn(std::mt19937& random) {
  const bool even = random() % 4 == 0;
  std::string text;
  for (const char axis : {'y', 'x', 'z'}) {
    char one[48];
    std::snprintf(one, sizeof one, "rot(%c, %.3fdeg) ", axis,
                  even ? 45.0 * static_cast<double>(random() % 8) : between(random, 0, 360));
    text += one;
  }
  return text;
}

inline std::string place(std::mt19937& random, double reach) {
  // One position in four lies on a lattice that is aligned with grid cells.
  const bool even = random() % 4 == 0;
  std::string text = "at(";
  for (int axis = 0; axis < 3; ++axis) {
    const double at = between(random, -reach, reach);
    text += (axis > 0 ? ", " : "") + metresText(even ? 0.5 * std::round(2 * at) : at);
  }
  return text + ") ";
}

/// A random length of a side; one in six is shorter than a cell.
inline std::string side(std::mt19937& random) {
  return metresText(random() % 6 == 0 ? between(random, 0.1, 0.5) : between(random, 1, 6));
}

inline std::string shape(std::mt19937& random) {
  switch (random() % 3) {
    case 0:
      return "box(" + side(random) + ", " + side(random) + ", " + side(random) + ");";
    case 1: {
      // The corners are sorted by angle around the middle, so that no sides cross; the prism may be concave.
      const int corners = 3 + static_cast<int>(random() % 4);
      std::string text = "prism(" + side(random);
      for (int i = 0; i < corners; ++i) {
        const double angle = 2 * 3.14159265358979 * (i + between(random, 0, 0.6)) / corners,
                     radius = between(random, 0.8, 3.5);
        text += ", (" + metresText(radius * std::cos(angle)) + ", " + metresText(radius * std::sin(angle)) + ")";
      }
      return text + ");";
    }
    default:
      return "sphere(" + metresText(between(random, 0.6, 3)) + ");";
  }
}

/// Two to five shapes; each shape after the first is subtracted with a probability of two fifths.
inline std::string randomSolid(std::mt19937& random) {
  std::string text = "sgm 1;\nunits m;\ndomain finite box(32m, 32m, 32m) empty;\nstart Solid;\nrule Solid {\n  " +
                     turn(random) + "box(" + metresText(between(random, 2, 7)) + ", " +
                     metresText(between(random, 2, 7)) + ", " + metresText(between(random, 2, 7)) + ");\n";
  const int more = 1 + static_cast<int>(random() % 4);
  for (int i = 0; i < more; ++i) {
    text += random() % 5 < 2 ? "  cut " : "  ";
    text += place(random, 3.5) + turn(random) + shape(random) + "\n";
  }
  return text + "}\n";
}

}  // namespace sgm::test
