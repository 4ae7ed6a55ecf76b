#include "mesh/creases.h"

#include <algorithm>
#include <cmath>

#include "mesh/feature_kind.h"
#include "mesh/vertex.h"

namespace sgm {
namespace {

constexpr double kSharpCosine = 0.9;      // normals that differ by more than 26 degrees may belong to a feature
constexpr double kOffSurface = 1.0 / 25;  // of a cell
constexpr double kSlide = 1.0 / 128;      // of a cell

Vector3 gradientOf(const FieldSample& s) { return {s.gradient[0], s.gradient[1], s.gradient[2]}; }

/// The unit vector of a gradient; 0 where it has no length.
Vector3 directionOf(const FieldSample& s) {
  Vector3 n = gradientOf(s);
  const double steepness = std::sqrt(dot(n, n));
  for (double& x : n) x = steepness > 0 ? x / steepness : 0;
  return n;
}

Tangent tangentAt(const Int3& point, const FieldSample& s) {
  const Vector3 n = directionOf(s);
  const double steepness = dot(n, gradientOf(s));
  return {point, n, steepness > 0 ? -double{s.value} / steepness : 0};
}

int16_t& coordinate(Vertex& v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

}  // namespace

Creases::Creases(const ChunkGrid& grid, int level, const FieldSampler& field, MeshPart& part,
                 std::pmr::memory_resource* memory)
    : grid_(grid),
      cell_(grid.cell << (level - grid.level)),
      field_(field),
      part_(part),
      memory_(memory),
      tangents_(part.vertices.size(), memory),
      normals_(part.vertices.size(), memory),
      sides_(memory) {}

void Creases::settle(std::span<const uint32_t> vertices) {
  touch(vertices);
  slide(vertices);
}

void Creases::touch(std::span<const uint32_t> vertices) {
  std::pmr::vector<Int3> points(memory_);
  points.reserve(vertices.size());
  for (const uint32_t v : vertices) points.push_back(vertexUnits(grid_, part_.vertices[v]));
  std::pmr::vector<FieldSample> samples(points.size(), memory_);
  field_(points, samples, Sampled::all);
  for (size_t i = 0; i < points.size(); ++i) {
    tangents_[vertices[i]] = tangentAt(points[i], samples[i]);
    normals_[vertices[i]] = unpackNormal(samples[i].normal_x, samples[i].normal_y);
  }
}

/// The point of a vertex's edge at `step` 256ths of it.
Int3 Creases::pointOnEdge(uint32_t vertex, int32_t step) const {
  Int3 point = part_.keys[vertex].corner;
  point[part_.keys[vertex].axis] += localUnits(step, cell_);
  return point;
}

/// Samples the field at one place on each of these vertices' edges.
std::pmr::vector<FieldSample> Creases::sampleEdges(std::span<const uint32_t> vertices, std::span<const int32_t> steps,
                                                   Sampled what) const {
  std::pmr::vector<Int3> points(memory_);
  points.reserve(vertices.size());
  for (size_t i = 0; i < vertices.size(); ++i) points.push_back(pointOnEdge(vertices[i], steps[i]));
  std::pmr::vector<FieldSample> samples(points.size(), memory_);
  field_(points, samples, what);
  return samples;
}

/// Moves vertices that lie off the surface, on grid edges that pass through a crease, by bisection.
void Creases::slide(std::span<const uint32_t> vertices) {
  std::pmr::vector<uint32_t> off(memory_), moving(memory_);
  for (const uint32_t v : vertices) {
    if (std::fabs(tangents_[v].distance) > kSlide * cell_) off.push_back(v);
  }
  if (off.empty()) return;
  std::pmr::vector<int32_t> lo(off.size(), 0, memory_), hi(off.size(), kSubcell, memory_), step(memory_);
  std::pmr::vector<bool> solid(memory_);
  const std::pmr::vector<FieldSample> first = sampleEdges(off, lo), last = sampleEdges(off, hi);
  for (size_t i = 0; i < off.size(); ++i) {
    const bool from_solid = first[i].value < 0;
    if (from_solid == (last[i].value < 0)) continue;
    if (!(dot(directionOf(first[i]), directionOf(last[i])) < kSharpCosine)) continue;
    moving.push_back(off[i]);
    solid.push_back(from_solid);
  }
  if (moving.empty()) return;
  lo.assign(moving.size(), 0);
  hi.assign(moving.size(), kSubcell);
  step.resize(moving.size());
  for (int width = kSubcell; width > 1; width /= 2) {
    for (size_t i = 0; i < moving.size(); ++i) step[i] = (lo[i] + hi[i]) / 2;
    const std::pmr::vector<FieldSample> middle = sampleEdges(moving, step, Sampled::value);
    for (size_t i = 0; i < moving.size(); ++i) ((middle[i].value < 0) == solid[i] ? lo[i] : hi[i]) = step[i];
  }
  for (int32_t& at : lo) at = std::max(at, 1);
  const std::pmr::vector<FieldSample> settled = sampleEdges(moving, lo);
  for (size_t i = 0; i < moving.size(); ++i) {
    const VertexKey& key = part_.keys[moving[i]];
    Vertex& vertex = part_.vertices[moving[i]];
    const int32_t from = (key.corner[key.axis] - grid_.origin[key.axis]) / grid_.cell * kSubcell;
    coordinate(vertex, key.axis) = static_cast<int16_t>(from + lo[i] * (cell_ / grid_.cell));
    vertex.normal_x = settled[i].normal_x;
    vertex.normal_y = settled[i].normal_y;
    tangents_[moving[i]] = tangentAt(pointOnEdge(moving[i], lo[i]), settled[i]);
    normals_[moving[i]] = unpackNormal(vertex.normal_x, vertex.normal_y);
  }
}

bool Creases::isSharp(uint32_t a, uint32_t b) const { return dot(normals_[a], normals_[b]) < kSharpCosine; }

Creases::Side Creases::withOrderedEnds(uint32_t a, uint32_t b) const {
  if (part_.keys[b] < part_.keys[a]) std::swap(a, b);
  return {a, b, {}, 0};
}

void Creases::add(uint32_t a, uint32_t b, const Int3& corner, int axis) {
  Side side = withOrderedEnds(a, b);
  side.corner = corner;
  side.axis = axis;
  sides_.push_back(side);
}

/// The place on the crease of a side's two tangents that is nearest to the side's middle. Not where they meet in the
/// face: that may be far away, and out of order with the next one, where the crease runs nearly along the face.
std::optional<Int3> Creases::nearestOnCrease(const Side& side) const {
  const Tangent &a = tangents_[side.from], &b = tangents_[side.to];
  const Vector3 pa = between(side.corner, a.point), pb = between(side.corner, b.point);
  const Vector3 middle{(pa[0] + pb[0]) / 2, (pa[1] + pb[1]) / 2, (pa[2] + pb[2]) / 2};
  const Vector3 step = stepToBoth(a.normal, a.distance + dot(a.normal, minus(pa, middle)), b.normal,
                                  b.distance + dot(b.normal, minus(pb, middle)));
  return onGrid(side.corner, {middle[0] + step[0], middle[1] + step[1], middle[2] + step[2]}, side.axis);
}

void Creases::place() {
  std::sort(sides_.begin(), sides_.end());
  sides_.erase(std::unique(sides_.begin(), sides_.end(), [](const Side& a, const Side& b) { return a.sameEnds(b); }),
               sides_.end());
  std::pmr::vector<Side*> found(memory_);
  std::pmr::vector<Int3> places(memory_), points(memory_);
  for (Side& side : sides_) {
    const std::optional<Int3> place = nearestOnCrease(side);
    if (!place) continue;
    found.push_back(&side);
    places.push_back(*place);
    points.push_back(sampledAt(side.corner, *place));
  }
  std::pmr::vector<FieldSample> samples(points.size(), memory_);
  if (!points.empty()) field_(points, samples, Sampled::all);
  for (size_t i = 0; i < found.size(); ++i) {
    if (!isOnSurface(samples[i])) continue;
    Side& side = *found[i];
    const VertexKey& from = part_.keys[side.from];
    const int across = 3 - side.axis - from.axis;
    const auto of_face = static_cast<uint8_t>(from.axis * 2 + (from.corner[across] == side.corner[across] ? 0 : 1));
    side.vertex =
        append({side.corner, from.level, static_cast<uint8_t>(kFaceVertex + side.axis), of_face}, places[i], side.from);
  }
}

uint32_t Creases::faceVertex(uint32_t a, uint32_t b) const {
  const Side wanted = withOrderedEnds(a, b);
  const auto at = std::lower_bound(sides_.begin(), sides_.end(), wanted);
  return at != sides_.end() && at->sameEnds(wanted) ? at->vertex : kNoVertex;
}

std::optional<Int3> Creases::onGrid(const Int3& corner, const Vector3& units, int across) const {
  Int3 place;
  for (int k = 0; k < 3; ++k) {
    const double at = std::floor(units[static_cast<size_t>(k)] / cell_ * kSubcell + 0.5);
    if (!(at >= -kSubcell && at <= (k == across ? 1 : 2) * kSubcell)) return std::nullopt;
    place[k] = static_cast<int32_t>(at);
    const int64_t point = int64_t{corner[k]} + localUnits(place[k], cell_);
    if (point != saturate(point)) return std::nullopt;
  }
  return place;
}

Int3 Creases::sampledAt(const Int3& corner, const Int3& place) const {
  Int3 point;
  for (int k = 0; k < 3; ++k) point[k] = corner[k] + localUnits(place[k], cell_);
  return point;
}

double Creases::mostOffSurface() const { return kOffSurface * cell_ + 1; }

bool Creases::isOnSurface(const FieldSample& sample) const {
  const Vector3 g = gradientOf(sample);
  return std::fabs(double{sample.value}) <= mostOffSurface() * std::sqrt(dot(g, g));
}

Vector3 Creases::unitsFrom(const Int3& corner, uint32_t vertex) const {
  const Vertex& v = part_.vertices[vertex];
  const Vector3 start = between(corner, grid_.origin);
  const double step = static_cast<double>(grid_.cell) / kSubcell;
  return {start[0] + v.x * step, start[1] + v.y * step, start[2] + v.z * step};
}

uint32_t Creases::append(const VertexKey& key, const Int3& place, uint32_t like) {
  Vertex vertex = part_.vertices[like];
  for (int k = 0; k < 3; ++k) {
    const int32_t from = (key.corner[k] - grid_.origin[k]) / grid_.cell * kSubcell;
    coordinate(vertex, k) = static_cast<int16_t>(from + place[k] * (cell_ / grid_.cell));
  }
  vertex.kind = featureKind(key, place, grid_.level);
  part_.vertices.push_back(vertex);
  part_.keys.push_back(key);
  return static_cast<uint32_t>(part_.vertices.size() - 1);
}

}  // namespace sgm
