#pragma once
// Dimensions and types of values.

#include <cstdint>
#include <string>

namespace sgm {

/// A physical dimension: exponents of length and angle. Ratios, counts and percentages are {0, 0}; an area is {2, 0}.
/// Numbers are stored in metres, radians and plain ratios (30% is 0.3).
struct Dim {
  int8_t length = 0, angle = 0;
  friend constexpr bool operator==(Dim, Dim) = default;
};

inline constexpr Dim kRatio{0, 0}, kLength{1, 0}, kAngle{0, 1}, kArea{2, 0}, kVolume{3, 0};

/// Returns "length", "angle", "ratio", "area", "volume", or a product such as "length^2 angle".
std::string dimName(Dim dim);

enum class ValueKind : uint8_t {
  unknown,  ///< the type of an invalid expression, or of a parameter of a rule without calls; agrees with every type
  number,   ///< one number of dimension dim
  boolean,
  vector,    ///< three numbers of dimension dim; a point if dim is length
  pair,      ///< a tuple of two numbers of dimension dim: x and z, such as a corner of a prism's base
  cell,      ///< a cell of the layer: `cell`, or the member `other` of a face
  face,      ///< a face of a cell, from cell.faces or cell.links
  faces,     ///< a list of faces, over which `for` iterates
  segment,   ///< one segment of a branching skeleton
  segments,  ///< a list of segments, over which `for` iterates
  plan,      ///< a footprint
  range,     ///< a range a..b of whole numbers, over which `for` iterates
  text,
};

struct Type {
  ValueKind kind = ValueKind::unknown;
  Dim dim;
  bool sample = false;   ///< the value is known only at sample time, since it depends on p, q, u or noise
  bool any_dim = false;  ///< the value agrees with every dimension: the literal 0, or a vector of unknown content
  friend constexpr bool operator==(const Type&, const Type&) = default;
};

inline constexpr Type kUnknownType{};

/// Returns a name for messages: "length", "point", "cell", "sample-time ratio" ...
std::string typeName(const Type& type);
/// Returns a noun with its article: "a length", "an angle".
std::string withArticle(const std::string& noun);

}  // namespace sgm
