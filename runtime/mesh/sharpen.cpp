#include "mesh/sharpen.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "mesh/least_squares.h"
#include "mesh/tables.h"
#include "mesh/vertex.h"

namespace sgm {
namespace {

constexpr double kSharpCosine = 0.9;      // normals that differ by more than 26 degrees may belong to a feature
constexpr double kOffSurface = 1.0 / 25;  // of a cell
constexpr double kSlide = 1.0 / 128;      // of a cell
constexpr uint32_t kNoVertex = UINT32_MAX;

/// A side of a loop, in the direction in which both cells at its face see it: from the lower key to the higher.
struct Side {
  uint32_t from, to;
  Int3 corner{};  ///< of the face
  int axis = 0;   ///< that the face stands on
  uint32_t vertex = kNoVertex;
  friend bool operator<(const Side& a, const Side& b) { return std::tie(a.from, a.to) < std::tie(b.from, b.to); }
};

/// Triangles of one loop, and its vertices in order.
struct Loop {
  size_t first_index = 0, end_index = 0;
  Int3 corner;  ///< of the cell
  std::array<uint32_t, kLongestCubeLoop> vertices{};
  size_t count = 0;
};

/// The plane that touches the surface near a vertex: normal . (x - point) = distance.
struct Tangent {
  Int3 point;
  Vector3 normal{};  ///< of length one; 0 where the field has no gradient
  double distance = 0;
};

Int3 lowest(const Int3& a, const Int3& b) { return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)}; }

Vector3 between(const Int3& from, const Int3& to) {
  return {static_cast<double>(int64_t{to.x} - from.x), static_cast<double>(int64_t{to.y} - from.y),
          static_cast<double>(int64_t{to.z} - from.z)};
}

/// The axis of the face that two edges of a cell share; -1 where they share none.
int sharedFace(const VertexKey& a, const VertexKey& b) {
  if (a.axis != b.axis) {
    const int axis = 3 - a.axis - b.axis;
    return a.corner[axis] == b.corner[axis] ? axis : -1;
  }
  const int first = (a.axis + 1) % 3, second = (a.axis + 2) % 3;
  if (a.corner[first] == b.corner[first]) return first;
  return a.corner[second] == b.corner[second] ? second : -1;
}

/// The cell whose edges these are: no three that make a triangle lie in one face.
Int3 cellOf(const VertexKey& a, const VertexKey& b, const VertexKey& c, int32_t cell) {
  Int3 corner;
  for (int axis = 0; axis < 3; ++axis) {
    int32_t lo = INT32_MIN;
    for (const VertexKey* key : {&a, &b, &c}) {
      lo = std::max(lo, key->corner[axis] - (key->axis == axis ? 0 : cell));
    }
    corner[axis] = lo;
  }
  return corner;
}

class Sharpener {
 public:
  Sharpener(const WorldMesh& mesh, int32_t cell, std::pmr::memory_resource* memory)
      : mesh_(mesh),
        cell_(cell),
        memory_(memory),
        loops_(memory),
        sides_(memory),
        tangents_(memory),
        normals_(memory),
        made_(memory) {}

  Result<WorldMesh> run(const FieldSampler& field) {
    copyVertices();
    if (Result<void> ok = touch(field); !ok) return ok.error();
    if (Result<void> ok = slide(field); !ok) return ok.error();
    for (const VertexAttributes& a : made_.attributes) normals_.push_back(unpackNormal(a.normal_x, a.normal_y));
    findLoops();
    if (Result<void> ok = placeFaceVertices(field); !ok) return ok.error();
    if (Result<void> ok = placeCellVertices(field); !ok) return ok.error();
    return std::move(made_);
  }

 private:
  bool sharp(uint32_t a, uint32_t b) const { return dot(normals_[a], normals_[b]) < kSharpCosine; }
  bool isSide(uint32_t a, uint32_t b) const { return sharedFace(mesh_.keys[a], mesh_.keys[b]) >= 0; }
  Int3 cellOfTriangle(size_t first_index) const {
    const uint32_t* v = &mesh_.indices[first_index];
    return cellOf(mesh_.keys[v[0]], mesh_.keys[v[1]], mesh_.keys[v[2]], cell_);
  }

  /// The loops that have a sharp side, and these sides.
  void findLoops() {
    const size_t count = mesh_.indices.size();
    for (size_t at = 0; at < count;) {
      Loop loop;
      loop.first_index = at;
      loop.corner = cellOfTriangle(at);
      std::array<std::array<uint32_t, 2>, kLongestCubeLoop> steps{};
      size_t sides = 0;
      const auto take = [&] {
        for (size_t k = 0; k < 3; ++k) {
          const uint32_t a = mesh_.indices[at + k], b = mesh_.indices[at + (k + 1) % 3];
          if (isSide(a, b)) steps[sides++] = {a, b};
        }
        at += 3;
      };
      const auto joins = [&](uint32_t v) {
        return std::find(&mesh_.indices[loop.first_index], mesh_.indices.data() + at, v) != mesh_.indices.data() + at;
      };
      take();
      // A loop's triangles stand together, and loops of a cell have no vertex in common.
      while (at < count && cellOfTriangle(at) == loop.corner &&
             (joins(mesh_.indices[at]) || joins(mesh_.indices[at + 1]) || joins(mesh_.indices[at + 2]))) {
        take();
      }
      loop.end_index = at;
      bool any = false;
      for (size_t i = 0; i < sides; ++i) any = any || sharp(steps[i][0], steps[i][1]);
      if (!any) continue;
      uint32_t next = mesh_.indices[loop.first_index];
      for (size_t i = 0; i < sides; ++i) {
        loop.vertices[loop.count++] = next;
        const auto step = std::find_if(steps.begin(), steps.end(), [&](const auto& s) { return s[0] == next; });
        next = (*step)[1];
      }
      for (size_t i = 0; i < sides; ++i) {
        if (sharp(steps[i][0], steps[i][1])) sides_.push_back(sideOf(steps[i][0], steps[i][1]));
      }
      loops_.push_back(loop);
    }
    std::sort(sides_.begin(), sides_.end());
    sides_.erase(std::unique(sides_.begin(), sides_.end(),
                             [](const Side& a, const Side& b) { return a.from == b.from && a.to == b.to; }),
                 sides_.end());
  }

  Side sideOf(uint32_t a, uint32_t b) const {
    if (mesh_.keys[b] < mesh_.keys[a]) std::swap(a, b);
    return {a, b, lowest(mesh_.keys[a].corner, mesh_.keys[b].corner), sharedFace(mesh_.keys[a], mesh_.keys[b])};
  }

  void copyVertices() {
    made_.origin = mesh_.origin;
    made_.positions = mesh_.positions;
    made_.attributes = mesh_.attributes;
    made_.keys = mesh_.keys;
  }

  /// A vertex at a place in units from a corner, on the grid of all positions.
  uint32_t addVertex(const Int3& corner, const Vector3& place, const VertexKey& key, const VertexAttributes& like) {
    const Vector3 start = between(made_.origin, corner);
    std::array<double, 3> metres;
    for (size_t k = 0; k < 3; ++k) metres[k] = (start[k] + place[k]) / kUnitsPerMetre;
    made_.positions.push_back(metres);
    made_.attributes.push_back(like);
    made_.keys.push_back(key);
    return static_cast<uint32_t>(made_.positions.size() - 1);
  }

  static Vector3 rounded(const Vector3& place) {
    Vector3 result;
    for (size_t k = 0; k < 3; ++k) result[k] = std::floor(place[k] * kSubcell + 0.5) / kSubcell;
    return result;
  }

  static Int3 nearest(const Int3& corner, const Vector3& place) {
    Int3 point;
    for (int k = 0; k < 3; ++k) {
      point[k] = saturate(corner[k] + static_cast<int64_t>(std::floor(place[static_cast<size_t>(k)] + 0.5)));
    }
    return point;
  }

  bool onSurface(const FieldSample& s) const {
    const Vector3 g{s.gradient[0], s.gradient[1], s.gradient[2]};
    const double steepness = std::sqrt(dot(g, g));
    // The field is sampled at whole units.
    return std::fabs(double{s.value}) <= (kOffSurface * cell_ + 1) * steepness;
  }

  bool within(const Vector3& place) const {
    return std::all_of(place.begin(), place.end(), [&](double x) { return x >= -cell_ && x <= 2.0 * cell_; });
  }

  /// The unit vector of a gradient; 0 where it has no length.
  static Vector3 direction(const FieldSample& s) {
    Vector3 n{s.gradient[0], s.gradient[1], s.gradient[2]};
    const double steepness = std::sqrt(dot(n, n));
    for (double& x : n) x = steepness > 0 ? x / steepness : 0;
    return n;
  }

  static Tangent tangentAt(const Int3& point, const FieldSample& s) {
    const Vector3 n = direction(s);
    const double steepness = dot(n, {s.gradient[0], s.gradient[1], s.gradient[2]});
    return {point, n, steepness > 0 ? -double{s.value} / steepness : 0};
  }

  /// The point of a grid edge at `step` 256ths of it.
  Int3 pointOnEdge(uint32_t v, uint32_t step) const {
    Int3 point = made_.keys[v].corner;
    point[made_.keys[v].axis] += localUnits(step, cell_);
    return point;
  }

  /// Samples the field at one place on each of these vertices' edges.
  Result<std::pmr::vector<FieldSample>> sampleEdges(const FieldSampler& field, std::span<const uint32_t> vertices,
                                                    std::span<const uint32_t> steps) const {
    std::pmr::vector<Int3> points(memory_);
    for (size_t i = 0; i < vertices.size(); ++i) points.push_back(pointOnEdge(vertices[i], steps[i]));
    std::pmr::vector<FieldSample> samples(points.size(), memory_);
    if (Result<void> ok = field(points, samples); !ok) return ok.error();
    return samples;
  }

  /// The tangents of all vertices.
  Result<void> touch(const FieldSampler& field) {
    std::pmr::vector<Int3> points(memory_);
    for (const std::array<double, 3>& metres : made_.positions) {
      points.push_back(
          nearest(made_.origin, {metres[0] * kUnitsPerMetre, metres[1] * kUnitsPerMetre, metres[2] * kUnitsPerMetre}));
    }
    std::pmr::vector<FieldSample> samples(points.size(), memory_);
    if (Result<void> ok = field(points, samples); !ok) return ok;
    for (size_t i = 0; i < points.size(); ++i) tangents_.push_back(tangentAt(points[i], samples[i]));
    return {};
  }

  /// Moves vertices that lie off the surface, on grid edges that pass through a crease, by bisection.
  Result<void> slide(const FieldSampler& field) {
    std::pmr::vector<uint32_t> off(memory_);
    for (uint32_t v = 0; v < tangents_.size(); ++v) {
      if (std::fabs(tangents_[v].distance) > kSlide * cell_) off.push_back(v);
    }
    std::pmr::vector<uint32_t> lo(off.size(), 0, memory_), hi(off.size(), kSubcell, memory_), step(memory_);
    const auto first = sampleEdges(field, off, lo);
    if (!first) return first.error();
    const auto last = sampleEdges(field, off, hi);
    if (!last) return last.error();
    std::pmr::vector<uint32_t> moving(memory_);
    std::pmr::vector<bool> solid(memory_);
    for (size_t i = 0; i < off.size(); ++i) {
      const bool from_solid = (*first)[i].value < 0;
      if (from_solid == ((*last)[i].value < 0)) continue;
      if (!(dot(direction((*first)[i]), direction((*last)[i])) < kSharpCosine)) continue;
      moving.push_back(off[i]);
      solid.push_back(from_solid);
    }
    lo.assign(moving.size(), 0);
    hi.assign(moving.size(), kSubcell);
    step.resize(moving.size());
    for (int width = kSubcell; width > 1; width /= 2) {
      for (size_t i = 0; i < moving.size(); ++i) step[i] = (lo[i] + hi[i]) / 2;
      const auto middle = sampleEdges(field, moving, step);
      if (!middle) return middle.error();
      for (size_t i = 0; i < moving.size(); ++i) {
        (((*middle)[i].value < 0) == solid[i] ? lo[i] : hi[i]) = step[i];
      }
    }
    for (uint32_t& at : lo) at = std::max(at, 1u);
    const auto settled = sampleEdges(field, moving, lo);
    if (!settled) return settled.error();
    for (size_t i = 0; i < moving.size(); ++i) {
      const uint32_t v = moving[i];
      const VertexKey& key = made_.keys[v];
      const auto axis = static_cast<size_t>(key.axis);
      made_.positions[v][axis] =
          (between(made_.origin, key.corner)[axis] + static_cast<double>(lo[i]) * cell_ / kSubcell) / kUnitsPerMetre;
      made_.attributes[v].normal_x = (*settled)[i].normal_x;
      made_.attributes[v].normal_y = (*settled)[i].normal_y;
      tangents_[v] = tangentAt(pointOnEdge(v, lo[i]), (*settled)[i]);
    }
    return {};
  }

  const Tangent& tangent(uint32_t v) const { return tangents_[v]; }

  /// The place on the crease of a side's two tangents that is nearest to the side's middle, in units from the face's
  /// corner. Not where they meet in the face: that may be far away, and out of order with the next one, where the
  /// crease runs nearly along the face.
  Vector3 nearestOnCrease(const Side& side) const {
    const Tangent &a = tangent(side.from), &b = tangent(side.to);
    const Vector3 pa = between(side.corner, a.point), pb = between(side.corner, b.point);
    const Vector3 middle{(pa[0] + pb[0]) / 2, (pa[1] + pb[1]) / 2, (pa[2] + pb[2]) / 2};
    PlaneSum planes;
    planes.add(a.normal, a.distance + dot(a.normal, minus(pa, middle)));
    planes.add(b.normal, b.distance + dot(b.normal, minus(pb, middle)));
    const Vector3 step = stepToPlanes(planes, 2);
    return rounded({middle[0] + step[0], middle[1] + step[1], middle[2] + step[2]});
  }

  Result<void> placeFaceVertices(const FieldSampler& field) {
    std::pmr::vector<Side*> found(memory_);
    std::pmr::vector<Vector3> places(memory_);
    std::pmr::vector<Int3> points(memory_);
    for (Side& side : sides_) {
      const Vector3 place = nearestOnCrease(side);
      if (!within(place)) continue;
      found.push_back(&side);
      places.push_back(place);
      points.push_back(nearest(side.corner, place));
    }
    std::pmr::vector<FieldSample> samples(points.size(), memory_);
    if (Result<void> ok = field(points, samples); !ok) return ok;
    for (size_t i = 0; i < found.size(); ++i) {
      if (!onSurface(samples[i])) continue;
      Side& side = *found[i];
      const VertexKey& from = mesh_.keys[side.from];
      const int across = 3 - side.axis - from.axis;
      const uint8_t of_face =
          static_cast<uint8_t>(from.axis * 2 + (from.corner[across] == side.corner[across] ? 0 : 1));
      const VertexKey key{side.corner, from.level, static_cast<uint8_t>(kFaceVertex + side.axis), of_face};
      side.vertex = addVertex(side.corner, places[i], key, mesh_.attributes[side.from]);
    }
    return {};
  }

  uint32_t faceVertex(uint32_t a, uint32_t b) const {
    if (!sharp(a, b)) return kNoVertex;
    const Side wanted = sideOf(a, b);
    return std::lower_bound(sides_.begin(), sides_.end(), wanted)->vertex;
  }

  /// A loop with its face vertices, around the cell vertex to come.
  struct Fan {
    const Loop* loop;
    std::array<uint32_t, 2 * kLongestCubeLoop> ring{};
    std::array<Vector3, 2 * kLongestCubeLoop> places{};  ///< units from the cell's corner
    size_t count = 0;
    std::array<Vector3, 3> choices{};  ///< of the cell vertex, best first; the last one always serves
  };

  bool isFeature(uint32_t v) const { return v >= mesh_.positions.size(); }

  Fan fanOf(const Loop& loop) const {
    Fan fan{&loop};
    for (size_t i = 0; i < loop.count; ++i) {
      const uint32_t a = loop.vertices[i], b = loop.vertices[(i + 1) % loop.count];
      fan.ring[fan.count++] = a;
      if (const uint32_t middle = faceVertex(a, b); middle != kNoVertex) fan.ring[fan.count++] = middle;
    }
    if (fan.count == loop.count) return fan;
    const Vector3 start = between(made_.origin, loop.corner);
    Vector3 all{}, features{};
    for (size_t i = 0; i < fan.count; ++i) {
      for (size_t k = 0; k < 3; ++k) {
        fan.places[i][k] = made_.positions[fan.ring[i]][k] * kUnitsPerMetre - start[k];
        all[k] += fan.places[i][k];
        if (isFeature(fan.ring[i])) features[k] += fan.places[i][k];
      }
    }
    const size_t feature_count = fan.count - loop.count;
    Vector3 middle;
    for (size_t k = 0; k < 3; ++k) {
      middle[k] = feature_count > 1 ? features[k] / static_cast<double>(feature_count)
                                    : all[k] / static_cast<double>(fan.count);
    }
    PlaneSum planes;
    for (size_t i = 0; i < loop.count; ++i) {
      const Tangent& t = tangent(loop.vertices[i]);
      planes.add(t.normal, t.distance + dot(t.normal, minus(between(loop.corner, t.point), middle)));
    }
    for (size_t choice = 0; choice < 2; ++choice) {
      const Vector3 step = stepToPlanes(planes, 3 - choice);
      fan.choices[choice] = rounded({middle[0] + step[0], middle[1] + step[1], middle[2] + step[2]});
    }
    fan.choices[2] = rounded(middle);
    return fan;
  }

  /// Whether all triangles about the place look out of the solid.
  bool looksOut(const Fan& fan, const Vector3& place) const {
    for (size_t i = 0; i < fan.count; ++i) {
      const size_t j = (i + 1) % fan.count;
      const Vector3 area = cross(minus(fan.places[i], place), minus(fan.places[j], place));
      Vector3 out{};
      for (const uint32_t v : {fan.ring[i], fan.ring[j]}) {
        if (isFeature(v)) continue;
        for (size_t k = 0; k < 3; ++k) out[k] += tangent(v).normal[k];
      }
      if (dot(area, out) < 0) return false;
    }
    return true;
  }

  Result<void> placeCellVertices(const FieldSampler& field) {
    std::pmr::vector<Fan> fans(memory_);
    std::pmr::vector<Int3> points(memory_);
    for (const Loop& loop : loops_) {
      const Fan fan = fanOf(loop);
      if (fan.count == loop.count) continue;
      fans.push_back(fan);
      for (size_t choice = 0; choice < 2; ++choice) points.push_back(nearest(loop.corner, fan.choices[choice]));
    }
    std::pmr::vector<FieldSample> samples(points.size(), memory_);
    if (Result<void> ok = field(points, samples); !ok) return ok;
    made_.indices.reserve(mesh_.indices.size() + 15 * fans.size());
    size_t copied = 0;
    for (size_t f = 0; f < fans.size(); ++f) {
      const Fan& fan = fans[f];
      size_t choice = 0;
      while (choice < 2 && !(within(fan.choices[choice]) && onSurface(samples[2 * f + choice]) &&
                             looksOut(fan, fan.choices[choice]))) {
        ++choice;
      }
      const uint32_t centre = addCellVertex(*fan.loop, fan.choices[choice]);
      copyIndices(copied, fan.loop->first_index);
      copied = fan.loop->end_index;
      for (size_t i = 0; i < fan.count; ++i) {
        made_.indices.insert(made_.indices.end(), {centre, fan.ring[i], fan.ring[(i + 1) % fan.count]});
      }
    }
    copyIndices(copied, mesh_.indices.size());
    return {};
  }

  void copyIndices(size_t from, size_t to) {
    made_.indices.insert(made_.indices.end(), mesh_.indices.begin() + static_cast<std::ptrdiff_t>(from),
                         mesh_.indices.begin() + static_cast<std::ptrdiff_t>(to));
  }

  uint32_t addCellVertex(const Loop& loop, const Vector3& place) {
    uint8_t lowest_edge = UINT8_MAX;
    for (size_t i = 0; i < loop.count; ++i) {
      const VertexKey& key = mesh_.keys[loop.vertices[i]];
      int edge = 4 * key.axis, bit = 1;
      for (int axis = 0; axis < 3; ++axis) {
        if (axis == key.axis) continue;
        edge += key.corner[axis] == loop.corner[axis] ? 0 : bit;
        bit = 2;
      }
      lowest_edge = std::min(lowest_edge, static_cast<uint8_t>(edge));
    }
    const uint32_t first = loop.vertices[0];
    return addVertex(loop.corner, place, {loop.corner, mesh_.keys[first].level, kCellVertex, lowest_edge},
                     mesh_.attributes[first]);
  }

  const WorldMesh& mesh_;
  const int32_t cell_;
  std::pmr::memory_resource* memory_;
  std::pmr::vector<Loop> loops_;
  std::pmr::vector<Side> sides_;
  std::pmr::vector<Tangent> tangents_;  ///< by vertex
  std::pmr::vector<Vector3> normals_;   ///< as packed, by vertex of the first mesh
  WorldMesh made_;
};

}  // namespace

Result<WorldMesh> sharpen(const WorldMesh& mesh, int32_t cell, const FieldSampler& field,
                          std::pmr::memory_resource* memory) {
  return Sharpener(mesh, cell, memory).run(field);
}

}  // namespace sgm
