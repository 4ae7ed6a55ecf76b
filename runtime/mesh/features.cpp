#include "mesh/features.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "mesh/border_vertices.h"
#include "mesh/facing.h"
#include "mesh/fan_conflicts.h"
#include "mesh/swallowed_parts.h"

namespace sgm {
namespace {

Vector3 plus(const Vector3& a, const Vector3& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
Vector3 times(const Vector3& a, double factor) { return {a[0] * factor, a[1] * factor, a[2] * factor}; }

Vector3 unitsOf(const Int3& place, int32_t cell) {
  const double step = static_cast<double>(cell) / kSubcell;
  return {place.x * step, place.y * step, place.z * step};
}

}  // namespace

Features::Features(const BodyLoops& body, const Creases& creases, const FieldSampler& field,
                   std::pmr::memory_resource* memory)
    : body_(body), creases_(creases), field_(field), memory_(memory), sharp_(body, memory) {}

SharpLoops Features::find() && {
  findSides();
  placeFaceVertices();
  placeCellVertices();
  do {
    roundUntilValid(
        sharp_, [this](const LoopTriangles& fan) { return !hasFault(fan) && facesOut(fan, creases_); },
        [this](SharpLoop& loop) { return takeNextCentre(loop); }, memory_);
  } while (roundAroundSwallowed(sharp_, memory_));
  return std::move(sharp_);
}

void Features::findSides() {
  const RawVector<VertexKey>& keys = body_.part().keys;
  const ChunkGrid& grid = body_.grid();
  const auto nameOf = [&](uint32_t a, uint32_t b) {
    if (keys[b] < keys[a]) std::swap(a, b);
    return uint64_t{a} << 32 | b;
  };
  std::pmr::vector<uint64_t> names(memory_);  // of sides, by their ends
  for (uint32_t number = 0; number < body_.all().size(); ++number) {
    const SurfaceLoop& loop = body_.all()[number];
    const size_t before = names.size();
    for (uint32_t i = 0; i < loop.count; ++i) {
      const uint32_t a = loop.vertices[i], b = loop.vertices[(i + 1) % loop.count];
      if (creases_.isSharp(a, b)) names.push_back(nameOf(a, b));
    }
    if (names.size() > before) sharp_.loops.emplace_back().loop = number;
  }
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  sharp_.sides.reserve(names.size());
  for (const uint64_t name : names) {
    SharpSide& side =
        sharp_.sides.emplace_back(sideBetween(static_cast<uint32_t>(name >> 32), static_cast<uint32_t>(name), keys));
    const int64_t from_chunk = int64_t{side.corner[side.axis]} - grid.origin[side.axis];
    side.at_border = from_chunk == 0 || from_chunk == int64_t{kChunkCells} * grid.cell;
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
      // The cell on the high side of the face has its corner in the face's plane.
      SharpSide& side = sharp_.sides[sharp.sides[i]];
      const bool is_high = body_.cornerOf(loop.cell)[side.axis] == side.corner[side.axis];
      side.loops[is_high ? 1 : 0] = number;
    }
  }
}

/// Of a loop in which several creases meet, the point nearest to its vertices' planes; in units from `corner`.
Vector3 Features::meetingPoint(const SharpLoop& sharp, const Int3& corner, std::span<const Vector3> ideals) const {
  const SurfaceLoop& loop = of(sharp);
  Vector3 middle{};
  double count = 0;
  for (const uint32_t s : sharp.sides) {
    if (s == kNone) continue;
    middle = plus(middle, plus(between(corner, sharp_.sides[s].corner), ideals[s]));
    count += 1;
  }
  middle = times(middle, 1 / count);
  PlaneSum planes;
  for (uint32_t i = 0; i < loop.count; ++i) {
    const Tangent& t = creases_.tangent(loop.vertices[i]);
    planes.add(t.normal, t.distance + dot(t.normal, minus(between(corner, t.point), middle)));
  }
  return plus(middle, PlaneAxes(planes).step(3));
}

/// The mean of a side's own ideal place and the next places on its crease: those of the next sides of its loops, or the
/// points in which the crease ends there. In units from the side's corner.
Vector3 Features::meanOnCrease(const SharpSide& side, std::span<const Vector3> ideals) const {
  const auto own = static_cast<uint32_t>(&side - sharp_.sides.data());
  Vector3 sum = times(ideals[own], 2);
  for (const uint32_t number : side.loops) {
    uint32_t next = kNone, others = 0;
    for (size_t i = 0; number != kNone && i < kLongestCubeLoop; ++i) {
      const uint32_t other = sharp_.loops[number].sides[i];
      if (other == kNone || other == own) continue;
      next = other;
      ++others;
    }
    // Where nothing follows the side's own place stands for it, so that two sides do not get one mean.
    sum = plus(sum, others == 0   ? ideals[own]
                    : others == 1 ? plus(between(side.corner, sharp_.sides[next].corner), ideals[next])
                                  : meetingPoint(sharp_.loops[number], side.corner, ideals));
  }
  return times(sum, 0.25);
}

void Features::placeFaceVertices() {
  placeBorderVertices(body_.grid(), field_, creases_, body_.part().keys, sharp_.sides, memory_);
  std::pmr::vector<Vector3> ideals(memory_);
  ideals.reserve(sharp_.sides.size());
  for (const SharpSide& side : sharp_.sides) {
    if (side.at_border && !side.places.empty()) {
      Vector3 sum{};
      for (const Int3& place : side.places.all()) sum = plus(sum, unitsOf(place, body_.grid().cell));
      ideals.push_back(times(sum, 1.0 / static_cast<double>(side.places.count())));
      continue;
    }
    const Vector3 a = between(side.corner, creases_.tangent(side.from).point);
    const Vector3 b = between(side.corner, creases_.tangent(side.to).point);
    ideals.push_back(creases_.nearestOnCrease(side.from, side.to, side.corner, times(plus(a, b), 0.5)));
  }
  struct Choice {
    size_t side;
    Int3 place;
  };
  std::pmr::vector<Choice> choices(memory_);  // best first, side by side
  std::pmr::vector<Int3> points(memory_);
  for (size_t s = 0; s < sharp_.sides.size(); ++s) {
    const SharpSide& side = sharp_.sides[s];
    if (side.at_border) continue;
    const auto add = [&](const Vector3& units) {
      const Vector3 on_crease = creases_.nearestOnCrease(side.from, side.to, side.corner, units);
      const std::optional<Int3> place = creases_.onGridAlong(side.from, side.to, side.corner, on_crease, side.axis);
      if (!place) return;
      choices.push_back({s, *place});
      points.push_back(creases_.sampledAt(side.corner, *place));
    };
    add(meanOnCrease(side, ideals));
    add(ideals[s]);
  }
  std::pmr::vector<FieldSample> samples(points.size(), memory_);
  if (!points.empty()) field_(points, samples, Sampled::all);
  for (size_t i = 0; i < choices.size(); ++i) {
    SharpSide& side = sharp_.sides[choices[i].side];
    if (side.places.empty() && creases_.isOnSurface(samples[i])) side.places = FacePlaces(choices[i].place);
  }
}

/// The places for the centre of a loop's fan, best first.
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
  if (feature_count == 0) return centres;
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
      centres.add({sharp_.fromChunk(sharp_.sides[s], places[k]), SharpLoops::faceVertexOf(s, k)});
  }
  add(plus(middle, axes.step(2)));
  add(middle);
  return centres;
}

/// Gives each loop the first of its possible centres that makes a sound fan, with one look at the field for all.
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

/// Makes a loop another fan: about the same centre with other diagonals, or about the next centre.
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

/// The next of a loop's possible centres, which counts as tried then; nullopt if all were.
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

/// Makes a loop a fan about a centre, if that fan is sound and faces out of the solid.
bool Features::take(const FanCentre& centre, const FieldSample& sample, SharpLoop& sharp) const {
  if (!creases_.isOnSurface(sample)) return false;
  // About a face vertex, diagonals to the centre may lie in the face of the chunk.
  return (centre.face_vertex == kNone && takeAs(centre, false, sharp)) || takeAs(centre, true, sharp);
}

bool Features::takeAs(const FanCentre& centre, bool by_patches, SharpLoop& sharp) const {
  const LoopTriangles fan = sharp_.fullFan(sharp, centre, by_patches);
  if (!facesOut(fan, creases_)) return false;
  if (hasFault(fan)) {
    if (!sharp.isFan()) sharp.shape = SharpLoop::Shape::rounded;
    return false;
  }
  sharp.shape = SharpLoop::Shape::fan;
  sharp.centre = centre;
  sharp.by_patches = by_patches;
  return true;
}

}  // namespace sgm
