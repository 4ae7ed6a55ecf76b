#include "mesh/sharpen.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "mesh/hash.h"
#include "mesh/tables.h"

namespace sgm {
namespace {

/// Of a cell's face: what slivers may look away for their vertices' rounding to 1/256 of a cell.
constexpr double kFold = 0.02;

/// Triangles of one loop, and its vertices in order.
struct Loop {
  size_t first_index = 0, end_index = 0;
  Int3 corner;  ///< of the cell
  std::array<uint32_t, kLongestCubeLoop> vertices{};
  size_t count = 0;
};

/// A loop with its face vertices, around the cell vertex to come.
struct Fan {
  const Loop* loop;
  std::array<uint32_t, 2 * kLongestCubeLoop> ring{};
  std::array<Vector3, 2 * kLongestCubeLoop> places{};  ///< units from the cell's corner
  size_t count = 0;
  std::array<std::optional<Int3>, 3> choices{};  ///< of the cell vertex, best first; the last one always serves
};

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

Int3 lowest(const Int3& a, const Int3& b) { return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)}; }

/// The cell whose edges these are: no three that make a triangle lie in one face.
Int3 cellOf(const VertexKey& a, const VertexKey& b, const VertexKey& c, int32_t cell) {
  Int3 corner;
  for (int axis = 0; axis < 3; ++axis) {
    int32_t lo = INT32_MIN;
    for (const VertexKey* key : {&a, &b, &c}) {
      // No cell lies below the world's lowest corner.
      lo = std::max(lo, saturate(int64_t{key->corner[axis]} - (key->axis == axis ? 0 : cell)));
    }
    corner[axis] = lo;
  }
  return corner;
}

class BodySharpener {
 public:
  BodySharpener(const ChunkGrid& grid, const FieldSampler& field, MeshPart& body, std::pmr::memory_resource* memory)
      : grid_(grid),
        field_(field),
        body_(body),
        edge_vertices_(static_cast<uint32_t>(body.vertices.size())),
        memory_(memory),
        creases_(grid, grid.level, field, body, memory),
        loops_(memory) {}

  void run() {
    std::pmr::vector<uint32_t> all(edge_vertices_, memory_);
    std::iota(all.begin(), all.end(), 0u);
    creases_.settle(all);
    findLoops();
    creases_.place();
    makeFans();
    hashPart(body_);
  }

 private:
  const VertexKey& key(uint32_t v) const { return body_.keys[v]; }
  bool isFeatureVertex(uint32_t v) const { return v >= edge_vertices_; }
  Int3 cellOfTriangle(size_t first_index) const {
    const uint32_t* v = &body_.indices[first_index];
    return cellOf(key(v[0]), key(v[1]), key(v[2]), grid_.cell);
  }

  /// The loops that have a sharp side, and these sides.
  void findLoops() {
    const size_t count = body_.indices.size();
    for (size_t at = 0; at < count;) {
      Loop loop;
      loop.first_index = at;
      loop.corner = cellOfTriangle(at);
      std::array<std::array<uint32_t, 2>, kLongestCubeLoop> steps{};
      size_t sides = 0;
      const auto take = [&] {
        for (size_t k = 0; k < 3; ++k) {
          const uint32_t a = body_.indices[at + k], b = body_.indices[at + (k + 1) % 3];
          if (sharedFace(key(a), key(b)) >= 0) steps[sides++] = {a, b};
        }
        at += 3;
      };
      const auto joins = [&](uint32_t v) {
        return std::find(&body_.indices[loop.first_index], body_.indices.data() + at, v) != body_.indices.data() + at;
      };
      take();
      // A loop's triangles stand together, and loops of a cell have no vertex in common.
      while (at < count && cellOfTriangle(at) == loop.corner &&
             (joins(body_.indices[at]) || joins(body_.indices[at + 1]) || joins(body_.indices[at + 2]))) {
        take();
      }
      loop.end_index = at;
      bool any = false;
      for (size_t i = 0; i < sides; ++i) {
        const auto [a, b] = steps[i];
        if (!creases_.isSharp(a, b)) continue;
        any = true;
        creases_.add(a, b, lowest(key(a).corner, key(b).corner), sharedFace(key(a), key(b)));
      }
      if (!any) continue;
      uint32_t next = body_.indices[loop.first_index];
      for (size_t i = 0; i < sides; ++i) {
        loop.vertices[loop.count++] = next;
        next = (*std::find_if(steps.begin(), steps.end(), [&](const auto& s) { return s[0] == next; }))[1];
      }
      loops_.push_back(loop);
    }
  }

  Fan fanOf(const Loop& loop) const {
    Fan fan{&loop};
    for (size_t i = 0; i < loop.count; ++i) {
      const uint32_t a = loop.vertices[i], b = loop.vertices[(i + 1) % loop.count];
      fan.ring[fan.count++] = a;
      if (const uint32_t middle = creases_.faceVertex(a, b); middle != Creases::kNoVertex) {
        fan.ring[fan.count++] = middle;
      }
    }
    if (fan.count == loop.count) return fan;
    Vector3 all{}, features{};
    for (size_t i = 0; i < fan.count; ++i) {
      fan.places[i] = creases_.unitsFrom(loop.corner, fan.ring[i]);
      for (size_t k = 0; k < 3; ++k) {
        all[k] += fan.places[i][k];
        if (isFeatureVertex(fan.ring[i])) features[k] += fan.places[i][k];
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
      const Tangent& t = creases_.tangent(loop.vertices[i]);
      planes.add(t.normal, t.distance + dot(t.normal, minus(between(loop.corner, t.point), middle)));
    }
    const PlaneAxes axes(planes);
    for (size_t choice = 0; choice < 2; ++choice) {
      const Vector3 step = axes.step(3 - choice);
      fan.choices[choice] =
          creases_.onGrid(loop.corner, {middle[0] + step[0], middle[1] + step[1], middle[2] + step[2]});
    }
    fan.choices[2] = creases_.onGrid(loop.corner, middle);
    return fan;
  }

  /// Whether all triangles about the place look out of the solid, or lie in the surface: a corner beyond the loop that
  /// sees it is the end of straight edges all the same, and part of a side then lies upon itself.
  bool looksOut(const Fan& fan, const Int3& at) const {
    const double step = static_cast<double>(grid_.cell) / kSubcell;
    const Vector3 place{at.x * step, at.y * step, at.z * step};
    for (size_t i = 0; i < fan.count; ++i) {
      const size_t j = (i + 1) % fan.count;
      const Vector3 area = cross(minus(fan.places[i], place), minus(fan.places[j], place));
      Vector3 out{};
      double off = 0;
      for (const uint32_t v : {fan.ring[i], fan.ring[j]}) {
        if (isFeatureVertex(v)) continue;
        const Tangent& t = creases_.tangent(v);
        for (size_t k = 0; k < 3; ++k) out[k] += t.normal[k];
        off = std::max(off, std::fabs(dot(t.normal, minus(place, between(fan.loop->corner, t.point))) - t.distance));
      }
      if (dot(area, out) < -kFold * grid_.cell * grid_.cell && off > creases_.mostOffSurface()) return false;
    }
    return true;
  }

  /// In the place of the loops' triangles, each fan's behind each other.
  void makeFans() {
    std::pmr::vector<Fan> fans(memory_);
    std::pmr::vector<Int3> points(memory_);
    for (const Loop& loop : loops_) {
      const Fan fan = fanOf(loop);
      if (fan.count == loop.count) continue;
      fans.push_back(fan);
      for (size_t choice = 0; choice < 2; ++choice) {
        points.push_back(creases_.sampledAt(loop.corner, fan.choices[choice].value_or(Int3{})));
      }
    }
    if (fans.empty()) return;
    std::pmr::vector<FieldSample> samples(points.size(), memory_);
    field_(points, samples, Sampled::all);
    RawVector<uint32_t> indices(memory_);
    indices.reserve(body_.indices.size() + 15 * fans.size());
    size_t copied = 0;
    const auto copyTo = [&](size_t end) {
      indices.insert(indices.end(), body_.indices.begin() + static_cast<std::ptrdiff_t>(copied),
                     body_.indices.begin() + static_cast<std::ptrdiff_t>(end));
    };
    for (size_t f = 0; f < fans.size(); ++f) {
      const Fan& fan = fans[f];
      const auto serves = [&](size_t choice) {
        const std::optional<Int3>& place = fan.choices[choice];
        return place && creases_.isOnSurface(samples[2 * f + choice]) && looksOut(fan, *place);
      };
      size_t choice = 0;
      while (choice < 2 && !serves(choice)) ++choice;
      const uint32_t centre = addCellVertex(*fan.loop, fan.choices[choice].value_or(Int3{}));
      copyTo(fan.loop->first_index);
      copied = fan.loop->end_index;
      for (size_t i = 0; i < fan.count; ++i) {
        indices.insert(indices.end(), {centre, fan.ring[i], fan.ring[(i + 1) % fan.count]});
      }
    }
    copyTo(body_.indices.size());
    body_.indices = std::move(indices);
  }

  uint32_t addCellVertex(const Loop& loop, const Int3& place) {
    uint8_t lowest_edge = UINT8_MAX;
    for (size_t i = 0; i < loop.count; ++i) {
      const VertexKey& of = key(loop.vertices[i]);
      int edge = 4 * of.axis, bit = 1;
      for (int axis = 0; axis < 3; ++axis) {
        if (axis == of.axis) continue;
        edge += of.corner[axis] == loop.corner[axis] ? 0 : bit;
        bit = 2;
      }
      lowest_edge = std::min(lowest_edge, static_cast<uint8_t>(edge));
    }
    const uint32_t first = loop.vertices[0];
    return creases_.append({loop.corner, key(first).level, kCellVertex, lowest_edge}, place, first);
  }

  const ChunkGrid grid_;
  const FieldSampler& field_;
  MeshPart& body_;
  const uint32_t edge_vertices_;  ///< behind them stand feature vertices
  std::pmr::memory_resource* memory_;
  Creases creases_;
  std::pmr::vector<Loop> loops_;
};

}  // namespace

void sharpenBody(const ChunkGrid& grid, const FieldSampler& field, MeshPart& body, std::pmr::memory_resource* memory) {
  if (!body.indices.empty()) BodySharpener(grid, field, body, memory).run();
}

}  // namespace sgm
