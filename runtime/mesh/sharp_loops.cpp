#include "mesh/sharp_loops.h"

#include <algorithm>

namespace sgm {

SharpSide sideBetween(uint32_t a, uint32_t b, const RawVector<VertexKey>& keys) {
  SharpSide side;
  side.from = keys[b] < keys[a] ? b : a;
  side.to = side.from == a ? b : a;
  for (int k = 0; k < 3; ++k) side.corner[k] = std::min(keys[a].corner[k], keys[b].corner[k]);
  side.axis = sharedFace(keys[a], keys[b]);
  return side;
}

VertexKey faceVertexKey(const SharpSide& side, const VertexKey& from) {
  const int across = 3 - side.axis - from.axis;
  const int of_face = from.axis * 2 + (from.corner[across] == side.corner[across] ? 0 : 1);
  return {side.corner, from.level, static_cast<uint8_t>(kFaceVertex + side.axis), static_cast<uint8_t>(of_face)};
}

bool SharpLoops::hasFaceVertex(const SharpSide& side) const {
  return side.place && (side.at_border || std::all_of(side.loops.begin(), side.loops.end(), [&](uint32_t number) {
                          return number != kNone && loops[number].isFan();
                        }));
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
  std::array<BorderVertex, kLongestCubeLoop> at_border;
  size_t count = 0;
  for (const uint32_t s : sharp.sides) {
    if (s != kNone && sides[s].at_border && sides[s].place)
      at_border[count++] = {faceVertexAt(sides[s]), sides[s].axis};
  }
  if (count == 0) return std::nullopt;
  const SurfaceLoop& loop = of(sharp);
  std::array<Int3, kLongestCubeLoop> vertices;
  for (uint32_t i = 0; i < loop.count; ++i) vertices[i] = placeOf(body.part(), loop.vertices[i]);
  return FanCentre{roundedCentre(loop.cell, {vertices.data(), loop.count}, {at_border.data(), count})};
}

Int3 SharpLoops::faceVertexAt(const SharpSide& side) const {
  const ChunkGrid& grid = body.grid();
  Int3 at = *side.place;
  for (int k = 0; k < 3; ++k) {
    at[k] += static_cast<int32_t>((int64_t{side.corner[k]} - grid.origin[k]) / grid.cell) * kSubcell;
  }
  return at;
}

namespace {

/// has(side): whether a side that can have a face vertex has it.
template <class Has>
LoopTriangles fanTriangles(const SharpLoops& sharp, const SharpLoop& own, const FanCentre& centre, const Has& has) {
  LoopTriangles triangles;
  const MeshPart& part = sharp.body.part();
  const SurfaceLoop& loop = sharp.of(own);
  const uint32_t name = centre.side == SharpSide::kNone ? kCellVertices + own.loop : kFaceVertices + centre.side;
  for (uint32_t i = 0; i < loop.count; ++i) {
    const uint32_t a = loop.vertices[i], b = loop.vertices[(i + 1) % loop.count], s = own.sides[i];
    if (s != SharpSide::kNone && s == centre.side) continue;
    if (s != SharpSide::kNone && sharp.sides[s].place && has(sharp.sides[s])) {
      const Int3 middle = sharp.faceVertexAt(sharp.sides[s]);
      triangles.add({centre.at, placeOf(part, a), middle}, {name, a, kFaceVertices + s});
      triangles.add({centre.at, middle, placeOf(part, b)}, {name, kFaceVertices + s, b});
    } else {
      triangles.add({centre.at, placeOf(part, a), placeOf(part, b)}, {name, a, b});
    }
  }
  return triangles;
}

}  // namespace

LoopTriangles SharpLoops::trianglesOf(const SharpLoop& loop) const {
  const std::optional<FanCentre> centre = centreOf(loop);
  if (!centre) return plainTriangles(body.part(), of(loop));
  return fanTriangles(*this, loop, *centre, [this](const SharpSide& side) { return hasFaceVertex(side); });
}

LoopTriangles SharpLoops::fullFan(const SharpLoop& loop, const FanCentre& centre) const {
  return fanTriangles(*this, loop, centre, [](const SharpSide&) { return true; });
}

}  // namespace sgm
