#include "mesh/creases.h"

#include <algorithm>
#include <cmath>

#include "mesh/vertex.h"

namespace sgm {
namespace {

constexpr double kSharpCosine = 0.9;      // cosine of 26 degrees: larger angles between normals indicate a feature
constexpr double kOffSurface = 1.0 / 25;  // in cells: tolerance for points on the surface
constexpr double kSlide = 1.0 / 128;      // in cells: a vertex at most this far from the surface is not moved
// sine of the angle between two lines in a face; below it, their intersection is ill-conditioned
constexpr double kLeastSine = 0.05;
// in cells: a vertex at most this far from a crease counts as lying on it, since triangles between the vertex and the
// crease would be slivers
constexpr double kOnCrease = 3.0 / 256;

Vector3 gradientOf(const FieldSample& s) { return {s.gradient[0], s.gradient[1], s.gradient[2]}; }

/// The unit vector of a gradient; 0 if it has no length.
Vector3 directionOf(const FieldSample& s) {
  Vector3 n = gradientOf(s);
  const double steepness = std::sqrt(dot(n, n));
  for (double& x : n) x = steepness > 0 ? x / steepness : 0;
  return n;
}

int16_t& coordinate(Vertex& v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

}  // namespace

Tangent tangentAt(const Int3& point, const FieldSample& s) {
  const Vector3 n = directionOf(s);
  const double steepness = dot(n, gradientOf(s));
  return {point, n, steepness > 0 ? -double{s.value} / steepness : 0};
}

Creases::Creases(const ChunkGrid& grid, const FieldSampler& field, MeshPart& part, std::pmr::memory_resource* memory)
    : grid_(grid), field_(field), part_(part), memory_(memory), tangents_(memory), normals_(memory) {}

void Creases::settle() {
  tangents_.resize(part_.vertices.size());
  normals_.resize(part_.vertices.size());
  touch();
  slide();
}

void Creases::touch() {
  std::pmr::vector<Int3> points(memory_);
  points.reserve(part_.vertices.size());
  for (const Vertex& vertex : part_.vertices) points.push_back(vertexUnits(grid_, vertex));
  std::pmr::vector<FieldSample> samples(points.size(), memory_);
  field_(points, samples, Sampled::all);
  for (size_t i = 0; i < points.size(); ++i) {
    tangents_[i] = tangentAt(points[i], samples[i]);
    normals_[i] = unpackNormal(samples[i].normal_x, samples[i].normal_y);
  }
}

/// Returns the point on a vertex's grid edge at `step` / 256 of the edge's length, counted from the edge's start.
Int3 Creases::pointOnEdge(uint32_t vertex, int32_t step) const {
  Int3 point = part_.keys[vertex].corner;
  point[part_.keys[vertex].axis] += localUnits(step, grid_.cell);
  return point;
}

/// Samples the field at one point on the grid edge of each given vertex. steps: positions of the points, in 1/256 of
/// the edge.
std::pmr::vector<FieldSample> Creases::sampleEdges(std::span<const uint32_t> vertices, std::span<const int32_t> steps,
                                                   Sampled what) const {
  std::pmr::vector<Int3> points(memory_);
  points.reserve(vertices.size());
  for (size_t i = 0; i < vertices.size(); ++i) points.push_back(pointOnEdge(vertices[i], steps[i]));
  std::pmr::vector<FieldSample> samples(points.size(), memory_);
  field_(points, samples, what);
  return samples;
}

/// Finds vertices that are off the surface, and whose grid edge passes through a crease. Moves each of them along its
/// grid edge to the point where the edge meets the surface, found by bisection.
void Creases::slide() {
  std::pmr::vector<uint32_t> off(memory_), moving(memory_);
  for (uint32_t v = 0; v < tangents_.size(); ++v) {
    if (std::fabs(tangents_[v].distance) > kSlide * grid_.cell) off.push_back(v);
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
    coordinate(vertex, key.axis) = static_cast<int16_t>(from + lo[i]);
    vertex.normal_x = settled[i].normal_x;
    vertex.normal_y = settled[i].normal_y;
    tangents_[moving[i]] = tangentAt(pointOnEdge(moving[i], lo[i]), settled[i]);
    normals_[moving[i]] = unpackNormal(vertex.normal_x, vertex.normal_y);
  }
}

bool Creases::differ(uint32_t a, uint32_t b) const { return dot(normals_[a], normals_[b]) < kSharpCosine; }

bool Creases::isSharp(uint32_t a, uint32_t b) const {
  if (!differ(a, b)) return false;
  const Tangent &of_a = tangents_[a], &of_b = tangents_[b];
  const auto isInPlane = [&](const Tangent& plane, const Tangent& of_vertex) {
    return std::fabs(dot(plane.normal, between(plane.point, of_vertex.point)) - plane.distance) <=
           kOnCrease * grid_.cell;
  };
  return !isInPlane(of_a, of_b) && !isInPlane(of_b, of_a);
}

Vector3 Creases::nearestOnCrease(const Tangent& a, const Tangent& b, const Int3& corner, const Vector3& start) {
  const Vector3 pa = between(corner, a.point), pb = between(corner, b.point);
  const Vector3 step = stepToBoth(a.normal, a.distance + dot(a.normal, minus(pa, start)), b.normal,
                                  b.distance + dot(b.normal, minus(pb, start)));
  return {start[0] + step[0], start[1] + step[1], start[2] + step[2]};
}

bool Creases::isOnCrease(const Tangent& a, const Tangent& b, const Int3& corner, const Vector3& place) const {
  const auto isInPlane = [&](const Tangent& t) {
    const double off = dot(t.normal, minus(place, between(corner, t.point))) - t.distance;
    return std::fabs(off) <= maxOffSurface();
  };
  return isInPlane(a) && isInPlane(b);
}

std::optional<FacePoint> Creases::meetingInFace(const Tangent& a, const Tangent& b, const Int3& corner, int axis) {
  const auto u = static_cast<size_t>((axis + 1) % 3), v = static_cast<size_t>((axis + 2) % 3);
  const auto lineOf = [&](const Tangent& t) {
    return std::array<double, 3>{t.normal[u], t.normal[v], t.distance + dot(t.normal, between(corner, t.point))};
  };
  const std::array<double, 3> of_a = lineOf(a), of_b = lineOf(b);
  const double sine = of_a[0] * of_b[1] - of_a[1] * of_b[0];
  const double lengths = std::sqrt((of_a[0] * of_a[0] + of_a[1] * of_a[1]) * (of_b[0] * of_b[0] + of_b[1] * of_b[1]));
  if (!(std::fabs(sine) > kLeastSine * lengths)) return std::nullopt;
  return FacePoint{(of_a[2] * of_b[1] - of_a[1] * of_b[2]) / sine, (of_a[0] * of_b[2] - of_a[2] * of_b[0]) / sine};
}

Creases::Range Creases::rangeOn(int axis, const Int3& corner, int across) const {
  const auto chunk = static_cast<int32_t>((int64_t{grid_.origin[axis]} - corner[axis]) / grid_.cell) * kSubcell;
  return {std::max(-kMaxOutside, chunk + 1),
          std::min((axis == across ? 0 : kSubcell) + kMaxOutside, chunk + kChunkCells * kSubcell - 1)};
}

std::optional<Int3> Creases::onGrid(const Int3& corner, const Vector3& units, int across) const {
  Int3 place;
  for (int k = 0; k < 3; ++k) {
    const double at = std::floor(units[static_cast<size_t>(k)] / grid_.cell * kSubcell + 0.5);
    if (!(at >= -kMaxOutside && at <= (k == across ? 0 : kSubcell) + kMaxOutside)) return std::nullopt;
    const Range range = rangeOn(k, corner, across);
    place[k] = std::clamp(static_cast<int32_t>(at), range.least, range.most);
  }
  return place;
}

std::optional<Int3> Creases::onGridAlong(const Tangent& a, const Tangent& b, const Int3& corner, const Vector3& units,
                                         int across) const {
  const Vector3 along = cross(a.normal, b.normal);
  const double step = static_cast<double>(grid_.cell) / kSubcell;
  double least = -1e30, most = 1e30;
  for (int k = 0; k < 3; ++k) {
    const auto axis = static_cast<size_t>(k);
    const Range range = rangeOn(k, corner, across);
    const double lo = range.least * step - units[axis], hi = range.most * step - units[axis];
    if (std::fabs(along[axis]) < 1e-6) {
      // The crease runs perpendicular to this axis, so moving along it does not change this coordinate. A crease in a
      // face of the chunk may lie up to 1/256 of a cell outside because of rounding. That is allowed here: onGrid()
      // moves the point inside.
      if (lo > step || hi < -step) return std::nullopt;
      continue;
    }
    least = std::max(least, (along[axis] > 0 ? lo : hi) / along[axis]);
    most = std::min(most, (along[axis] > 0 ? hi : lo) / along[axis]);
  }
  if (least > most) return std::nullopt;
  const double at = std::clamp(0.0, least, most);
  Vector3 place;
  for (size_t k = 0; k < 3; ++k) {
    // Clamps the point once more: because of rounding in `least` and `most`, it may lie slightly outside the range.
    const double lo = -kMaxOutside * step, hi = ((static_cast<int>(k) == across ? 0 : kSubcell) + kMaxOutside) * step;
    place[k] = std::clamp(units[k] + at * along[k], lo, hi);
  }
  return onGrid(corner, place, across);
}

Int3 Creases::sampledAt(const Int3& corner, const Int3& place) const {
  Int3 point;
  for (int k = 0; k < 3; ++k) point[k] = corner[k] + localUnits(place[k], grid_.cell);
  return point;
}

double Creases::maxOffSurface() const { return kOffSurface * grid_.cell + 1; }

bool Creases::isOnSurface(const FieldSample& sample) const {
  const Vector3 g = gradientOf(sample);
  return std::fabs(double{sample.value}) <= maxOffSurface() * std::sqrt(dot(g, g));
}

Vector3 Creases::unitsFrom(const Int3& corner, uint32_t vertex) const {
  const Vertex& v = part_.vertices[vertex];
  const Vector3 start = between(corner, grid_.origin);
  const double step = static_cast<double>(grid_.cell) / kSubcell;
  return {start[0] + v.x * step, start[1] + v.y * step, start[2] + v.z * step};
}

}  // namespace sgm
