#include "tools/support/surroundings.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

namespace sgm::cli {
namespace {

constexpr int64_t kAroundUnits = int64_t{48} * kUnitsPerMetre;
constexpr int64_t kMaxAcross = int64_t{1024} * kUnitsPerMetre;
constexpr uint64_t kMaxCells = 4096;  // maximum number of grammar cells in each layer that are searched for shapes

IntBox around(const std::array<int64_t, 3>& centre, const std::array<int64_t, 3>& half) {
  IntBox box;
  for (size_t a = 0; a < 3; ++a) {
    box.lo[static_cast<int>(a)] = saturate(centre[a] - half[a]);
    box.hi[static_cast<int>(a)] = saturate(centre[a] + half[a]);
  }
  return box;
}

IntBox around(const std::array<int64_t, 3>& centre) {
  return around(centre, {kAroundUnits, kAroundUnits, kAroundUnits});
}

IntBox cube(int64_t metres) {
  const int64_t units = metres * kUnitsPerMetre;
  return around({}, {units, units, units});
}

double squareOf(Int3 p) { return 1.0 * p.x * p.x + 1.0 * p.y * p.y + 1.0 * p.z * p.z; }

/// Squared distance from the world's origin to the nearest point of the box, in square units.
double squareTo(const IntBox& box) {
  Int3 nearest;
  for (int axis = 0; axis < 3; ++axis) nearest[axis] = std::clamp(0, box.lo[axis], box.hi[axis]);
  return squareOf(nearest);
}

Result<std::optional<Int3>> nearestAnchor(const WorldField& world, std::string_view wanted) {
  std::optional<Int3> nearest;
  // Search small cubes first: a large cube may contain a very large number of cells.
  for (const int64_t metres : {16, 32, 64, 128, 256, 512}) {
    const Result<std::vector<Anchor>> anchors = world.anchors(cube(metres));
    if (!anchors && nearest) break;  // this cube cannot be searched: use the anchor found in a smaller cube
    if (!anchors) return anchors.error();
    for (const Anchor& anchor : *anchors) {
      if (!isWanted(*world.settings().program, anchor, wanted)) continue;
      if (!nearest || squareOf(anchor.frame.origin) < squareOf(*nearest)) nearest = anchor.frame.origin;
    }
    // An anchor in a corner of this cube may be farther from the origin than another anchor just outside a face of the
    // cube. In this case, search the next cube as well.
    const double units = static_cast<double>(metres * kUnitsPerMetre);
    if (nearest && squareOf(*nearest) <= units * units) break;
  }
  return nearest;
}

bool isLarge(const IntBox& box) {
  bool large = false;
  for (int axis = 0; axis < 3; ++axis) large |= int64_t{box.hi[axis]} - box.lo[axis] > kMaxAcross;
  return large;
}

/// The box of the shape nearest to the origin, joined with the boxes that touch it. If the joined box is too large,
/// returns only its middle part.
IntBox nearestShapes(const std::vector<IntBox>& shapes) {
  const IntBox nearest = *std::min_element(shapes.begin(), shapes.end(),
                                           [](const IntBox& a, const IntBox& b) { return squareTo(a) < squareTo(b); });
  IntBox all = nearest;
  for (const IntBox& shape : shapes) {
    const IntBox with = all.joined(shape);
    if (shape.meets(nearest) && !isLarge(with)) all = with;
  }
  std::array<int64_t, 3> middle{}, half{};
  for (size_t a = 0; a < 3; ++a) {
    const int64_t lo = all.lo[static_cast<int>(a)], hi = all.hi[static_cast<int>(a)];
    middle[a] = (lo + hi) / 2;
    half[a] = std::clamp((hi - lo + 1) / 2, kAroundUnits, kMaxAcross / 2);
  }
  return around(middle, half);
}

}  // namespace

Result<std::vector<IntBox>> shapesIn(const WorldField& world, const IntBox& box) {
  const Program& program = *world.settings().program;
  std::vector<IntBox> found;
  for (uint32_t layer = 0; layer < program.layers.size(); ++layer) {
    uint64_t cells = 0;
    const Result<void> visited = world.cellsAround(layer, box, [&](Int3 at) -> Result<void> {
      if (++cells > kMaxCells) return {};
      const Result<std::shared_ptr<const DerivedCell>> cell = world.cell(layer, at);
      if (!cell) return cell.error();
      for (const Group& group : (*cell)->chunk.groups) {
        if (group.cut == program.domain.solid && group.bounds.meets(box)) found.push_back(group.bounds);
      }
      return {};
    });
    if (!visited) return visited.error();
  }
  return found;
}

bool isWanted(const Program& program, const Anchor& anchor, std::string_view wanted) {
  const std::string_view name = program.names[anchor.name], kind = program.names[anchor.kind];
  const std::string_view tag = program.tags[anchor.tag];
  return wanted.empty() || name == wanted || kind == wanted || tag == wanted;
}

IntBox surroundingsOf(const std::array<double, 3>& place) {
  std::array<int64_t, 3> centre{};
  for (size_t axis = 0; axis < 3; ++axis) centre[axis] = static_cast<int64_t>(place[axis] * kUnitsPerMetre);
  return around(centre);
}

Result<IntBox> surroundings(const WorldField& world, std::string_view wanted_anchor) {
  const Result<std::optional<Int3>> anchor = nearestAnchor(world, wanted_anchor);
  if (!anchor) return anchor.error();
  if (*anchor) return around({(*anchor)->x, (*anchor)->y, (*anchor)->z});
  if (!wanted_anchor.empty()) return around({});
  for (const int64_t metres : {48, 512, 2048, 8192}) {
    const Result<std::vector<IntBox>> shapes = shapesIn(world, cube(metres));
    if (!shapes) return shapes.error();
    if (!shapes->empty()) return metres == 48 ? around({}) : nearestShapes(*shapes);
  }
  return around({});
}

}  // namespace sgm::cli
