#pragma once
// Texture coordinates of a shape: along and around a passage, over the faces of a box, or along the world's axes if no
// shape makes the surface.

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "derive/shape.h"

namespace sgm {

/// A part of a shape's surface that has its own layout.
using Chart = uint16_t;

/// Coordinates x, y, z.
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
///   beam                              as tube, but around it the distance along its four sides counts
///   torus                             around the ring and around the tube: one chart
///   halfspace                         its plane
///   all others                        none of their own: along the world's axes
///
/// Immutable. Positions are world positions in units, exact in double precision.
class TextureSpace {
 public:
  /// Maps along the world's axes. base: the point with coordinates 0, in units. tile: edge of a tile in units, at least
  /// 1. If each base is a multiple of the tile, the tiles of all parts of the world lie on one lattice.
  TextureSpace(Int3 base, int32_t tile);
  /// Maps by a leaf of the chunk's shapes, or by the union of a sweep's pieces; byWorld() if the shape has no
  /// coordinates of its own.
  TextureSpace(const GrammarChunk& chunk, uint32_t shape, int32_t tile);

  /// Returns the chart of a triangle. middle: its centre. normal: of any length, points out of the solid.
  Chart chartOf(const TexturePoint& middle, const TexturePoint& normal) const;
  /// True if points are mapped along the world's axes: then triplanar blending looks better than one chart.
  bool byWorld() const { return kind_ == Kind::world; }
  /// Returns the coordinates of a point in the given chart. The chart must be that of a triangle near the point.
  TextureCoordinates at(const TexturePoint& p, Chart chart) const;
  /// Returns the period of each coordinate, in tiles; 0 if it is not periodic. A periodic coordinate jumps by its
  /// period where the surface closes.
  TextureCoordinates period(Chart chart) const;

 private:
  enum class Kind : uint8_t { world, ball, faces, round, line, ring, plane, prism };

  TexturePoint local(const TexturePoint& p) const;
  TexturePoint turned(const TexturePoint& world) const;
  TextureCoordinates plane(const TexturePoint& q, int face) const;
  Chart prismChart(const TexturePoint& q, const TexturePoint& n) const;
  /// Returns the outward normal of the shape's surface, without displacement, at a local point.
  TexturePoint outwardAt(const TexturePoint& q) const;
  double tilesAround(double radius) const;
  double tilesAroundLine() const;
  /// Returns the angle around the line in turns, -1/2 to 1/2; 0 on the upper side.
  double turnOf(const SweepPlace& place) const;

  Kind kind_ = Kind::world;
  double tile_ = 1;
  TexturePoint origin_{};
  std::array<TexturePoint, 3> axes_{TexturePoint{1, 0, 0}, TexturePoint{0, 1, 0}, TexturePoint{0, 0, 1}};
  /// ball: the radii; round: bottom radius, top radius, half height; line: radius; ring: radii of ring and tube
  std::array<double, 3> size_{};
  std::shared_ptr<const SweepLine> line_;
  bool square_ = false;                         ///< for a line: true if it is a beam
  std::vector<std::array<double, 2>> corners_;  ///< for a prism: the corners' local x and z
};

}  // namespace sgm
