#include "derive/lattice.h"

#include <algorithm>
#include <array>

#include "base/math.h"
#include "derive/draws.h"

namespace sgm {
namespace {

uint64_t coordinate(int32_t v) { return static_cast<uint32_t>(v); }

PathKey cellHash(uint64_t seed, uint64_t salt, Int3 c) {
  return {hashCombine(hashCombine(hashCombine(hashCombine(seed, salt), coordinate(c.x)), coordinate(c.y)),
                      coordinate(c.z))};
}

/// Returns a random coordinate in 0..size - 1, units. unit: a draw in 0..1; jitter 0: the middle of the range; 1:
/// anywhere.
int32_t jittered(int32_t size, double jitter, double unit) {
  const double at = detFloor(size * (0.5 + jitter * (unit - 0.5)));
  return static_cast<int32_t>(std::clamp(at, 0.0, static_cast<double>(size) - 1.0));
}

int32_t shifted(int32_t v, int levels) { return v >> levels; }

/// True if the node's spanning tree contains the edge (axis, corner) between two of its eight children. The tree is the
/// minimum spanning tree over hashed weights (Kruskal). corner: its bits 0, 1, 2 are the position in x, y, z of the
/// edge's lower child within the node; the bit of `axis` is 0.
bool inSpanningTree(const Lattice& lattice, PathKey node, int axis, int corner) {
  struct Edge {
    uint64_t weight;
    int axis, corner;
  };
  std::array<Edge, 12> edges{};
  size_t count = 0;
  int active = 0;
  for (int a = 0; a < 3; ++a) active |= lattice.hasAxis(a) ? 1 << a : 0;
  for (int a = 0; a < 3; ++a) {
    if (!lattice.hasAxis(a)) continue;
    for (int c = 0; c < 8; ++c) {
      if ((c & (1 << a)) != 0 || (c & ~active) != 0) continue;
      edges[count++] = {hashCombine(node.value, kEdgeDraw + static_cast<uint64_t>(a * 8 + c)), a, c};
    }
  }
  std::sort(edges.begin(), edges.begin() + static_cast<std::ptrdiff_t>(count), [](const Edge& l, const Edge& r) {
    return l.weight != r.weight ? l.weight < r.weight : l.axis * 8 + l.corner < r.axis * 8 + r.corner;
  });
  std::array<int, 8> set{0, 1, 2, 3, 4, 5, 6, 7};
  for (size_t i = 0; i < count; ++i) {
    const Edge& e = edges[i];
    const int a = set[static_cast<size_t>(e.corner)], b = set[static_cast<size_t>(e.corner | (1 << e.axis))];
    if (a == b) continue;
    if (e.axis == axis && e.corner == corner) return true;
    std::replace(set.begin(), set.end(), b, a);
  }
  return false;
}

/// True if the hash of `key` and `draw` selects this face from the candidates. These are the faces in one plane of an
/// octree node: 2^levels faces along each axis of the plane on which the layer is divided into cells.
bool isChosen(const Lattice& lattice, PathKey key, uint64_t draw, FaceId face, int levels) {
  const uint64_t bits = hashCombine(key.value, draw);
  const uint64_t mask = (uint64_t{1} << levels) - 1;
  int taken = 0;
  for (int a = 0; a < 3; ++a) {
    if (a == face.axis || !lattice.hasAxis(a)) continue;
    if ((coordinate(face.lower[a]) & mask) != ((bits >> taken) & mask)) return false;
    taken += 32;
  }
  return true;
}

}  // namespace

PathKey Lattice::cellKey(Int3 cell) const { return cellHash(seed, kCellSalt, cell); }

PathKey Lattice::faceKey(FaceId face) const {
  return {hashCombine(cellHash(seed, kFaceSalt, face.lower).value, static_cast<uint64_t>(face.axis))};
}

Int3 Lattice::lowFrom(Int3 home, Int3 cell) const {
  const auto along = [&](int a) { return saturate((int64_t{cell[a]} - home[a]) * size[a]); };
  return {along(0), along(1), along(2)};
}

Int3 Lattice::point(Int3 home, Int3 cell, double jitter) const {
  Int3 result = lowFrom(home, cell);
  const PathKey key = cellKey(cell);
  for (int a = 0; a < 3; ++a) {
    if (!hasAxis(a)) continue;
    const double unit = key.unit(kJitterDraw + static_cast<uint64_t>(a));
    result[a] = saturate(int64_t{result[a]} + jittered(size[a], jitter, unit));
  }
  return result;
}

Int3 Lattice::facePoint(Int3 home, FaceId face, double jitter) const {
  Int3 result = lowFrom(home, face.upper());
  const PathKey key = faceKey(face);
  for (int a = 0; a < 3; ++a) {
    if (!hasAxis(a) || a == face.axis) continue;
    const double unit = key.unit(kJitterDraw + static_cast<uint64_t>(a));
    result[a] = saturate(int64_t{result[a]} + jittered(size[a], jitter, unit));
  }
  return result;
}

std::vector<FaceId> Lattice::ownedFaces(Int3 cell) const {
  std::vector<FaceId> faces;
  for (int a = 0; a < 3; ++a) {
    if (hasAxis(a)) faces.push_back({cell, a});
  }
  return faces;
}

bool Lattice::linked(FaceId face, int tree, double extra) const {
  // The lower and the upper cell's coordinates differ in the bits from bit 0 up to the lowest 0 bit of the lower
  // coordinate, so their lowest common octree node is one level above that bit.
  int level = 1;
  while (level <= tree && ((coordinate(face.lower[face.axis]) >> (level - 1)) & 1) != 0) ++level;
  bool compulsory = false;
  if (level <= tree) {
    Int3 node = face.lower;
    int corner = 0;
    for (int a = 0; a < 3; ++a) {
      corner |= (static_cast<int>(coordinate(face.lower[a]) >> (level - 1)) & 1) << a;
      node[a] = hasAxis(a) ? shifted(node[a], level) : 0;
      if (!hasAxis(a)) corner &= ~(1 << a);
    }
    const PathKey key = cellHash(hashCombine(seed, static_cast<uint64_t>(level)), kTreeSalt, node);
    const uint64_t draw = kChoiceDraw + static_cast<uint64_t>(face.axis * 8 + corner);
    compulsory = isChosen(*this, key, draw, face, level - 1) && inSpanningTree(*this, key, face.axis, corner);
  } else {
    Int3 block = face.lower;
    for (int a = 0; a < 3; ++a) block[a] = hasAxis(a) ? shifted(block[a], tree) : 0;
    const PathKey key = cellHash(hashCombine(seed, static_cast<uint64_t>(tree)), kBlockSalt, block);
    compulsory = isChosen(*this, key, kChoiceDraw + static_cast<uint64_t>(face.axis), face, tree);
  }
  return compulsory || faceKey(face).unit(kOpenDraw) < extra;
}

std::vector<FaceId> Lattice::links(Int3 cell, int tree, double extra) const {
  std::vector<FaceId> faces = ownedFaces(cell);
  std::erase_if(faces, [&](const FaceId& face) { return !linked(face, tree, extra); });
  return faces;
}

double Lattice::noise(Int3 cell, int32_t period, uint64_t noise_seed) const {
  std::array<int64_t, 3> corner{};
  std::array<double, 3> weight{};
  for (int a = 0; a < 3; ++a) {
    const size_t i = static_cast<size_t>(a);
    const int64_t centre = int64_t{cell[a]} * size[a] + size[a] / 2;
    corner[i] = centre >= 0 ? centre / period : -((-centre + period - 1) / period);
    const double t = static_cast<double>(centre - corner[i] * period) / period;
    weight[i] = t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
  }
  double sum = 0;
  for (int c = 0; c < 8; ++c) {
    double share = 1;
    std::array<int32_t, 3> at{};
    for (size_t i = 0; i < 3; ++i) {
      const bool high = ((c >> i) & 1) != 0;
      share *= high ? weight[i] : 1.0 - weight[i];
      at[i] = static_cast<int32_t>(corner[i] + (high ? 1 : 0));
    }
    sum += share * cellHash(hashCombine(seed, noise_seed), kNoiseSalt, {at[0], at[1], at[2]}).unit(0);
  }
  return sum;
}

}  // namespace sgm
