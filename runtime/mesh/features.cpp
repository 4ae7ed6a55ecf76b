#include "mesh/features.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "mesh/fan_conflicts.h"

namespace sgm {
namespace {

/// Of a cell's face: what slivers may look away for their vertices' rounding to 1/256 of a cell.
constexpr double kFold = 0.02;

/// The axis of the face that two edges of a cell share; -1 if they share none.
int sharedFace(const VertexKey& a, const VertexKey& b) {
  if (a.axis != b.axis) {
    const int axis = 3 - a.axis - b.axis;
    return a.corner[axis] == b.corner[axis] ? axis : -1;
  }
  const int first = (a.axis + 1) % 3, second = (a.axis + 2) % 3;
  if (a.corner[first] == b.corner[first]) return first;
  return a.corner[second] == b.corner[second] ? second : -1;
}

Int3 lowest(const Int3& a, const Int3& b) { return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)}; }

Vector3 plus(const Vector3& a, const Vector3& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
Vector3 times(const Vector3& a, double factor) { return {a[0] * factor, a[1] * factor, a[2] * factor}; }

Vector3 unitsOf(const Int3& place, int32_t cell) {
  const double step = static_cast<double>(cell) / kSubcell;
  return {place.x * step, place.y * step, place.z * step};
}

bool endsBefore(const SharpSide& a, const SharpSide& b) { return a.from != b.from ? a.from < b.from : a.to < b.to; }

}  // namespace

bool Features::hasFaceVertex(const SharpSide& side) const {
  return side.place && std::all_of(side.loops.begin(), side.loops.end(), [&](uint32_t number) {
           return number == kNone || (loops_[number].centre && !loops_[number].rounded);
         });
}

VertexKey faceVertexKey(const SharpSide& side, const VertexKey& from) {
  const int across = 3 - side.axis - from.axis;
  const int of_face = from.axis * 2 + (from.corner[across] == side.corner[across] ? 0 : 1);
  return {side.corner, from.level, static_cast<uint8_t>(kFaceVertex + side.axis), static_cast<uint8_t>(of_face)};
}

Features::Features(SurfacePatch& patch, const FieldSampler& field, std::pmr::memory_resource* memory)
    : patch_(patch),
      field_(field),
      memory_(memory),
      creases_(patch.grid(), field, patch.part(), memory),
      sides_(memory),
      loops_(memory) {}

void Features::settle() {
  std::pmr::vector<uint32_t> fresh(patch_.part().vertices.size() - settled_, memory_);
  if (fresh.empty()) return;
  std::iota(fresh.begin(), fresh.end(), settled_);
  creases_.settle(fresh);
  settled_ += static_cast<uint32_t>(fresh.size());
}

bool Features::isSharp(const SurfaceLoop& loop) const {
  for (uint32_t i = 0; i < loop.count; ++i) {
    if (creases_.isSharp(loop.vertices[i], loop.vertices[(i + 1) % loop.count])) return true;
  }
  return false;
}

void Features::find(std::span<const uint32_t> inner, std::span<const uint32_t> border) {
  findSides();
  placeFaceVertices();
  placeCellVertices();
  FanConflicts conflicts(patch_, sides_, loops_, memory_);
  conflicts.roundInAnyState(border);
  conflicts.roundUntilValid(inner);
}

void Features::findSides() {
  const RawVector<VertexKey>& keys = patch_.part().keys;
  const auto sideOf = [&](uint32_t a, uint32_t b) {
    if (keys[b] < keys[a]) std::swap(a, b);
    return SharpSide{a, b, lowest(keys[a].corner, keys[b].corner), sharedFace(keys[a], keys[b]), {kNone, kNone}, {}};
  };
  for (uint32_t number = 0; number < patch_.loops().size(); ++number) {
    const SurfaceLoop& loop = patch_.loops()[number];
    if (!isSharp(loop)) continue;
    loops_.push_back({number, {}, {}, {}, false});
    for (uint32_t i = 0; i < loop.count; ++i) {
      const uint32_t a = loop.vertices[i], b = loop.vertices[(i + 1) % loop.count];
      if (creases_.isSharp(a, b)) sides_.push_back(sideOf(a, b));
    }
  }
  std::sort(sides_.begin(), sides_.end(), endsBefore);
  sides_.erase(std::unique(sides_.begin(), sides_.end(),
                           [](const SharpSide& a, const SharpSide& b) { return a.from == b.from && a.to == b.to; }),
               sides_.end());
  for (uint32_t number = 0; number < loops_.size(); ++number) {
    SharpLoop& sharp = loops_[number];
    const SurfaceLoop& loop = of(sharp);
    sharp.sides.fill(kNone);
    for (uint32_t i = 0; i < loop.count; ++i) {
      const SharpSide* side = sideBetween(loop.vertices[i], loop.vertices[(i + 1) % loop.count]);
      if (side == nullptr) continue;
      const auto at = static_cast<size_t>(side - sides_.data());
      sharp.sides[i] = static_cast<uint32_t>(at);
      // The cell on the high side of the face has its corner in the face's plane.
      const bool is_high = patch_.cornerOf(loop.cell)[side->axis] == side->corner[side->axis];
      sides_[at].loops[is_high ? 1 : 0] = number;
    }
  }
}

const SharpSide* Features::sideBetween(uint32_t a, uint32_t b) const {
  const RawVector<VertexKey>& keys = patch_.part().keys;
  SharpSide wanted{};
  wanted.from = keys[b] < keys[a] ? b : a;
  wanted.to = wanted.from == a ? b : a;
  const auto at = std::lower_bound(sides_.begin(), sides_.end(), wanted, endsBefore);
  return at != sides_.end() && at->from == wanted.from && at->to == wanted.to ? &*at : nullptr;
}

/// Of a loop in which several creases meet, the point nearest to its vertices' planes; in units from `corner`.
Vector3 Features::meetingPoint(const SharpLoop& sharp, const Int3& corner, std::span<const Vector3> ideals) const {
  const SurfaceLoop& loop = of(sharp);
  Vector3 middle{};
  double count = 0;
  for (const uint32_t s : sharp.sides) {
    if (s == kNone) continue;
    middle = plus(middle, plus(between(corner, sides_[s].corner), ideals[s]));
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
  const auto own = static_cast<uint32_t>(&side - sides_.data());
  Vector3 sum = times(ideals[own], 2);
  for (const uint32_t number : side.loops) {
    uint32_t next = kNone, others = 0;
    for (size_t i = 0; number != kNone && i < kLongestCubeLoop; ++i) {
      const uint32_t other = loops_[number].sides[i];
      if (other == kNone || other == own) continue;
      next = other;
      ++others;
    }
    // Where nothing follows the side's own place stands for it, so that two sides do not get one mean.
    sum = plus(sum, others == 0   ? ideals[own]
                    : others == 1 ? plus(between(side.corner, sides_[next].corner), ideals[next])
                                  : meetingPoint(loops_[number], side.corner, ideals));
  }
  return times(sum, 0.25);
}

void Features::placeFaceVertices() {
  std::pmr::vector<Vector3> ideals(memory_);
  ideals.reserve(sides_.size());
  for (const SharpSide& side : sides_) {
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
  for (size_t s = 0; s < sides_.size(); ++s) {
    const SharpSide& side = sides_[s];
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
    SharpSide& side = sides_[choices[i].side];
    if (!side.place && creases_.isOnSurface(samples[i])) side.place = choices[i].place;
  }
}

void Features::placeCellVertices() {
  constexpr size_t kChoices = 3;
  std::pmr::vector<std::array<std::optional<Int3>, kChoices>> choices(loops_.size(), memory_);
  std::pmr::vector<Int3> points(memory_);
  const int32_t cell = patch_.grid().cell;
  for (size_t number = 0; number < loops_.size(); ++number) {
    const SurfaceLoop& loop = of(loops_[number]);
    const Int3 corner = patch_.cornerOf(loop.cell);
    Vector3 all{}, features{};
    double feature_count = 0;
    for (uint32_t i = 0; i < loop.count; ++i) {
      all = plus(all, creases_.unitsFrom(corner, loop.vertices[i]));
      const uint32_t s = loops_[number].sides[i];
      if (s == kNone || !sides_[s].place) continue;
      features = plus(features, plus(between(corner, sides_[s].corner), unitsOf(*sides_[s].place, cell)));
      feature_count += 1;
    }
    if (feature_count == 0) continue;
    const Vector3 middle = feature_count > 1 ? times(features, 1 / feature_count)
                                             : times(plus(all, features), 1 / (feature_count + loop.count));
    PlaneSum planes;
    for (uint32_t i = 0; i < loop.count; ++i) {
      const Tangent& t = creases_.tangent(loop.vertices[i]);
      planes.add(t.normal, t.distance + dot(t.normal, minus(between(corner, t.point), middle)));
    }
    const PlaneAxes axes(planes);
    for (size_t choice = 0; choice + 1 < kChoices; ++choice) {
      choices[number][choice] = creases_.onGrid(corner, plus(middle, axes.step(3 - choice)));
    }
    choices[number][kChoices - 1] = creases_.onGrid(corner, middle);
    for (const std::optional<Int3>& place : choices[number]) {
      if (place) points.push_back(creases_.sampledAt(corner, *place));
    }
  }
  std::pmr::vector<FieldSample> samples(points.size(), memory_);
  if (!points.empty()) field_(points, samples, Sampled::all);
  const FanConflicts conflicts(patch_, sides_, loops_, memory_);
  size_t next = 0;
  for (size_t number = 0; number < loops_.size(); ++number) {
    SharpLoop& sharp = loops_[number];
    for (const std::optional<Int3>& place : choices[number]) {
      if (!place) continue;
      const FieldSample& sample = samples[next++];
      if (!creases_.isOnSurface(sample) || !looksOut(sharp, *place)) continue;
      if (place == sharp.centre || place == sharp.spares[0]) continue;
      SharpLoop candidate = sharp;
      candidate.centre = place;
      if (!conflicts.isSound(candidate)) continue;
      (!sharp.centre ? sharp.centre : !sharp.spares[0] ? sharp.spares[0] : sharp.spares[1]) = place;
    }
  }
}

/// Whether all triangles about the place look out of the solid, but for slivers, and together do.
bool Features::looksOut(const SharpLoop& sharp, const Int3& centre) const {
  const SurfaceLoop& loop = of(sharp);
  const Int3 corner = patch_.cornerOf(loop.cell);
  const int32_t cell = patch_.grid().cell;
  const Vector3 place = unitsOf(centre, cell);
  struct Spoke {
    Vector3 at;
    const Tangent* tangent;
  };
  std::array<Spoke, 2 * kLongestCubeLoop> ring;
  size_t count = 0;
  for (uint32_t i = 0; i < loop.count; ++i) {
    ring[count++] = {creases_.unitsFrom(corner, loop.vertices[i]), &creases_.tangent(loop.vertices[i])};
    const uint32_t s = sharp.sides[i];
    if (s == kNone || !sides_[s].place) continue;
    ring[count++] = {plus(between(corner, sides_[s].corner), unitsOf(*sides_[s].place, cell)), nullptr};
  }
  double all = 0;
  for (size_t i = 0; i < count; ++i) {
    const Spoke &a = ring[i], &b = ring[(i + 1) % count];
    const Vector3 area = cross(minus(a.at, place), minus(b.at, place));
    Vector3 out{};
    for (const Tangent* t : {a.tangent, b.tangent})
      if (t != nullptr) out = plus(out, t->normal);
    const double outward = dot(area, out);
    if (outward < -kFold * cell * cell) return false;
    all += outward;
  }
  return all > 0;
}

}  // namespace sgm
