#pragma once
// Texture coordinates of a shape: along and around a passage, over the faces of a box, or by the world's axes if no
// shape makes the surface.

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "derive/shape.h"

namespace sgm {

/// A part of a shape's surface that has its own layout.
using Chart = uint16_t;

/// x, y, z.
using TexturePoint = std::array<double, 3>;

class SweepLine;
struct SweepPlace;

struct TextureCoordinates {
  double u = 0, v = 0;
};

/// Coordinates count square tiles. Around a closed direction the number of tiles is whole, so that a repeating texture
/// meets itself; u x v points into the void, so that no texture is mirrored.
///
///   sphere, ellipsoid, superquadric   six charts by the local axis that is largest, as a cube's, by equal angles; an
///                                     ellipsoid seven times as wide as high has 0.5 to 1.4 times as many tiles
///   box, prism                        a chart for each face
///   cylinder, truncone                around and along the side; the ends by their plane
///   capsule, tube                     around and along the line; the ends by their plane
///   beam                              the same, around by the way along its four sides
///   torus                             around the ring and around the tube: one chart
///   halfspace                         its plane
///   all others                        none of their own: by the world's axes
///
/// Immutable. Positions are world positions in units, exact in double precision.
class TextureSpace {
 public:
  /// Maps by the world's axes, from a base in units. tile: its edge, units, at least 1. If each base is a multiple of
  /// the tile, the tiles of all parts of the world lie on one lattice.
  TextureSpace(Int3 base, int32_t tile);
  /// For a leaf, or for the union of a sweep's pieces; byWorld() if the shape has no coordinates of its own.
  TextureSpace(const GrammarChunk& chunk, uint32_t shape, int32_t tile);

  /// The chart for a triangle with this centre and this normal (any length, out of the solid).
  Chart chartOf(const TexturePoint& middle, const TexturePoint& normal) const;
  /// True if the world's axes map it: triplanar blending then looks better than one chart.
  bool byWorld() const { return kind_ == Kind::world; }
  /// The coordinates of a point, in the chart of any triangle near it.
  TextureCoordinates at(const TexturePoint& p, Chart chart) const;
  /// The period in tiles after which a position repeats; 0: never. If it is not 0, at() jumps by it somewhere.
  TextureCoordinates period(Chart chart) const;

 private:
  enum class Kind : uint8_t { world, ball, faces, round, line, ring, plane, prism };

  TexturePoint local(const TexturePoint& p) const;
  TexturePoint turned(const TexturePoint& world) const;
  TextureCoordinates plane(const TexturePoint& q, int face) const;
  Chart prismChart(const TexturePoint& q, const TexturePoint& n) const;
  /// The outward normal of the undisplaced surface at a local point.
  TexturePoint outwardAt(const TexturePoint& q) const;
  double tilesAround(double radius) const;
  double tilesAroundLine() const;
  /// The angle around the line, from -1/2 to 1/2 turn, 0 on the upper side.
  double turnOf(const SweepPlace& place) const;

  Kind kind_ = Kind::world;
  double tile_ = 1;
  TexturePoint origin_{};
  std::array<TexturePoint, 3> axes_{TexturePoint{1, 0, 0}, TexturePoint{0, 1, 0}, TexturePoint{0, 0, 1}};
  std::array<double, 3> size_{};  ///< ball: radii; round: bottom, top, half height; line: radius; ring: ring, tube
  std::shared_ptr<const SweepLine> line_;
  bool square_ = false;                         ///< line: a beam
  std::vector<std::array<double, 2>> corners_;  ///< of a prism, local x and z
};

}  // namespace sgm
