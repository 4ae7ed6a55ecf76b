#include "mesh/features.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "mesh/facing.h"
#include "mesh/fan_conflicts.h"
#include "mesh/inner_vertices.h"
#include "mesh/swallowed_parts.h"

namespace sgm {
Features::Features(const BodyLoops& body, const Creases& creases, std::span<const SharpSide> border,
                   const FieldSampler& field, std::pmr::memory_resource* memory)
    : body_(body), creases_(creases), border_(border), field_(field), memory_(memory), sharp_(body, memory) {}

SharpLoops Features::find() && {
  findSides();
  placeInnerVertices(creases_, field_, sharp_, memory_);
  placeCellVertices();
  do {
    roundUntilValid(
        sharp_, [this](const LoopTriangles& fan) { return !hasFault(fan) && facesOut(fan, creases_); },
        [this](SharpLoop& loop) { return takeNextCentre(loop); }, memory_);
  } while (roundAroundSwallowed(sharp_, memory_));
  return std::move(sharp_);
}

/// True if a crease passes through vertices of a loop. Precondition: no side of the loop is sharp (mesh/sharp_loops.h).
bool Features::passesVertices(const SurfaceLoop& loop) const {
  const auto next = [&](uint32_t i) { return loop.vertices[(i + 1) % loop.count]; };
  bool any = false;
  for (uint32_t i = 0; i < loop.count; ++i) any = any || creases_.differ(loop.vertices[i], next(i));
  if (!any) return false;
  for (uint32_t i = 0; i < loop.count; ++i)
    for (uint32_t j = i + 2; j < loop.count; ++j)
      if (creases_.isSharp(loop.vertices[i], loop.vertices[j])) return true;
  return false;
}

void Features::findSides() {
  const RawVector<VertexKey>& keys = body_.part().keys;
  const auto nameOf = [&](uint32_t a, uint32_t b) {
    if (keys[b] < keys[a]) std::swap(a, b);
    return uint64_t{a} << 32 | b;
  };
  // sharp sides of all loops; each side is named by its two end vertices, packed into one word
  std::pmr::vector<uint64_t> names(memory_);
  for (uint32_t number = 0; number < body_.all().size(); ++number) {
    const SurfaceLoop& loop = body_.all()[number];
    const size_t before = names.size();
    for (uint32_t i = 0; i < loop.count; ++i) {
      const uint32_t a = loop.vertices[i], b = loop.vertices[(i + 1) % loop.count];
      if (creases_.isSharp(a, b)) names.push_back(nameOf(a, b));
    }
    if (names.size() > before || passesVertices(loop)) sharp_.loops.emplace_back().loop = number;
  }
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  sharp_.sides.reserve(names.size());
  for (const uint64_t name : names) {
    SharpSide& side =
        sharp_.sides.emplace_back(sideBetween(static_cast<uint32_t>(name >> 32), static_cast<uint32_t>(name), keys));
    side.at_border = isAtBorder(body_.grid(), side);
    if (side.at_border) side = *std::lower_bound(border_.begin(), border_.end(), side);
  }
  for (uint32_t number = 0; number < sharp_.loops.size(); ++number) {
    SharpLoop& sharp = sharp_.loops[number];
    const SurfaceLoop& loop = of(sharp);
    sharp.sides.fill(kNone);
    for (uint32_t i = 0; i < loop.count; ++i) {
      const uint32_t a = loop.vertices[i], b = loop.vertices[(i + 1) % loop.count];
      if (!creases_.isSharp(a, b)) continue;
      sharp.sides[i] =
          static_cast<uint32_t>(std::lower_bound(names.begin(), names.end(), nameOf(a, b)) - names.begin());
      // The cell lies on the high side of the face if its lowest corner lies in the plane of the face.
      SharpSide& side = sharp_.sides[sharp.sides[i]];
      const bool is_high = body_.cornerOf(loop.cell)[side.axis] == side.corner[side.axis];
      side.loops[is_high ? 1 : 0] = number;
    }
  }
}

/// Returns the candidate centres of a loop's fan, best first.
Features::Centres Features::centresOf(const SharpLoop& sharp) const {
  Centres centres;
  const SurfaceLoop& loop = of(sharp);
  const Int3 corner = body_.cornerOf(loop.cell);
  Vector3 all{}, features{};
  double feature_count = 0;
  for (uint32_t i = 0; i < loop.count; ++i) {
    all = plus(all, creases_.unitsFrom(corner, loop.vertices[i]));
    const uint32_t s = sharp.sides[i];
    if (s == kNone) continue;
    for (const Int3& place : sharp_.sides[s].places.all()) {
      features = plus(features, plus(between(corner, sharp_.sides[s].corner), unitsOf(place, body_.grid().cell)));
      feature_count += 1;
    }
  }
  const bool has_sides = std::any_of(sharp.sides.begin(), sharp.sides.end(), [](uint32_t s) { return s != kNone; });
  if (feature_count == 0 && has_sides) return centres;
  const Vector3 middle = feature_count > 1 ? times(features, 1 / feature_count)
                                           : times(plus(all, features), 1 / (feature_count + loop.count));
  const auto add = [&](const Vector3& units) {
    const std::optional<Int3> place = creases_.onGrid(corner, units);
    if (!place) return;
    Int3 at = *place;
    for (int k = 0; k < 3; ++k) at[k] += loop.cell[k] * kSubcell;
    centres.add({at});
  };
  PlaneSum planes;
  const auto take = [&](const Tangent& t) {
    planes.add(t.normal, t.distance + dot(t.normal, minus(between(corner, t.point), middle)));
  };
  for (uint32_t i = 0; i < loop.count; ++i) take(creases_.tangent(loop.vertices[i]));
  const PlaneAxes axes(planes);
  bool has_third = false;
  for (const uint32_t s : sharp.sides) {
    if (s == kNone || !sharp_.sides[s].third) continue;
    take(*sharp_.sides[s].third);
    has_third = true;
  }
  if (has_third) add(plus(middle, PlaneAxes(planes).step(3)));
  add(plus(middle, axes.step(3)));
  for (const uint32_t s : sharp.sides) {
    if (s == kNone || !sharp_.sides[s].at_border) continue;
    const std::span<const Int3> places = sharp_.sides[s].places.all();
    for (size_t k = 0; k < places.size(); ++k)
      centres.add(
          {sharp_.fromChunk(sharp_.sides[s], places[k]), FanCentre::Kind::face_vertex, SharpLoops::faceVertexOf(s, k)});
  }
  if (feature_count >= 4) {
    Int3 within = loop.cell;
    for (int k = 0; k < 3; ++k) within[k] = within[k] * kSubcell + kSubcell / 2;
    centres.add({within, FanCentre::Kind::strip});
    centres.add({within, FanCentre::Kind::strip_from_second});
  }
  add(plus(middle, axes.step(2)));
  if (feature_count == 1) {
    // A crease may end at a vertex of the loop that lies on the crease. Then the loop has only one face vertex, and the
    // midpoint between that face vertex and the loop's vertex is a candidate.
    const uint32_t only = *std::find_if(sharp.sides.begin(), sharp.sides.end(),
                                        [&](uint32_t s) { return s != kNone && !sharp_.sides[s].places.empty(); });
    const SharpSide& side = sharp_.sides[only];
    const Tangent &a = creases_.tangent(side.from), &b = creases_.tangent(side.to);
    for (uint32_t i = 0; i < loop.count; ++i) {
      const Vector3 end = creases_.unitsFrom(corner, loop.vertices[i]);
      if (loop.vertices[i] == side.from || loop.vertices[i] == side.to || !creases_.isOnCrease(a, b, corner, end))
        continue;
      add(times(plus(features, end), 0.5));
    }
  }
  add(middle);
  return centres;
}

/// Gives each loop the first candidate centre that makes a valid fan. The first candidates of all loops are sampled in
/// one call, then the second candidates, and so on; strips are sampled separately.
void Features::placeCellVertices() {
  std::pmr::vector<uint32_t> without(sharp_.loops.size(), memory_), left(memory_);
  std::iota(without.begin(), without.end(), 0);
  std::pmr::vector<FanCentre> centres(memory_);
  std::pmr::vector<Int3> points(memory_);
  std::pmr::vector<FieldSample> samples(memory_);
  while (!without.empty()) {
    centres.clear();
    points.clear();
    left.clear();
    for (const uint32_t number : without) {
      const std::optional<FanCentre> centre = nextCentre(sharp_.loops[number]);
      if (!centre) continue;
      left.push_back(number);
      centres.push_back(*centre);
      points.push_back(creases_.sampledAt(body_.grid().origin, centre->at));
    }
    samples.resize(points.size());
    if (!points.empty()) field_(points, samples, Sampled::all);
    without.clear();
    for (size_t i = 0; i < left.size(); ++i)
      if (!take(centres[i], samples[i], sharp_.loops[left[i]])) without.push_back(left[i]);
  }
}

/// Call this if a loop's fan intersects another loop. Gives the fan other diagonals with the same centre, or the next
/// centre that makes a valid fan. Returns false if no centre is left.
bool Features::takeNextCentre(SharpLoop& sharp) const {
  if (sharp.isFan() && !sharp.by_patches && takeAs(sharp.centre, true, sharp)) return true;
  while (const std::optional<FanCentre> centre = nextCentre(sharp)) {
    const Int3 point = creases_.sampledAt(body_.grid().origin, centre->at);
    FieldSample sample;
    field_({&point, 1}, {&sample, 1}, Sampled::all);
    if (take(*centre, sample, sharp)) return true;
  }
  return false;
}

/// Returns the next candidate centre of a loop, and marks it as tried; nullopt if all candidates were tried.
std::optional<FanCentre> Features::nextCentre(SharpLoop& sharp) const {
  const Centres centres = centresOf(sharp);
  while (sharp.tried < centres.all().size()) {
    const size_t at = sharp.tried++;
    const auto first = centres.all().begin();
    const auto found = std::find(first, first + static_cast<std::ptrdiff_t>(at), centres.all()[at]);
    if (found == first + static_cast<std::ptrdiff_t>(at)) return centres.all()[at];
  }
  return std::nullopt;
}

/// Triangulates a loop as a fan around a centre, or as a strip, provided that the triangles are valid (hasFault), lie
/// on the surface and face out of the solid. Otherwise returns false.
bool Features::take(const FanCentre& centre, const FieldSample& sample, SharpLoop& sharp) const {
  if (centre.isStrip()) return takeStrip(centre, sharp);
  if (!creases_.isOnSurface(sample)) return false;
  // A fan whose centre is a face vertex is always triangulated patch by patch, because some diagonals from its centre
  // could lie in the face of the chunk; patches use only free diagonals.
  return (centre.kind == FanCentre::Kind::cell_vertex && takeAs(centre, false, sharp)) || takeAs(centre, true, sharp);
}

/// Triangulates a loop as a strip, which has no vertex inside the loop, provided that the strip is valid (hasFault) and
/// the centres of its triangles lie on the surface. Otherwise returns false.
bool Features::takeStrip(const FanCentre& centre, SharpLoop& sharp) const {
  const LoopTriangles strip = sharp_.fullFan(sharp, centre, true);
  if (!facesOut(strip, creases_)) return false;
  if (hasFault(strip)) {
    if (!sharp.isFan()) sharp.shape = SharpLoop::Shape::rounded;
    return false;
  }
  std::array<Int3, LoopTriangles::kMost> middles;
  std::array<FieldSample, LoopTriangles::kMost> samples;
  for (size_t i = 0; i < strip.count(); ++i) {
    const std::array<Int3, 3>& at = strip.all()[i].at;
    Int3 middle;
    for (int k = 0; k < 3; ++k) middle[k] = (at[0][k] + at[1][k] + at[2][k]) / 3;
    middles[i] = creases_.sampledAt(body_.grid().origin, middle);
  }
  field_({middles.data(), strip.count()}, {samples.data(), strip.count()}, Sampled::all);
  for (size_t i = 0; i < strip.count(); ++i)
    if (!creases_.isOnSurface(samples[i])) return false;
  makeFan(centre, true, sharp);
  return true;
}

bool Features::takeAs(const FanCentre& centre, bool by_patches, SharpLoop& sharp) const {
  const LoopTriangles fan = sharp_.fullFan(sharp, centre, by_patches);
  if (!facesOut(fan, creases_)) return false;
  if (hasFault(fan)) {
    if (!sharp.isFan()) sharp.shape = SharpLoop::Shape::rounded;
    return false;
  }
  makeFan(centre, by_patches, sharp);
  return true;
}

void Features::makeFan(const FanCentre& centre, bool by_patches, SharpLoop& sharp) {
  sharp.shape = SharpLoop::Shape::fan;
  sharp.centre = centre;
  sharp.by_patches = by_patches;
}

}  // namespace sgm
