#pragma once
// Caves made of samples, and queries of their voids.

#include "flooded_voids.h"

namespace sgm {

inline constexpr int32_t kCell = 512;
inline constexpr int32_t kBeyond = 6;  // number of additional samples beyond each side of a region

/// A cave: its samples, and the region of whole chunks that is queried.
struct Cave {
  Int3 chunks, first;  ///< number of chunks along each axis, and the lowest chunk
  SampledBox lattice;

  explicit Cave(Int3 chunks_in, Int3 first_in = {}) : chunks(chunks_in), first(first_in), lattice(low(), size()) {}
  Cave(const WorldField& world, Int3 chunks_in, Int3 first_in)
      : chunks(chunks_in), first(first_in), lattice(world, low(), size()) {}

  /// The queried region in samples, including both ends.
  IntBox region() const {
    return {{first.x * 32, first.y * 32, first.z * 32},
            {(first.x + chunks.x) * 32, (first.y + chunks.y) * 32, (first.z + chunks.z) * 32}};
  }

 private:
  Int3 low() const { return {first.x * 32 - kBeyond, first.y * 32 - kBeyond, first.z * 32 - kBeyond}; }
  Int3 size() const {
    return {chunks.x * 32 + 1 + 2 * kBeyond, chunks.y * 32 + 1 + 2 * kBeyond, chunks.z * 32 + 1 + 2 * kBeyond};
  }
};

inline void digBall(Cave& cave, Int3 at, double radius) {
  const int r = static_cast<int>(radius);
  for (int z = -r; z <= r; ++z)
    for (int y = -r; y <= r; ++y)
      for (int x = -r; x <= r; ++x)
        if (x * x + y * y + z * z <= radius * radius) cave.lattice.set({at.x + x, at.y + y, at.z + z}, false);
}

inline std::array<double, 3> placeOf(Int3 sample, int32_t cell = kCell) {
  return {static_cast<double>(sample.x) * cell, static_cast<double>(sample.y) * cell,
          static_cast<double>(sample.z) * cell};
}

inline VoidQuestion questionOf(const Cave& cave, Int3 from, Int3 to, double radius_in_cells, bool widest = false,
                               int32_t cell = kCell) {
  VoidQuestion question;
  const IntBox samples = cave.region();
  for (int axis = 0; axis < 3; ++axis) {
    question.region.lo[axis] = samples.lo[axis] * cell;
    question.region.hi[axis] = samples.hi[axis] * cell;
  }
  question.radius = radius_in_cells * cell;
  question.ends = VoidQuestion::Ends{placeOf(from, cell), placeOf(to, cell), widest};
  return question;
}

inline VoidAnswer answered(const SignField& field, const VoidQuestion& question, unsigned threads = 1) {
  const auto jobs = *makeThreadPool(threads);
  Result<VoidAnswer> answer = findVoids(field, *jobs, question);
  INFO((answer ? "" : answer.error().message));
  REQUIRE(answer);
  return std::move(*answer);
}

/// Whether `way` is a path from `from` to `to`: every place is open, every step joins neighbouring samples, and the
/// path has the length that `way` states.
inline bool isWay(const VoidWay& way, const FloodedVoids& flooded, Int3 from, Int3 to, int32_t cell) {
  if (way.places.empty() || way.places.front() != Int3{from.x * cell, from.y * cell, from.z * cell}) return false;
  if (way.places.back() != Int3{to.x * cell, to.y * cell, to.z * cell}) return false;
  double length = 0;
  for (size_t i = 0; i < way.places.size(); ++i) {
    const Int3 p = way.places[i];
    if (p.x % cell != 0 || p.y % cell != 0 || p.z % cell != 0) return false;
    if (!flooded.open({p.x / cell, p.y / cell, p.z / cell})) return false;
    if (i == 0) continue;
    const Int3 b = way.places[i - 1], step{(p.x - b.x) / cell, (p.y - b.y) / cell, (p.z - b.z) / cell};
    if (std::ranges::count(joiningSteps(), step) != 1) return false;
    length += std::sqrt(static_cast<double>(step.x * step.x + step.y * step.y + step.z * step.z)) * cell;
  }
  return std::fabs(length - way.length) <= 1e-9 * length;
}

}  // namespace sgm
