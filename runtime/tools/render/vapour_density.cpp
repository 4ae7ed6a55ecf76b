#include "tools/render/vapour_density.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <numeric>
#include <optional>

namespace sgm {
namespace {

constexpr double kMaxPoints = double{1 << 25};
constexpr int kMargin = 6;                  // number of empty lattice points around the mesh, which smoothing needs
constexpr int kSubColumns = 2;              // number of rays along each horizontal edge of a lattice cell; each column
                                            // of cells gets the square of this number
constexpr std::array kSoftenings{1, 2, 3};  // radii of the successive smoothing passes, in cells
/// Mean optical depth of a cloud: its middle is nearly opaque and its base is grey. It is the same for clouds of all
/// sizes, so that a small cloud beside a tower looks as dense as a large one far away.
constexpr float kMeanDepth = 20;
constexpr float kLongestChord = 600;  // metres; upper limit of the mean chord length of the clouds; endless cloud decks
                                      // exceed it
/// Values of the smoothed outline at which a cloud begins (kThin, a little outside the mesh) and has full density
/// (kDense).
constexpr float kThin = 0.28f, kDense = 0.85f;

float areaOf(const RayCaster& mesh) {
  double sum = 0;
  for (uint32_t i = 0; i < mesh.triangleCount(); ++i) sum += 0.5 * static_cast<double>(glm::length(mesh.facing(i)));
  return static_cast<float>(sum);
}

VapourLattice latticeOver(const RayCaster& outline) {
  const glm::vec3 extent = outline.hi() - outline.lo();
  // If memory allows, cells are as fine as the mesh, assuming that a triangle covers half of a cell's face.
  const float mean = std::sqrt(2 * areaOf(outline) / static_cast<float>(outline.triangleCount()));
  const double volume = double{extent.x} * static_cast<double>(extent.y) * static_cast<double>(extent.z);
  VapourLattice lattice;
  lattice.spacing = std::max({0.8f * mean, static_cast<float>(std::cbrt(volume / kMaxPoints)),
                              std::max({extent.x, extent.y, extent.z}) / 2000, 1e-3f});
  const auto sizeAt = [&] { return glm::ivec3(glm::ceil(extent / lattice.spacing)) + 2 * kMargin + 1; };
  lattice.size = sizeAt();
  while (static_cast<double>(lattice.count()) > 2 * kMaxPoints) {
    lattice.spacing *= 1.1f;
    lattice.size = sizeAt();
  }
  lattice.corner = outline.lo() - lattice.spacing * static_cast<float>(kMargin);
  return lattice;
}

}  // namespace

VapourDensity::VapourDensity(const RayCaster& outline, JobSystem& jobs) : lattice_(latticeOver(outline)) {
  outline_.assign(lattice_.count(), 0);
  brick_count_ = (lattice_.size - 2 + kBrick) / kBrick;
  bricks_.assign(size_t(brick_count_.x) * size_t(brick_count_.y) * size_t(brick_count_.z), kEmpty);
  fillColumns(outline, jobs);
  const double points = std::accumulate(outline_.begin(), outline_.end(), 0.0) / 255;
  const float volume = static_cast<float>(points) * lattice_.spacing * lattice_.spacing * lattice_.spacing;
  const float chord = 4 * volume / std::max(areaOf(outline), 1e-12f);
  mean_free_path_ = std::clamp(chord, 1e-3f, kLongestChord) / kMeanDepth;
  for (const int reach : kSoftenings) soften(reach, jobs);
  markBricks(jobs);
}

// Casts upward rays through each column of cells, to find the intervals that are inside the mesh. If the region's
// border has cut the mesh open, an interval without an end ends at the mesh's bounding box.
void VapourDensity::fillColumns(const RayCaster& outline, JobSystem& jobs) {
  const float high = outline.hi().y - outline.lo().y, step = 1e-5f * (high + lattice_.spacing);
  // One job handles a whole slice of bricks. So no other job writes the materials of these bricks, and no lock is
  // needed.
  parallelFor(jobs, size_t(brick_count_.z), [&](size_t slice) {
    std::vector<float> column(static_cast<size_t>(lattice_.size.y));
    const int first = int(slice) * kBrick;
    const int end = int(slice) + 1 == brick_count_.z ? lattice_.size.z : first + kBrick;
    for (int z = first; z < end; ++z) {
      for (int x = 0; x < lattice_.size.x; ++x) {
        std::ranges::fill(column, 0.0f);
        // Adds the interval from..to, in metres above the mesh's lowest point, to the column.
        const auto fill = [&](float from, float to, uint32_t material) {
          const float lo = from / lattice_.spacing + kMargin + 0.5f, hi = to / lattice_.spacing + kMargin + 0.5f;
          for (int y = std::max(0, int(lo)); y <= std::min(int(hi), lattice_.size.y - 1); ++y) {
            const float inside = std::min(hi, float(y + 1)) - std::max(lo, float(y));
            column[size_t(y)] += std::max(0.0f, inside) / (kSubColumns * kSubColumns);
            bricks_[brickIndex(glm::min(glm::ivec3(x, y, z) / kBrick, brick_count_ - 1))] =
                static_cast<uint16_t>(material);
          }
        };
        for (int sub = 0; sub < kSubColumns * kSubColumns; ++sub) {
          // The odd offset (0.517 of the distance between two rays) keeps the rays off the planes of the grid on which
          // the mesh was sampled, where they would hit edges of its triangles.
          const glm::vec2 cell(float(sub % kSubColumns), float(sub / kSubColumns));
          const glm::vec2 off = (cell + 0.517f) / float(kSubColumns) - 0.5f;
          const float from_x = lattice_.corner.x + lattice_.spacing * (float(x) + off.x);
          const float from_z = lattice_.corner.z + lattice_.spacing * (float(z) + off.y);
          float at = -2 * step, since = 0;
          bool within = false, met = false;
          uint32_t material = 0;
          for (;;) {
            const glm::vec3 start(from_x, outline.lo().y + at + step, from_z);
            const std::optional<RayHit> hit = outline.cast(start, glm::vec3(0.0f, 1.0f, 0.0f), high + 4 * step - at);
            if (!hit) break;
            at += hit->distance + step;
            material = outline.vertex(hit->triangle, 0).material;
            if (!met && !hit->front) within = true;
            met = true;
            if (hit->front && !within) since = at;
            if (!hit->front && within) fill(since, at, material);
            within = hit->front;
          }
          if (within) fill(since, high, material);
        }
        for (int y = 0; y < lattice_.size.y; ++y)
          outline_[lattice_.at(x, y, z)] = uint8_t(std::min(column[size_t(y)], 1.0f) * 255 + 0.5f);
      }
    }
  });
}

// Smooths along one axis after the other: each value becomes the weighted mean (1:2:1) of itself and the values at
// distance `reach` on both sides.
void VapourDensity::soften(int reach, JobSystem& jobs) {
  const auto off = static_cast<size_t>(reach);
  const glm::ivec3 size = lattice_.size;
  const std::array<size_t, 3> strides{1, size_t(size.x), size_t(size.x) * size_t(size.y)};
  for (int axis = 0; axis < 3; ++axis) {
    const int across = axis == 2 ? 1 : 2;  // axis over which the loop runs in parallel
    const int other = 3 - axis - across;
    const size_t stride = strides[size_t(axis)];
    parallelFor(jobs, size_t(size[across]), [&](size_t slice) {
      std::vector<uint8_t> line(static_cast<size_t>(size[axis]));
      for (int i = 0; i < size[other]; ++i) {
        uint8_t* first = outline_.data() + slice * strides[size_t(across)] + size_t(i) * strides[size_t(other)];
        for (size_t k = 0; k < line.size(); ++k) line[k] = first[k * stride];
        for (size_t k = 0; k < line.size(); ++k) {
          const int sum = line[k > off ? k - off : 0] + 2 * line[k] + line[std::min(k + off, line.size() - 1)];
          first[k * stride] = uint8_t((sum + 2) / 4);
        }
      }
    });
  }
}

// Smoothing has spread density into bricks that have no material yet: each gets the material of a neighbouring brick.
void VapourDensity::markBricks(JobSystem& jobs) {
  const std::vector<uint16_t> within = bricks_;
  parallelFor(jobs, size_t(brick_count_.z), [&](size_t slice) {
    for (int by = 0; by < brick_count_.y; ++by) {
      for (int bx = 0; bx < brick_count_.x; ++bx) {
        const glm::ivec3 brick(bx, by, int(slice));
        uint16_t& material = bricks_[brickIndex(brick)];
        if (material != kEmpty || !hasOutline(brick)) continue;
        for (int i = 0; i < 27 && material == kEmpty; ++i) {
          const glm::ivec3 next = brick + glm::ivec3(i % 3, i / 3 % 3, i / 9) - 1;
          if (glm::clamp(next, glm::ivec3(0), brick_count_ - 1) == next) material = within[brickIndex(next)];
        }
      }
    }
  });
}

bool VapourDensity::hasOutline(glm::ivec3 brick) const {
  const glm::ivec3 lo = brick * kBrick, hi = glm::min(lo + kBrick, lattice_.size - 1);
  for (int z = lo.z; z <= hi.z; ++z)
    for (int y = lo.y; y <= hi.y; ++y)
      for (int x = lo.x; x <= hi.x; ++x)
        if (outline_[lattice_.at(x, y, z)] > 0) return true;
  return false;
}

float VapourDensity::outlineAt(glm::vec3 place) const {
  const glm::vec3 held = glm::clamp(place, glm::vec3(0), glm::vec3(lattice_.size - 1) - 1e-3f);
  const glm::ivec3 i(held);
  const glm::vec3 f = held - glm::vec3(i);
  const uint8_t* p = outline_.data() + lattice_.at(i.x, i.y, i.z);
  const size_t row = size_t(lattice_.size.x), slice = row * size_t(lattice_.size.y);
  const auto along = [&](size_t off) { return float(p[off]) + f.x * float(int(p[off + 1]) - int(p[off])); };
  const float near = glm::mix(along(0), along(row), f.y), far = glm::mix(along(slice), along(slice + row), f.y);
  return glm::mix(near, far, f.z) / 255;
}

float VapourDensity::plainAt(glm::vec3 place) const {
  return std::clamp((outlineAt(place) - kThin) / (kDense - kThin), 0.0f, 1.0f);
}

uint32_t VapourDensity::materialAt(glm::vec3 place) const {
  const glm::ivec3 brick = glm::clamp(glm::ivec3(place) / kBrick, glm::ivec3(0), brick_count_ - 1);
  return bricks_[brickIndex(brick)];
}

glm::vec2 VapourDensity::crossing(glm::vec3 from, glm::vec3 direction) const {
  const glm::vec3 a = -from / direction, b = (glm::vec3(lattice_.size - 1) - from) / direction;
  const glm::vec3 first = glm::min(a, b), last = glm::max(a, b);
  return {std::max({first.x, first.y, first.z}), std::min({last.x, last.y, last.z})};
}

float VapourDensity::emptyAhead(glm::vec3 from, glm::vec3 direction, float t) const {
  const glm::vec3 place = from + direction * t;
  const glm::ivec3 brick = glm::clamp(glm::ivec3(place / float(kBrick)), glm::ivec3(0), brick_count_ - 1);
  if (!isEmptyBrick(brick)) return 0;
  const glm::vec3 a = (glm::vec3(brick * kBrick) - from) / direction;
  const glm::vec3 b = (glm::vec3((brick + 1) * kBrick) - from) / direction;
  const glm::vec3 last = glm::max(a, b);
  return std::max(std::min({last.x, last.y, last.z}) - t, 0.0f) + 1e-3f;
}

}  // namespace sgm
