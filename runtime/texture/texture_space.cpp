#include "texture/texture_space.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/math.h"
#include "texture/sweep_line.h"

namespace sgm {
namespace {

/// flag in a chart's number: u is mirrored, because the surface bounds a cavity (the void is inside the shape)
constexpr Chart kMirrored = 0x8000;
// chart numbers of a sweep (side, far end, near end) and of a round shape (side, top, bottom)
constexpr int kSide = 0, kTop = 1, kBottom = 2;
constexpr Chart kFirstSide = 2;  ///< number of a prism's first side chart; the charts of its two ends have lower
                                 ///< numbers

size_t largestAxis(const TexturePoint& v) {
  const double x = std::fabs(v[0]), y = std::fabs(v[1]), z = std::fabs(v[2]);
  return x >= y && x >= z ? 0 : y >= z ? 1 : 2;
}

/// Returns the face of an axis-aligned cube that a direction from its centre hits: twice the axis, plus 1 on the
/// negative side.
int faceOf(const TexturePoint& v) {
  const size_t axis = largestAxis(v);
  return 2 * static_cast<int>(axis) + (v[axis] < 0 ? 1 : 0);
}

TexturePoint pointAt(Int3 p) { return {double{1} * p.x, double{1} * p.y, double{1} * p.z}; }

double product(const TexturePoint& a, const TexturePoint& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

double product(Vec3 a, const TexturePoint& b) { return a.x * b[0] + a.y * b[1] + a.z * b[2]; }

}  // namespace

TextureSpace::TextureSpace(Int3 base, int32_t tile) : tile_(tile), origin_(pointAt(base)) {}

TextureSpace::TextureSpace(const GrammarChunk& chunk, uint32_t index, int32_t tile) : tile_(tile) {
  const Shape& s = chunk.shapes[index];
  const auto points = std::span(chunk.points).subspan(s.first_point, s.point_count);
  origin_ = pointAt(s.frame.origin);
  for (size_t row = 0; row < 3; ++row) {
    axes_[row] = {double{s.frame.rows[3 * row]}, double{s.frame.rows[3 * row + 1]}, double{s.frame.rows[3 * row + 2]}};
  }
  const auto& z = s.size;
  const auto sizes = [&](float a, float b, float c) { size_ = {double{a}, double{b}, double{c}}; };
  const bool is_line = s.kind != ShapeKind::prism && points.size() >= 2;
  if (is_line) {
    kind_ = Kind::line;
    origin_ = pointAt(points[0]);
    const Shape& piece = s.child_count > 0 ? chunk.shapes[chunk.children[s.first_child]] : s;
    square_ = piece.kind == ShapeKind::box;
    // The orientation of the cross-section (`up`) comes from the first piece, not from the scope: the flat sides of a
    // beam are parallel to the axes of each of its pieces.
    const std::array<float, 9>& rows = piece.frame.rows;
    const Vec3 up = square_ ? Vec3{double{rows[3]}, double{rows[4]}, double{rows[5]}} : Vec3{0, 1, 0};
    line_ = std::make_shared<const SweepLine>(points, up);
    sizes(z[0], 0, 0);
    return;
  }
  switch (s.kind) {
    case ShapeKind::sphere:
      kind_ = Kind::ball;
      sizes(z[0], z[0], z[0]);
      break;
    case ShapeKind::ellipsoid:
    case ShapeKind::superquadric:
      kind_ = Kind::ball;
      sizes(z[0], z[1], z[2]);
      break;
    case ShapeKind::box:
      kind_ = Kind::faces;
      break;
    case ShapeKind::cylinder:
      kind_ = Kind::round;
      sizes(z[0], z[0], z[1]);
      break;
    case ShapeKind::truncone:
      kind_ = Kind::round;
      sizes(z[0], z[1], z[2]);
      break;
    case ShapeKind::torus:
      kind_ = Kind::ring;
      sizes(z[0], z[1], 0);
      break;
    case ShapeKind::halfspace:
      kind_ = Kind::plane;
      break;
    case ShapeKind::capsule: {
      const Int3 axis{static_cast<int32_t>(z[1]), static_cast<int32_t>(z[2]), static_cast<int32_t>(z[3])};
      if (axis == Int3{}) {
        kind_ = Kind::ball;
        axes_ = {TexturePoint{1, 0, 0}, TexturePoint{0, 1, 0}, TexturePoint{0, 0, 1}};
        sizes(z[0], z[0], z[0]);
        break;
      }
      kind_ = Kind::line;
      const std::array<Int3, 2> ends{s.frame.origin, saturatingAdd(s.frame.origin, axis)};
      line_ = std::make_shared<const SweepLine>(ends);
      sizes(z[0], 0, 0);
      break;
    }
    case ShapeKind::prism:
      kind_ = Kind::prism;
      for (const Int3& corner : points) corners_.push_back({double(corner.x), double(corner.z)});
      break;
    case ShapeKind::morph_power:  // a morphed shape has no texture coordinates of its own, because its radii vary from
                                  // place to place
    case ShapeKind::voxels:
    case ShapeKind::unite:
    case ShapeKind::meet:
    case ShapeKind::subtract:
    case ShapeKind::unite_smooth:
    case ShapeKind::meet_smooth:
    case ShapeKind::subtract_smooth:
    case ShapeKind::sum:
    case ShapeKind::morph:
    case ShapeKind::displace:
    case ShapeKind::warp:
      break;  // combinations of shapes, and voxels, have no texture coordinates of their own
  }
}

TexturePoint TextureSpace::turned(const TexturePoint& world) const {
  return {product(axes_[0], world), product(axes_[1], world), product(axes_[2], world)};
}

TexturePoint TextureSpace::local(const TexturePoint& p) const {
  return turned({p[0] - origin_[0], p[1] - origin_[1], p[2] - origin_[2]});
}

double TextureSpace::tilesAround(double radius) const {
  return std::max(1.0, detFloor(2 * kPi * radius / tile_ + 0.5));
}

double TextureSpace::tilesAroundLine() const {
  return square_ ? std::max(1.0, detFloor(8 * size_[0] / tile_ + 0.5)) : tilesAround(size_[0]);
}

double TextureSpace::turnOf(const SweepPlace& place) const {
  const double side = place.side, up = place.up;
  if (!square_ || (side == 0 && up == 0)) return detAtan2(side, up) / (2 * kPi);
  // Across each of a beam's four flat sides, the angle grows linearly, by a quarter turn in total.
  if (std::fabs(up) < std::fabs(side)) return (side > 0 ? 0.25 : -0.25) - up / side / 8;
  if (up > 0) return side / up / 8;
  return side / up / 8 + (side > 0 ? 0.5 : -0.5);
}

TextureCoordinates TextureSpace::plane(const TexturePoint& q, int face) const {
  const double sign = (face & 1) != 0 ? -1 : 1;
  switch (face >> 1) {
    case 0:
      return {-sign * q[2] / tile_, q[1] / tile_};
    case 1:
      return {sign * q[0] / tile_, -q[2] / tile_};
    default:
      return {sign * q[0] / tile_, q[1] / tile_};
  }
}

TexturePoint TextureSpace::outwardAt(const TexturePoint& q) const {
  switch (kind_) {
    case Kind::ball:
      return {q[0] / size_[0], q[1] / size_[1], q[2] / size_[2]};
    case Kind::round:
      return {q[0], 0, q[2]};
    case Kind::ring: {
      const double around = std::sqrt(q[0] * q[0] + q[2] * q[2]);
      const double part = around > 0 ? (around - size_[0]) / around : 0;
      return {q[0] * part, q[1], q[2] * part};
    }
    case Kind::world:
    case Kind::faces:
    case Kind::line:
    case Kind::plane:
    case Kind::prism:
      break;
  }
  return {};
}

Chart TextureSpace::chartOf(const TexturePoint& middle, const TexturePoint& normal) const {
  const auto side = [](int chart, double outward) { return static_cast<Chart>(chart | (outward < 0 ? kMirrored : 0)); };
  if (kind_ == Kind::line) {
    const SweepPlace place = line_->at({middle[0] - origin_[0], middle[1] - origin_[1], middle[2] - origin_[2]});
    const double ahead = product(place.tangent, normal);
    // A triangle belongs to an end of the line if its normal points along the line and if it lies near that end. The
    // normal alone is not enough: on a rough side, some triangles have such a normal, too.
    const bool far_end = place.along > line_->length() - size_[0] / 2, near_end = place.along < size_[0] / 2;
    if ((far_end || near_end) && 2 * ahead * ahead > product(normal, normal)) {
      const bool is_far = far_end && !(near_end && place.along < line_->length() / 2);
      return side(is_far ? kTop : kBottom, is_far ? ahead : -ahead);
    }
    return side(kSide, product(place.outward, normal));
  }
  const TexturePoint q = local(middle), n = turned(normal);
  switch (kind_) {
    case Kind::world:
    case Kind::faces:
      return static_cast<Chart>(faceOf(n));
    case Kind::ball: {
      const TexturePoint outward = outwardAt(q);
      return side(faceOf(outward), product(outward, n));
    }
    case Kind::round: {
      // The side of a truncated cone is inclined: `out` is the component of n along the normal of this inclined side. A
      // triangle belongs to an end if the component of its normal n along the axis is larger, and more than half of n.
      const double lean = (size_[0] - size_[1]) / (2 * size_[2]);
      const TexturePoint radial = outwardAt(q);
      const double wide = std::sqrt(product(radial, radial)), whole = std::sqrt(product(n, n));
      const double out = wide > 0 ? (product(radial, n) / wide + lean * n[1]) / std::sqrt(1 + lean * lean) : 0;
      if (std::fabs(n[1]) > std::fabs(out) && std::fabs(n[1]) > 0.5 * whole) {
        // The second argument of side() is positive if the normal points out of the shape; otherwise side() returns a
        // mirrored chart.
        const int end = q[1] > 0 ? kTop : kBottom;
        return side(end, end == kTop ? n[1] : -n[1]);
      }
      return side(kSide, out);
    }
    case Kind::ring:
      return side(0, product(outwardAt(q), n));
    case Kind::plane:
      return side(0, n[1]);
    case Kind::prism:
      return prismChart(q, n);
    case Kind::line:
      break;
  }
  return 0;
}

Chart TextureSpace::prismChart(const TexturePoint& q, const TexturePoint& n) const {
  if (std::fabs(n[1]) > std::sqrt(n[0] * n[0] + n[2] * n[2])) return n[1] > 0 ? 0 : 1;
  size_t nearest = 0;
  double least = std::numeric_limits<double>::max();
  bool outside = true;
  for (size_t i = 0; i < corners_.size(); ++i) {
    const auto &a = corners_[i], &b = corners_[(i + 1) % corners_.size()];
    const double dx = b[0] - a[0], dz = b[1] - a[1];
    const double t = std::clamp(((q[0] - a[0]) * dx + (q[2] - a[1]) * dz) / (dx * dx + dz * dz), 0.0, 1.0);
    const double x = q[0] - a[0] - t * dx, z = q[2] - a[1] - t * dz;
    if (x * x + z * z >= least) continue;
    least = x * x + z * z;
    nearest = i;
    // If the corners are counter-clockwise seen from +y, (-dz, dx) is the outward normal of the edge (dx, dz). If they
    // are clockwise, (-dz, dx) is the inward normal, but then the edge also runs in the opposite direction along u. So
    // the texture is not mirrored in either case.
    outside = -dz * n[0] + dx * n[2] >= 0;
  }
  const size_t chart = kFirstSide + nearest;
  return static_cast<Chart>(chart | (outside ? 0 : kMirrored));
}

TextureCoordinates TextureSpace::at(const TexturePoint& p, Chart whole_chart) const {
  const bool mirrored = (whole_chart & kMirrored) != 0;
  const int chart = whole_chart & ~kMirrored;
  const auto facing = [mirrored](TextureCoordinates c) { return mirrored ? TextureCoordinates{-c.u, c.v} : c; };
  if (kind_ == Kind::line) {
    const SweepPlace place = line_->at({p[0] - origin_[0], p[1] - origin_[1], p[2] - origin_[2]});
    if (chart != kSide) return facing({(chart == kTop ? -place.side : place.side) / tile_, place.up / tile_});
    return facing({turnOf(place) * tilesAroundLine(), place.along / tile_});
  }
  const TexturePoint q = local(p);
  switch (kind_) {
    case Kind::world:
    case Kind::faces:
      return plane(q, chart);
    case Kind::ball: {
      const auto axis = static_cast<size_t>(chart >> 1);
      const TexturePoint unit = outwardAt(q);
      const double depth = std::max(std::fabs(unit[axis]), 1e-6);
      const auto bent = [&](size_t of) { return size_[of] * detAtan2(unit[of], depth); };
      return facing(plane({bent(0), bent(1), bent(2)}, chart));
    }
    case Kind::round: {
      if (chart != kSide) return facing(plane(q, chart == kTop ? 2 : 3));
      const double slope = (size_[0] - size_[1]) / (2 * size_[2]);
      const double turn = detAtan2(q[0], q[2]) / (2 * kPi);
      return facing({turn * tilesAround((size_[0] + size_[1]) / 2), q[1] * std::sqrt(1 + slope * slope) / tile_});
    }
    case Kind::ring: {
      const double out = std::sqrt(q[0] * q[0] + q[2] * q[2]) - size_[0];
      return facing({detAtan2(q[0], q[2]) / (2 * kPi) * tilesAround(size_[0]),
                     detAtan2(q[1], out) / (2 * kPi) * tilesAround(size_[1])});
    }
    case Kind::plane:
      return facing(plane(q, 2));
    case Kind::prism: {
      if (chart < kFirstSide) return plane(q, 2 + chart);
      const auto edge = static_cast<size_t>(chart - kFirstSide);
      const auto &a = corners_[edge], &b = corners_[(edge + 1) % corners_.size()];
      const double dx = b[0] - a[0], dz = b[1] - a[1];
      const double along = ((q[0] - a[0]) * dx + (q[2] - a[1]) * dz) / std::sqrt(dx * dx + dz * dz);
      return facing({along / tile_, q[1] / tile_});
    }
    case Kind::line:
      break;
  }
  return {};
}

TextureCoordinates TextureSpace::period(Chart whole_chart) const {
  const int chart = whole_chart & ~kMirrored;
  switch (kind_) {
    case Kind::line:
      return {chart == kSide ? tilesAroundLine() : 0, 0};
    case Kind::round:
      return {chart == kSide ? tilesAround((size_[0] + size_[1]) / 2) : 0, 0};
    case Kind::ring:
      return {tilesAround(size_[0]), tilesAround(size_[1])};
    case Kind::world:
    case Kind::ball:
    case Kind::faces:
    case Kind::plane:
    case Kind::prism:
      break;
  }
  return {};
}

}  // namespace sgm
