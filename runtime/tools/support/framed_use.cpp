#include "tools/support/framed_use.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "tools/framing/frame_camera.h"
#include "tools/framing/rule_frame.h"
#include "tools/support/render_options.h"
#include "tools/survey/columns.h"

namespace sgm::cli {
namespace {

// A triangle counts as part of a use's own surface if its distance from that surface is below this, in cells. A use is
// one application of a rule.
constexpr float kNearOwnSurface = 0.3f;
constexpr size_t kMaxTargets = 12;      // maximum number of rule uses that are examined
constexpr size_t kFewestTriangles = 6;  // minimum number of triangles for a use to be recognizable in a picture

/// The drawn mesh of a region. Converts between positions in the mesh, in metres, and in the world, in units.
struct DrawnRegion {
  const Region& region;
  std::span<const RenderVertex> vertices;
  std::span<const uint32_t> indices;

  glm::vec3 corner(size_t triangle, size_t i) const { return vertices[indices[3 * triangle + i]].position; }
  glm::vec3 middle(size_t triangle) const {
    return (corner(triangle, 0) + corner(triangle, 1) + corner(triangle, 2)) / 3.0f;
  }
  /// Normal of a triangle, pointing into the void; not unit length.
  glm::vec3 facing(size_t triangle) const {
    return glm::cross(corner(triangle, 1) - corner(triangle, 0), corner(triangle, 2) - corner(triangle, 0));
  }
  glm::vec3 place(Int3 units) const {
    const Int3 origin = region.meshed.mesh.origin;
    return {static_cast<float>(metres(units.x) - metres(origin.x)),
            static_cast<float>(metres(units.y) - metres(origin.y)),
            static_cast<float>(metres(units.z) - metres(origin.z))};
  }
  Int3 units(glm::vec3 place) const {
    Int3 at;
    for (int axis = 0; axis < 3; ++axis)
      at[axis] =
          saturate(region.meshed.mesh.origin[axis] + std::llround(static_cast<double>(place[axis]) * kUnitsPerMetre));
    return at;
  }
};

/// A use of a rule, and the triangles of the drawn mesh that show its surface.
struct ShownUse {
  const RuleUse* use = nullptr;
  FrameTarget target;
  bool hollow = false;  ///< true if the use's surface encloses a void, as the walls of a room do
};

std::vector<uint32_t> trianglesIn(const DrawnRegion& drawn, const IntBox& bounds) {
  const glm::vec3 lo = drawn.place(bounds.lo), hi = drawn.place(bounds.hi);
  std::vector<uint32_t> triangles;
  for (size_t i = 0; i < drawn.indices.size() / 3; ++i) {
    const glm::vec3 p = drawn.middle(i);
    if (glm::all(glm::greaterThanEqual(p, lo)) && glm::all(glm::lessThanEqual(p, hi)))
      triangles.push_back(static_cast<uint32_t>(i));
  }
  return triangles;
}

/// The triangles of the mesh that show a use of a rule.
struct OwnSurface {
  std::vector<uint32_t> triangles;
  bool hollow = false;  ///< true if the void is inside the use's shapes, false if it is outside them
};

/// Selects those of the given triangles that lie on the use's own surface, within a fraction of a cell. Fewer than
/// kFewestTriangles mean that an enclosing rule has displaced the surface: then all given triangles are selected.
Result<OwnSurface> ownOf(const DrawnRegion& drawn, const RuleUse& use, int level,
                         const std::vector<uint32_t>& triangles) {
  const float cell = static_cast<float>(metres(drawn.region.cell));
  std::vector<Int3> points;  // three points for each triangle: its centre, and a point on its void side and on its
                             // solid side
  IntBox box;
  for (const uint32_t triangle : triangles) {
    const glm::vec3 facing = drawn.facing(triangle), middle = drawn.middle(triangle);
    const glm::vec3 off = glm::dot(facing, facing) > 0 ? 0.5f * cell * glm::normalize(facing) : glm::vec3(0);
    for (const glm::vec3 p : {middle, middle + off, middle - off}) {
      points.push_back(drawn.units(p));
      box = box.joined({points.back(), points.back()});
    }
  }
  const WorldField alone(drawn.region.world->settings(), use.alone, drawn.region.world->memory());
  const Result<std::vector<float>> values = survey::valuesAt(alone, level, box, points);
  if (!values) return values.error();
  OwnSurface own;
  size_t within = 0;
  for (size_t i = 0; i < triangles.size(); ++i) {
    if (std::fabs((*values)[3 * i]) >= kNearOwnSurface * static_cast<float>(drawn.region.cell)) continue;
    own.triangles.push_back(triangles[i]);
    within += (*values)[3 * i + 1] < (*values)[3 * i + 2];
  }
  own.hollow = 2 * within > own.triangles.size();
  if (own.triangles.size() < kFewestTriangles) own = {triangles, false};
  return own;
}

Result<std::optional<ShownUse>> showUse(const DrawnRegion& drawn, const RuleUse& use, int level) {
  const std::vector<uint32_t> within = trianglesIn(drawn, use.bounds.grown(drawn.region.cell / 4));
  if (within.size() < kFewestTriangles) return std::optional<ShownUse>();
  Result<OwnSurface> own = ownOf(drawn, use, level, within);
  if (!own) return own.error();
  ShownUse shown;
  shown.use = &use;
  shown.hollow = own->hollow;
  shown.target = {glm::vec3(1e30f), glm::vec3(-1e30f), std::move(own->triangles)};
  for (const uint32_t triangle : shown.target.triangles) {
    for (size_t i = 0; i < 3; ++i) {
      shown.target.lo = glm::min(shown.target.lo, drawn.corner(triangle, i));
      shown.target.hi = glm::max(shown.target.hi, drawn.corner(triangle, i));
    }
  }
  return std::optional(std::move(shown));
}

/// The uses in the order of examination: large uses in the middle of the region first. Uses that are only partly in the
/// region are omitted, unless all are.
std::vector<const RuleUse*> inOrder(const std::vector<RuleUse>& uses, const IntBox& extent, int32_t cell) {
  std::vector<const RuleUse*> whole;
  for (const RuleUse& use : uses)
    if (extent.grown(cell).contains(use.bounds)) whole.push_back(&use);
  if (whole.empty())
    for (const RuleUse& use : uses) whole.push_back(&use);
  const auto sizeOf = [](const IntBox& box) {
    double square = 0;
    for (int axis = 0; axis < 3; ++axis) square += std::pow(static_cast<double>(box.hi[axis]) - box.lo[axis], 2);
    return std::sqrt(square);
  };
  double largest = 1;
  for (const RuleUse* use : whole) largest = std::max(largest, sizeOf(use->bounds));
  const auto rank = [&](const RuleUse* use) {
    double square = 0;
    for (int axis = 0; axis < 3; ++axis)
      square += std::pow(
          (static_cast<double>(use->bounds.lo[axis]) + use->bounds.hi[axis] - extent.lo[axis] - extent.hi[axis]) / 2,
          2);
    return 2 * std::sqrt(square) / sizeOf(extent) - sizeOf(use->bounds) / largest;
  };
  std::ranges::stable_sort(whole, {}, rank);
  return whole;
}

}  // namespace

Json toJson(const FramedUse& use) {
  return {{"path", use.path},
          {"bounds", {metresJson(use.bounds.lo), metresJson(use.bounds.hi)}},
          {"inside", use.inside},
          {"seen", use.seen},
          {"fill", use.fill}};
}

std::string textOf(const FramedUse& use) {
  return use.inside ? use.path + ", from inside"
                    : fmt::format("{}, {:.0f} % of its near side visible", use.path, 100 * use.seen);
}

void planFrame(const RenderOptions& options, RegionPlan& plan) {
  const auto cell = std::make_shared<int32_t>(0);
  const auto check_before = plan.check;
  plan.check = [&options, check_before](const Program& program) -> Result<void> {
    const Result<FramedRule> wanted = findFramedRule(program, options.frame);
    if (!wanted) return wanted.error();
    return check_before ? check_before(program) : Result<void>{};
  };
  plan.part = true;
  plan.choose = [&options, cell](const WorldField& world) -> Result<IntBox> {
    const Result<FramedRule> wanted = findFramedRule(*world.settings().program, options.frame);
    if (!wanted) return wanted.error();
    const Result<FrameRegion> around = regionAround(world, *wanted);
    if (!around) return around.error();
    *cell = around->cell;
    return around->region;
  };
  plan.cell = [cell] { return *cell; };
}

Result<View> frameUse(const RenderOptions& options, const Region& region, std::span<const RenderVertex> vertices,
                      std::span<const uint32_t> indices, std::optional<FramedUse>& framed) {
  const Result<FramedRule> wanted = findFramedRule(*region.program, options.frame);
  if (!wanted) return wanted.error();
  const IntBox& extent = region.meshed.extent;
  const Result<std::vector<RuleUse>> uses = usesIn(*region.world, *wanted, extent);
  if (!uses) return uses.error();
  if (uses->empty())
    return Error{Code::invalid_argument,
                 fmt::format("--frame: '{}' is not used in the region: choose another --region, or leave --region out "
                             "for the use nearest to the origin",
                             options.frame)};
  const DrawnRegion drawn{region, vertices, indices};
  std::vector<ShownUse> shown;
  for (const RuleUse* use : inOrder(*uses, extent, region.cell)) {
    if (shown.size() == kMaxTargets) break;
    Result<std::optional<ShownUse>> one = showUse(drawn, *use, region.level);
    if (!one) return one.error();
    if (*one) shown.push_back(std::move(**one));
  }
  const PictureSize size = *readSize(options.size);
  for (const ShownUse& one : shown) {
    if (!one.hollow) break;
    const glm::vec3 middle = 0.5f * (one.target.lo + one.target.hi);
    CameraRequest request;
    request.width = size.width;
    request.height = size.height;
    request.fov_degrees = static_cast<float>(options.fov);
    request.anchors = {&middle, 1};
    Result<View> view = chooseCamera(vertices, indices, request);
    if (!view || !view->at_anchor) continue;
    framed = FramedUse{one.use->path, one.use->bounds, true, 1, 1};
    return view;
  }
  std::vector<FrameTarget> targets;
  for (const ShownUse& one : shown) targets.push_back(one.target);
  RenderCamera request;
  request.width = size.width;
  request.height = size.height;
  request.fov_degrees = static_cast<float>(options.fov);
  // A place at which the field cannot be evaluated counts as solid.
  const Result<std::optional<FramedView>> framing = frameTargets(vertices, indices, targets, request, [&](glm::vec3 p) {
    const Int3 at = drawn.units(p);
    const Result<std::vector<float>> value = survey::valuesAt(*region.world, region.level, {at, at}, {&at, 1});
    return value && (*value)[0] > 0;
  });
  if (!framing) return framing.error();
  const std::optional<FramedView>& found = *framing;
  if (!found)
    return Error{
        Code::invalid_argument,
        fmt::format("--frame: no use of '{}' is visible in the region: it may be too small for cells of {} m (choose a "
                    "smaller --cell), or hidden by its surroundings (place the camera with --camera)",
                    options.frame, metres(region.cell))};
  const RuleUse& use = *shown[found->target].use;
  framed = FramedUse{use.path, use.bounds, false, static_cast<double>(found->seen), static_cast<double>(found->fill)};
  return viewFrom(vertices, indices, found->camera);
}

}  // namespace sgm::cli
