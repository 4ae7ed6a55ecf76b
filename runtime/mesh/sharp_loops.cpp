#include "mesh/sharp_loops.h"

#include <algorithm>

#include "mesh/fan_triangles.h"

namespace sgm {

SharpSide sideBetween(uint32_t a, uint32_t b, const RawVector<VertexKey>& keys) {
  SharpSide side;
  side.from = keys[b] < keys[a] ? b : a;
  side.to = side.from == a ? b : a;
  for (int k = 0; k < 3; ++k) side.corner[k] = std::min(keys[a].corner[k], keys[b].corner[k]);
  side.axis = sharedFace(keys[a], keys[b]);
  return side;
}

bool isAtBorder(const ChunkGrid& grid, const SharpSide& side) {
  const int64_t from_chunk = int64_t{side.corner[side.axis]} - grid.origin[side.axis];
  return from_chunk == 0 || from_chunk == int64_t{kChunkCells} * grid.cell;
}

Int3 fromChunk(const ChunkGrid& grid, const SharpSide& side, const Int3& place) {
  Int3 at = place;
  for (int k = 0; k < 3; ++k) {
    at[k] += static_cast<int32_t>((int64_t{side.corner[k]} - grid.origin[k]) / grid.cell) * kSubcell;
  }
  return at;
}

VertexKey faceVertexKey(const SharpSide& side, const VertexKey& from, size_t which) {
  const int across = 3 - side.axis - from.axis;
  const int of_face = from.axis * 2 + (from.corner[across] == side.corner[across] ? 0 : 1);
  return {side.corner, from.level, static_cast<uint8_t>(kFaceVertex + side.axis),
          static_cast<uint8_t>(of_face + (which == 0 ? 0 : kSecondOfSide))};
}

bool SharpLoops::hasFaceVertices(const SharpSide& side) const {
  return !side.places.empty() &&
         (side.at_border || std::all_of(side.loops.begin(), side.loops.end(),
                                        [&](uint32_t number) { return number != kNone && loops[number].isFan(); }));
}

Int3 roundedCentre(const Int3& cell, std::span<const Int3> vertices, std::span<const BorderVertex> at_border) {
  Int3 sum;
  for (const Int3& p : vertices)
    for (int k = 0; k < 3; ++k) sum[k] += p[k] - cell[k] * kSubcell;
  for (const BorderVertex& p : at_border)
    for (int k = 0; k < 3; ++k) sum[k] += p.at[k] - cell[k] * kSubcell;
  const auto count = static_cast<int32_t>(vertices.size() + at_border.size());
  Int3 mean;
  for (int k = 0; k < 3; ++k) mean[k] = std::clamp(sum[k] / count, 1, kSubcell - 1);
  for (const BorderVertex& p : at_border) {
    const auto isOutside = [&](int k) { return p.at[k] < cell[k] * kSubcell || p.at[k] > (cell[k] + 1) * kSubcell; };
    if (!isOutside(0) && !isOutside(1) && !isOutside(2)) continue;
    mean[p.axis] = p.at[p.axis] == cell[p.axis] * kSubcell ? 1 : kSubcell - 1;
  }
  for (int k = 0; k < 3; ++k) mean[k] += cell[k] * kSubcell;
  return mean;
}

std::optional<FanCentre> SharpLoops::centreOf(const SharpLoop& sharp) const {
  if (sharp.isFan()) return sharp.centre;
  std::array<BorderVertex, FacePlaces::kMost * kLongestBodyLoop> at_border;
  size_t count = 0;
  for (const uint32_t s : sharp.sides) {
    if (s == kNone || !sides[s].at_border) continue;
    for (const Int3& place : sides[s].places.all()) at_border[count++] = {fromChunk(sides[s], place), sides[s].axis};
  }
  if (count == 0) return std::nullopt;
  const SurfaceLoop& loop = of(sharp);
  std::array<Int3, kLongestBodyLoop> vertices;
  for (uint32_t i = 0; i < loop.count; ++i) vertices[i] = placeOf(body.part(), loop.vertices[i]);
  return FanCentre{roundedCentre(loop.cell, {vertices.data(), loop.count}, {at_border.data(), count})};
}

namespace {

/// True if a loop may use the diagonal between the points a and b of its ring, because no loop of an adjacent cell can
/// use the same diagonal. Such a loop is possible only in the cell behind a face that contains both points.
bool isFree(const SharpLoops& sharp, const SurfaceLoop& loop, uint32_t a, uint32_t b) {
  if (a >= kCellVertices || b >= kCellVertices) return true;
  const RawVector<VertexKey>& keys = sharp.body.part().keys;
  const auto sideOf = [&](uint32_t name) {
    return name < kFaceVertices ? nullptr : &sharp.sides[SharpLoops::sideOf(name - kFaceVertices)];
  };
  const SharpSide *const of_a = sideOf(a), *const of_b = sideOf(b);
  // A face vertex lies in the same face as the two ends of its loop side, so the test uses these ends instead of the
  // face vertex.
  const std::array<uint32_t, 4> ends{of_a ? of_a->from : a, of_a ? of_a->to : a, of_b ? of_b->from : b,
                                     of_b ? of_b->to : b};
  const int axis = of_a ? of_a->axis : of_b ? of_b->axis : sharedFace(keys[a], keys[b]);
  if (axis < 0) return true;
  const int32_t plane = (of_a ? of_a->corner : of_b ? of_b->corner : keys[a].corner)[axis];
  for (const uint32_t v : ends)
    if (keys[v].axis == axis || keys[v].corner[axis] != plane) return true;
  Int3 beside = loop.cell;
  beside[axis] += plane == sharp.body.cornerOf(loop.cell)[axis] ? -1 : 1;
  // If the cell lies outside of the chunk, its loops are unknown, and one of them might use the diagonal.
  if (beside[axis] < 0 || beside[axis] >= kChunkCells) return false;
  bool is_free = true;
  sharp.body.visitWithin(beside, beside, [&](uint32_t number) {
    const SurfaceLoop& other = sharp.body.all()[number];
    const auto end = other.vertices.begin() + other.count;
    const auto has = [&](uint32_t v) { return std::find(other.vertices.begin(), end, v) != end; };
    if (std::all_of(ends.begin(), ends.end(), has)) is_free = false;
  });
  return is_free;
}

/// The ring of a loop: its vertices and face vertices, in order. The array has space for two copies of the ring, so
/// that a walk around it can start at any point.
struct Ring {
  std::array<FanPoint, 2 * LoopTriangles::kMost> points;
  size_t count = 0;
};

/// Builds the ring of a loop. has(side): returns whether the face vertices of a side belong to the ring; it is called
/// only for sides that have positions for face vertices.
template <class Has>
Ring ringOf(const SharpLoops& sharp, const SharpLoop& own, const Has& has) {
  Ring ring;
  const SurfaceLoop& loop = sharp.of(own);
  for (uint32_t i = 0; i < loop.count; ++i) {
    const uint32_t v = loop.vertices[i], s = own.sides[i];
    ring.points[ring.count++] = {placeOf(sharp.body.part(), v), v};
    if (s == SharpSide::kNone || sharp.sides[s].places.empty() || !has(sharp.sides[s])) continue;
    const SharpSide& side = sharp.sides[s];
    for (size_t k = 0; k < side.places.count(); ++k) {
      const size_t which = v == side.from ? k : side.places.count() - 1 - k;
      const uint32_t name = kFaceVertices + SharpLoops::faceVertexOf(s, which);
      ring.points[ring.count++] = {sharp.fromChunk(side, side.places.all()[which]), name, true};
    }
  }
  return ring;
}

template <class Has>
LoopTriangles fanTriangles(const SharpLoops& sharp, const SharpLoop& own, const FanCentre& centre, bool by_patches,
                           const Has& has) {
  const SurfaceLoop& loop = sharp.of(own);
  const bool is_closed = centre.kind != FanCentre::Kind::face_vertex;
  const FanPoint middle{centre.at, is_closed ? kCellVertices + own.loop : kFaceVertices + centre.face_vertex, true};
  Ring ring = ringOf(sharp, own, has);
  const IsFree is_free = [&](uint32_t a, uint32_t b) { return isFree(sharp, loop, a, b); };
  if (centre.isStrip()) {
    return stripTriangles({ring.points.data(), ring.count}, centre.kind == FanCentre::Kind::strip_from_second, is_free);
  }
  size_t start = 0;
  if (!is_closed) {
    // The fan's centre is itself a point of the ring. The fan therefore goes around the other points only, and starts
    // at the point after the centre.
    while (ring.points[start++].name != middle.name) continue;
    std::copy_n(ring.points.begin(), start, ring.points.begin() + static_cast<std::ptrdiff_t>(ring.count));
  }
  const std::span<const FanPoint> points(ring.points.data() + start, ring.count - (is_closed ? 0 : 1));
  if (!by_patches) return coneTriangles(middle, points, is_closed);
  return patchTriangles(middle, points, is_closed, is_free);
}

}  // namespace

LoopTriangles SharpLoops::trianglesOf(const SharpLoop& loop) const {
  const std::optional<FanCentre> centre = centreOf(loop);
  if (!centre) return plainTriangles(body.part(), of(loop));
  return fanTriangles(*this, loop, *centre, loop.isFan() && loop.by_patches,
                      [this](const SharpSide& side) { return hasFaceVertices(side); });
}

LoopTriangles SharpLoops::fullFan(const SharpLoop& loop, const FanCentre& centre, bool by_patches) const {
  return fanTriangles(*this, loop, centre, by_patches, [](const SharpSide&) { return true; });
}

}  // namespace sgm
