#include "mesh/creases.h"

#include <algorithm>
#include <cmath>

#include "mesh/vertex.h"

namespace sgm {
namespace {

constexpr double kSharpCosine = 0.9;      // normals that differ by more than 26 degrees may belong to a feature
constexpr double kOffSurface = 1.0 / 25;  // of a cell
constexpr double kSlide = 1.0 / 128;      // of a cell
constexpr double kOnCrease = 3.0 / 256;   // of a cell: nearer, triangles are slivers as thin as their rounding

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

Creases::Creases(const ChunkGrid& grid, const FieldSampler& field, MeshPart& part, std::pmr::memory_resource* memory)
    : grid_(grid), field_(field), part_(part), memory_(memory), tangents_(memory), normals_(memory) {}

void Creases::settle(std::span<const uint32_t> vertices) {
  tangents_.resize(part_.vertices.size());
  normals_.resize(part_.vertices.size());
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
  point[part_.keys[vertex].axis] += localUnits(step, grid_.cell);
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

bool Creases::isSharp(uint32_t a, uint32_t b) const {
  if (!(dot(normals_[a], normals_[b]) < kSharpCosine)) return false;
  const Tangent &of_a = tangents_[a], &of_b = tangents_[b];
  const auto isInPlane = [&](const Tangent& plane, const Tangent& of_vertex) {
    return std::fabs(dot(plane.normal, between(plane.point, of_vertex.point)) - plane.distance) <=
           kOnCrease * grid_.cell;
  };
  return !isInPlane(of_a, of_b) && !isInPlane(of_b, of_a);
}

Vector3 Creases::nearestOnCrease(uint32_t a, uint32_t b, const Int3& corner, const Vector3& start) const {
  const Tangent &of_a = tangents_[a], &of_b = tangents_[b];
  const Vector3 pa = between(corner, of_a.point), pb = between(corner, of_b.point);
  const Vector3 step = stepToBoth(of_a.normal, of_a.distance + dot(of_a.normal, minus(pa, start)), of_b.normal,
                                  of_b.distance + dot(of_b.normal, minus(pb, start)));
  return {start[0] + step[0], start[1] + step[1], start[2] + step[2]};
}

std::optional<Int3> Creases::onGrid(const Int3& corner, const Vector3& units, int across) const {
  Int3 place;
  for (int k = 0; k < 3; ++k) {
    const double at = std::floor(units[static_cast<size_t>(k)] / grid_.cell * kSubcell + 0.5);
    if (!(at >= -kMostOutside && at <= (k == across ? 0 : kSubcell) + kMostOutside)) return std::nullopt;
    place[k] = static_cast<int32_t>(at);
    const int64_t point = int64_t{corner[k]} + localUnits(place[k], grid_.cell);
    if (point != saturate(point)) return std::nullopt;
  }
  return place;
}

std::optional<Int3> Creases::onGridAlong(uint32_t a, uint32_t b, const Int3& corner, const Vector3& units,
                                         int across) const {
  const Vector3 along = cross(tangents_[a].normal, tangents_[b].normal);
  // A little within the bounds, for onGrid's rounding.
  const double beyond = (kMostOutside - 1) * (static_cast<double>(grid_.cell) / kSubcell);
  double least = -1e30, most = 1e30;
  for (int k = 0; k < 3; ++k) {
    const auto axis = static_cast<size_t>(k);
    const double lo = -beyond - units[axis], hi = (k == across ? 0 : grid_.cell) + beyond - units[axis];
    if (std::fabs(along[axis]) < 1e-6) {
      if (lo > 0 || hi < 0) return std::nullopt;
      continue;
    }
    least = std::max(least, (along[axis] > 0 ? lo : hi) / along[axis]);
    most = std::min(most, (along[axis] > 0 ? hi : lo) / along[axis]);
  }
  if (least > most) return std::nullopt;
  const double step = std::clamp(0.0, least, most);
  return onGrid(corner, {units[0] + step * along[0], units[1] + step * along[1], units[2] + step * along[2]}, across);
}

Int3 Creases::sampledAt(const Int3& corner, const Int3& place) const {
  Int3 point;
  for (int k = 0; k < 3; ++k) point[k] = corner[k] + localUnits(place[k], grid_.cell);
  return point;
}

double Creases::mostOffSurface() const { return kOffSurface * grid_.cell + 1; }

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

}  // namespace sgm
