#pragma once
// Texture coordinates for the surface of a shape: along and around a sweep, on the faces of a box, or along the world's
// axes if no single shape makes the surface.

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "derive/shape.h"

namespace sgm {

/// Number of a chart: a part of a shape's surface with its own texture layout.
using Chart = uint16_t;

/// Coordinates x, y, z.
using TexturePoint = std::array<double, 3>;

class SweepLine;
struct SweepPlace;

struct TextureCoordinates {
  double u = 0, v = 0;
};

/// Computes texture coordinates for points of a shape's surface. Coordinates count square tiles. Around a closed shape
/// (for example, around a tube) the number of tiles is whole, so that a repeating texture joins. The cross product u x
/// v points into the void, so that no texture is mirrored. The layout by kind of shape:
///
///   sphere, ellipsoid, superquadric   six charts as on a cube, selected by the largest local coordinate, with equal
///                                     angles per tile; an ellipsoid seven times as wide as high has 0.5 to 1.4 times
///                                     the intended number of tiles
///   box, prism                        a chart for each face
///   cylinder, truncone                around and along the side; each end in its plane
///   capsule, tube                     around and along the line; each end in its plane
///   beam                              as tube, but coordinates around it follow its four flat sides
///   torus                             around the ring and around the tube: one chart
///   halfspace                         in its plane
///   all others                        mapped along the world's axes
///
/// Immutable. Positions are world positions in units (1/1024 m), exact in double precision.
class TextureSpace {
 public:
  /// Maps points along the world's axes. base: the point with texture coordinates 0, in units (1/1024 m). tile: edge
  /// length of a tile in units, at least 1. If the base of each chunk is a multiple of `tile`, the tiles of all chunks
  /// lie on one lattice.
  TextureSpace(Int3 base, int32_t tile);
  /// Maps points by a leaf shape of the chunk, or by a union whose children are the pieces of a sweep. If the shape has
  /// no coordinates of its own, maps along the world's axes, and byWorld() is true.
  TextureSpace(const GrammarChunk& chunk, uint32_t shape, int32_t tile);

  /// Returns the chart of a triangle. middle: its centre. normal: points out of the solid; any length.
  Chart chartOf(const TexturePoint& middle, const TexturePoint& normal) const;
  /// True if points are mapped along the world's axes; triplanar blending then looks better than a single chart.
  bool byWorld() const { return kind_ == Kind::world; }
  /// Returns the texture coordinates of a point in the given chart, which must be the chart of a triangle near the
  /// point.
  TextureCoordinates at(const TexturePoint& p, Chart chart) const;
  /// Returns the period of each coordinate in tiles; 0 if it is not periodic. Where the surface closes, a periodic
  /// coordinate jumps by its period.
  TextureCoordinates period(Chart chart) const;

 private:
  enum class Kind : uint8_t { world, ball, faces, round, line, ring, plane, prism };

  TexturePoint local(const TexturePoint& p) const;
  TexturePoint turned(const TexturePoint& world) const;
  TextureCoordinates plane(const TexturePoint& q, int face) const;
  Chart prismChart(const TexturePoint& q, const TexturePoint& n) const;
  /// Returns the outward normal of the undisplaced shape's surface at a point in local coordinates.
  TexturePoint outwardAt(const TexturePoint& q) const;
  double tilesAround(double radius) const;
  double tilesAroundLine() const;
  /// Returns the angle around the line in turns, from -1/2 to 1/2; 0 is the upper side.
  double turnOf(const SweepPlace& place) const;

  Kind kind_ = Kind::world;
  double tile_ = 1;
  TexturePoint origin_{};
  std::array<TexturePoint, 3> axes_{TexturePoint{1, 0, 0}, TexturePoint{0, 1, 0}, TexturePoint{0, 0, 1}};
  /// dimensions in units, by kind. ball: the radii; round: bottom radius, top radius, half height; line: radius; ring:
  /// radii of ring and tube
  std::array<double, 3> size_{};
  std::shared_ptr<const SweepLine> line_;
  bool square_ = false;                         ///< used if kind_ is line: true if the cross-section is square (a beam)
  std::vector<std::array<double, 2>> corners_;  ///< used if kind_ is prism: local x and z of the corners
};

}  // namespace sgm
