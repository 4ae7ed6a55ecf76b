#include "mesh/rounded_cells.h"

#include "mesh/cell_loops.h"
#include "mesh/fan_conflicts.h"
#include "mesh/fan_triangles.h"

namespace sgm {

namespace {

/// The maximum number of sharp loop sides in chunk faces near a claim (mesh/rounded_cells.h), besides the claim's own
/// side. A claim with more sides fails. Each of these sides may or may not have its face vertices, so each doubles the
/// number of cases to test.
constexpr size_t kMaxOthers = 4;

}  // namespace

RoundedCells::RoundedCells(const ChunkGrid& grid, const FieldSampler& field, const PlaceAlone& place_alone,
                           std::pmr::memory_resource* memory)
    : grid_(grid),
      place_alone_(place_alone),
      part_(memory),
      loops_(memory),
      claims_(memory),
      others_(memory),
      creases_(grid, field, part_, memory),
      memory_(memory) {}

void RoundedCells::add(SharpSide& side, const VertexKey& from, const VertexKey& to, bool above,
                       const std::array<int32_t, 8>& q) {
  Int3 cell;
  for (int k = 0; k < 3; ++k) {
    cell[k] = static_cast<int32_t>((int64_t{side.corner[k]} - grid_.origin[k]) / grid_.cell);
  }
  if (!above) --cell[side.axis];
  const size_t first = loops_.size();
  addCellLoops(grid_, cell, q, part_, loops_);
  claims_.push_back({&side, from, to, cell, first, loops_.size(), loops_.size()});
}

void RoundedCells::addBeside(const Int3& steps, const std::array<int32_t, 8>& q) {
  Claim& claim = claims_.back();
  Int3 cell = claim.cell;
  for (int k = 0; k < 3; ++k) cell[k] += steps[k];
  addCellLoops(grid_, cell, q, part_, loops_);
  claim.end_beside = loops_.size();
}

void RoundedCells::judge() {
  if (claims_.empty()) return;
  creases_.settle();
  findOthers();
  for (const Claim& claim : claims_)
    if (!claim.side->places.empty() && !keepsClear(claim)) claim.side->places = {};
}

bool RoundedCells::isOwn(const Claim& claim, uint32_t a, uint32_t b) const {
  return (part_.keys[a] == claim.from && part_.keys[b] == claim.to) ||
         (part_.keys[a] == claim.to && part_.keys[b] == claim.from);
}

/// A claim says that a rounded loop intersects no other loop. For each claim, finds the other loop sides near it that
/// may have face vertices in a face of the chunk, and places these vertices.
void RoundedCells::findOthers() {
  std::pmr::vector<SharpSide> sides(memory_);
  std::pmr::vector<Border> all(memory_);
  for (Claim& claim : claims_) {
    claim.first_other = all.size();
    for (size_t number = claim.first; number < claim.end_beside; ++number) {
      const SurfaceLoop& loop = loops_[number];
      for (uint32_t i = 0; i < loop.count; ++i) {
        const uint32_t a = loop.vertices[i], b = loop.vertices[(i + 1) % loop.count];
        SharpSide side = sideBetween(a, b, part_.keys);
        if (floorDiv(side.corner[side.axis], grid_.cell) % kChunkCells != 0 || isOwn(claim, a, b)) continue;
        if (!creases_.isSharp(a, b)) continue;
        side.at_border = true;
        all.push_back({number, i, side});
        sides.push_back(side);
      }
    }
    claim.end_other = all.size();
  }
  if (!sides.empty()) place_alone_(creases_, sides);
  for (Claim& claim : claims_) {
    const size_t first = claim.first_other, end = claim.end_other;
    claim.first_other = others_.size();
    for (size_t i = first; i < end; ++i) {
      if (sides[i].places.empty()) continue;
      others_.push_back(all[i]);
      others_.back().side.places = sides[i].places;
    }
    claim.end_other = others_.size();
  }
}

std::optional<RoundedCells::Border> RoundedCells::ownOf(const Claim& claim) const {
  for (size_t number = claim.first; number < claim.end; ++number) {
    const SurfaceLoop& loop = loops_[number];
    for (uint32_t i = 0; i < loop.count; ++i)
      if (isOwn(claim, loop.vertices[i], loop.vertices[(i + 1) % loop.count])) return Border{number, i, *claim.side};
  }
  return std::nullopt;
}

bool RoundedCells::keepsClear(const Claim& claim) const {
  const std::optional<Border> own = ownOf(claim);
  const std::span<const Border> others(others_.data() + claim.first_other, claim.end_other - claim.first_other);
  if (!own || others.size() > kMaxOthers) return false;
  for (uint32_t present = 0; present < 1u << others.size(); ++present) {
    const LoopTriangles rounded = trianglesOf(own->loop, *own, others, present);
    if (hasFault(rounded)) return false;
    for (size_t other = claim.first; other < claim.end_beside; ++other)
      if (other != own->loop && anyMeets(rounded, trianglesOf(other, *own, others, present))) return false;
  }
  return true;
}

/// Returns the triangles of a loop with only some of its face vertices: those of the claim's own side, and those of the
/// other sides whose bit in `present` is set. A vertex that the loop shares with the loop of the claim's own side gets
/// the same name (NamedTriangle::name) as in that loop.
LoopTriangles RoundedCells::trianglesOf(size_t number, const Border& own, std::span<const Border> others,
                                        uint32_t present) const {
  const SurfaceLoop &loop = loops_[number], &own_loop = loops_[own.loop];
  const auto nameOf = [&](uint32_t v) {
    for (uint32_t i = 0; i < own_loop.count; ++i)
      if (part_.keys[own_loop.vertices[i]] == part_.keys[v]) return own_loop.vertices[i];
    return v;
  };
  std::array<FanPoint, kLongestCubeLoop + FacePlaces::kMost*(kMaxOthers + 1)> ring;
  std::array<BorderVertex, FacePlaces::kMost*(kMaxOthers + 1)> at_border;
  std::array<Int3, kLongestCubeLoop> vertices;
  size_t count = 0, at_border_count = 0;
  const auto addSide = [&](const Border& border, size_t which_border) {
    const SharpSide& side = border.side;
    const std::span<const Int3> places = side.places.all();
    const uint32_t a = loop.vertices[border.behind], b = loop.vertices[(border.behind + 1) % loop.count];
    for (size_t k = 0; k < places.size(); ++k) {
      const size_t which = part_.keys[a] < part_.keys[b] ? k : places.size() - 1 - k;
      const Int3 at = fromChunk(grid_, side, places[which]);
      at_border[at_border_count++] = {at, side.axis};
      const size_t name = FacePlaces::kMost * which_border + which;
      ring[count++] = {at, kFaceVertices + static_cast<uint32_t>(name), true};
    }
  };
  for (uint32_t i = 0; i < loop.count; ++i) {
    vertices[i] = placeOf(part_, loop.vertices[i]);
    ring[count++] = {vertices[i], nameOf(loop.vertices[i])};
    if (own.loop == number && own.behind == i) addSide(own, others.size());
    for (size_t k = 0; k < others.size(); ++k)
      if (others[k].loop == number && others[k].behind == i && (present >> k & 1) != 0) addSide(others[k], k);
  }
  if (at_border_count > 0) {
    const Int3 centre = roundedCentre(loop.cell, {vertices.data(), loop.count}, {at_border.data(), at_border_count});
    return coneTriangles({centre, kCellVertices + static_cast<uint32_t>(number), true}, {ring.data(), count}, true);
  }
  LoopTriangles triangles = plainTriangles(part_, loop);
  for (NamedTriangle& triangle : triangles.all())
    for (uint32_t& name : triangle.name) name = nameOf(name);
  return triangles;
}

}  // namespace sgm
