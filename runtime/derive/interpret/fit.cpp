// Derives the statement `fit`, which places an asset in its scope. The box of the scope is centred on the scope's
// origin.

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "base/math.h"
#include "derive/interpret/statements.h"

namespace sgm::interpret {
namespace {

/// Margin in units by which the box around an asset is enlarged, so that the box's own faces never become part of the
/// surface.
constexpr double kBoxMargin = 2;
constexpr double kUnitsOfMetre = kUnitsPerMetre;

Vec3 vecOf(asset::Point p) { return {p.x, p.y, p.z}; }

/// Returns a placement on the plane, at the point nearest to `from`, with y along the plane's normal. If the plane is
/// vertical, x is horizontal and z points down, for textures.
Placement onPlane(const Placement& scope, const asset::Plane& plane, Vec3 from) {
  const Vec3 out = vecOf(plane.normal);
  const double away = dot(out, from) - plane.offset;
  Placement place = scope.moved(from - away * out);
  constexpr double kLying = 0.999;
  const Vec3 level = std::fabs(out.y) > kLying ? across(out, {1, 0, 0}) : normalised(cross({0, 1, 0}, out));
  const Vec3 columns[3] = {scope.direction(level), scope.direction(out), scope.direction(cross(level, out))};
  for (int row = 0; row < 3; ++row)
    for (size_t column = 0; column < 3; ++column)
      place.axes[3 * static_cast<size_t>(row) + column] = columns[column][row];
  return place;
}

/// Returns the frame of the half-space below the placement's xz plane. A frame's origin has integer units; among nearby
/// integer points, the one nearest to the plane is chosen.
Frame frameOn(const Placement& place) {
  Frame frame = place.frame();
  const Vec3 out = place.direction({0, 1, 0}), cell = place.toCell({});
  for (int axis = 0; axis < 3; ++axis)
    if (std::fabs(out[axis]) == 1) return frame;
  const Int3 nearest = frame.origin;
  double least = kInfinity;
  for (int32_t z = -2; z <= 2; ++z)
    for (int32_t y = -2; y <= 2; ++y)
      for (int32_t x = -2; x <= 2; ++x) {
        const Int3 candidate = saturatingAdd(nearest, {x, y, z});
        const Int3 from_base = saturatingSub(candidate, place.base);
        const Vec3 off{from_base.x - kUnitsOfMetre * cell.x, from_base.y - kUnitsOfMetre * cell.y,
                       from_base.z - kUnitsOfMetre * cell.z};
        const double away = std::fabs(dot(off, out));
        // A candidate replaces the nearest one so far only if it is nearer by more than the rounding error. So rounding
        // never decides between equally near candidates.
        if (away >= least - 1e-6) continue;
        least = away;
        frame.origin = candidate;
      }
  return frame;
}

}  // namespace

void runFit(const StmtNode& s, CellContext& c, const Env& env, ShapeList& out) {
  const FitNode& node = c.program.ast.fits[s.extra];
  for (int axis = 0; axis < 3; ++axis) {
    if (env.scope[axis] > 0 && std::isfinite(env.scope[axis])) continue;
    const std::string letter(1, "xyz"[axis]);
    return c.budget.note("this scope has no size along " + letter +
                             ", so nothing fits into it: give it one, such as size(" + letter + " 3m)",
                         s.span, env.activation);
  }
  std::vector<asset::FitZone> zones;
  for (uint32_t i = 0; i < node.zones.count; ++i) {
    const FitZoneNode& zone = c.program.ast.fit_zones[node.zones.first + i];
    zones.push_back({zone.axis, zone.repeats, c.evaluator.real(zone.from, env), c.evaluator.real(zone.to, env)});
  }
  const asset::Point size{env.scope.x, env.scope.y, env.scope.z};
  const FittedAsset& body = c.assets.fit(node.asset, size, zones, s.span, env.activation, c.budget);
  if (c.budget.failed()) return;
  if (!body.trouble.empty()) return c.budget.note(body.trouble + "; it is left out", s.span, env.activation);
  const Asset& from = c.program.assets[node.asset];
  const Vec3 corner = -0.5 * env.scope;
  // Pieces behind the same face of the asset share its half-space, and thus its texture coordinates.
  std::map<std::pair<uint32_t, uint32_t>, uint32_t> sides;
  ShapeList pieces;
  for (const asset::ConvexPiece& piece : body.pieces) {
    if (!c.budget.step(piece.size(), s.span, env.activation)) return;
    ShapeList planes;
    for (const asset::PieceSide& side : piece) {
      const auto [known, fresh] = sides.try_emplace({side.number, side.material}, 0u);
      if (fresh) {
        Shape plane = shapeIn(env, ShapeKind::halfspace);
        plane.frame = frameOn(onPlane(env.place, side.plane, corner));
        const uint16_t material = side.material == asset::kNoMaterial ? uint16_t{0} : from.materials[side.material];
        if (material != 0 && env.forced_material == 0) plane.material = material;
        known->second = c.sink.addShape(plane, s.ordinal, s.span, env);
      }
      planes.push_back(known->second);
    }
    pieces.push_back(planes.size() == 1
                         ? planes[0]
                         : c.sink.addShape(shapeIn(env, ShapeKind::meet), s.ordinal, s.span, env, planes));
    if (c.budget.failed()) return;
  }
  // Half-spaces with inclined planes have no bounds, so each piece is intersected with a box.
  Shape box = shapeIn(env, ShapeKind::box);
  box.frame = env.place.frame();
  double inner = kInfinity;
  for (int axis = 0; axis < 3; ++axis) {
    const double half = 0.5 * env.scope[axis] * env.place.scale * kUnitsOfMetre;
    inner = std::min(inner, half);
    box.size[static_cast<size_t>(axis)] = static_cast<float>(half + kBoxMargin);
  }
  box.inner_radius = static_cast<float>(inner);
  const uint32_t bound = c.sink.addShape(box, s.ordinal, s.span, env);
  const uint32_t whole =
      pieces.size() == 1 ? pieces[0] : c.sink.addShape(shapeIn(env, ShapeKind::unite), s.ordinal, s.span, env, pieces);
  out.push_back(c.sink.addShape(shapeIn(env, ShapeKind::meet), s.ordinal, s.span, env, {whole, bound}));
}

}  // namespace sgm::interpret
