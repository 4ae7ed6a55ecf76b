// Tests the separate voids of a chunk: their number is that of the mesh, and the masks of the blocks that each void
// touches are exact.

#include "mesh/void_components.h"

#include <algorithm>
#include <random>

#include "catch.h"
#include "mesh/case_rule.h"
#include "rounds.h"

using namespace sgm;

namespace {

using Signs = std::vector<uint64_t>;

bool solidAt(const Signs& signs, Int3 p) {
  return (signs[static_cast<size_t>(p.y + kChunkSamples * p.z)] >> p.x & 1) != 0;
}

template <class Solid>
Signs signsOf(const Solid& solid) {
  Signs signs(size_t{kChunkSamples} * kChunkSamples);
  for (int32_t z = 0; z < kChunkSamples; ++z) {
    for (int32_t y = 0; y < kChunkSamples; ++y) {
      uint64_t& row = signs[static_cast<size_t>(y + kChunkSamples * z)];
      for (int32_t x = 0; x < kChunkSamples; ++x) row |= uint64_t{solid(Int3{x, y, z})} << x;
    }
  }
  return signs;
}

bool inside(Int3 p) { return std::min({p.x, p.y, p.z}) >= 0 && std::max({p.x, p.y, p.z}) < kChunkSamples; }

/// Flood fill along the axes and across the diagonals of faces, which is how the mesh connects samples.
std::vector<std::vector<Int3>> floodFill(Signs signs) {
  std::vector<std::vector<Int3>> voids;
  const auto fill = [&](Int3 p) { signs[static_cast<size_t>(p.y + kChunkSamples * p.z)] |= uint64_t{1} << p.x; };
  for (int32_t z = 0; z < kChunkSamples; ++z) {
    for (int32_t y = 0; y < kChunkSamples; ++y) {
      for (int32_t x = 0; x < kChunkSamples; ++x) {
        if (solidAt(signs, {x, y, z})) continue;
        std::vector<Int3>& samples = voids.emplace_back(1, Int3{x, y, z});
        fill({x, y, z});
        for (size_t i = 0; i < samples.size(); ++i) {
          for (int n = 0; n < 27; ++n) {
            const int dx = n % 3 - 1, dy = n / 3 % 3 - 1, dz = n / 9 - 1;
            const Int3 to{samples[i].x + dx, samples[i].y + dy, samples[i].z + dz};
            if (std::abs(dx) + std::abs(dy) + std::abs(dz) > 2 || !inside(to) || solidAt(signs, to)) continue;
            fill(to);
            samples.push_back(to);
          }
        }
      }
    }
  }
  return voids;
}

/// The blocks that contain a sample, along one axis, by definition: block i contains the samples 4 i to 4 i + 4.
std::vector<int> blocksOf(int32_t sample) {
  std::vector<int> blocks;
  for (int i = 0; i < 8; ++i) {
    if (4 * i <= sample && sample <= 4 * i + 4) blocks.push_back(i);
  }
  return blocks;
}

VoidComponent masksOf(const std::vector<Int3>& samples) {
  VoidComponent c;
  for (const Int3 p : samples) {
    for (int axis = 0; axis < 3; ++axis) {
      if (p[axis] % 32 != 0) continue;
      uint64_t& face = c.faces[static_cast<size_t>(2 * axis + p[axis] / 32)];
      for (int a : blocksOf(p[axis == 0 ? 1 : 0])) {
        for (int b : blocksOf(p[axis == 2 ? 1 : 2])) face |= uint64_t{1} << (a + 8 * b);
      }
    }
    for (int x : blocksOf(p.x)) {
      for (int y : blocksOf(p.y)) {
        for (int z : blocksOf(p.z)) c.blocks[static_cast<size_t>(z)] |= uint64_t{1} << (x + 8 * y);
      }
    }
  }
  return c;
}

bool touches(const VoidComponent& c) {
  return std::any_of(c.faces.begin(), c.faces.end(), [](uint64_t mask) { return mask != 0; });
}

void join(VoidComponent& to, const VoidComponent& from) {
  for (size_t f = 0; f < 6; ++f) to.faces[f] |= from.faces[f];
  for (size_t z = 0; z < 8; ++z) to.blocks[z] |= from.blocks[z];
}

/// Balls and tubes of void in rock, or of rock in void, with a share of the samples inverted.
Signs randomChunk(std::mt19937& random, double noise) {
  const auto real = [&](double lo, double hi) { return std::uniform_real_distribution<>(lo, hi)(random); };
  const bool cave = random() % 2 == 0;
  struct Tube {
    std::array<double, 3> from, to;
    double radius;
  };
  std::vector<Tube> tubes(1 + random() % 12);
  for (Tube& tube : tubes) {
    for (size_t i = 0; i < 3; ++i) tube.from[i] = real(-4, 36), tube.to[i] = random() % 3 ? real(-4, 36) : tube.from[i];
    tube.radius = real(0.8, 6);
  }
  return signsOf([&](Int3 p) {
    const bool in_tube = std::any_of(tubes.begin(), tubes.end(), [&](const Tube& tube) {
      double along = 0, length = 1e-9, distance = 0;
      for (int i = 0; i < 3; ++i) {
        const auto k = static_cast<size_t>(i);
        along += (p[i] - tube.from[k]) * (tube.to[k] - tube.from[k]);
        length += (tube.to[k] - tube.from[k]) * (tube.to[k] - tube.from[k]);
      }
      along = std::clamp(along / length, 0.0, 1.0);
      for (int i = 0; i < 3; ++i) {
        const auto k = static_cast<size_t>(i);
        const double d = p[i] - tube.from[k] - along * (tube.to[k] - tube.from[k]);
        distance += d * d;
      }
      return distance < tube.radius * tube.radius;
    });
    return (in_tube != cave) != (noise > 0 && real(0, 1) < noise);
  });
}

}  // namespace

TEST_CASE("samples join in a cell exactly where the mesh joins them: over every case of the rule") {
  const Cell cube = cubeCell();
  for (uint32_t solid = 0; solid < 256; ++solid) {
    // Counts the components of the cell's corners of one sign; corners that differ in at most `diagonal` axes are
    // connected.
    const auto pieces = [&](bool sign, int diagonal) {
      size_t count = 0;
      for (uint32_t left = sign ? solid : ~solid & 255; left != 0; ++count) {
        uint32_t piece = left & -left;
        for (int i = 0; i < 8; ++i) {
          for (int a = 0; a < 8; ++a) {
            for (int b = 0; b < 8; ++b) {
              const int apart = a ^ b, axes = (apart & 1) + (apart >> 1 & 1) + (apart >> 2);
              if ((piece >> a & 1) && (left >> b & 1) && axes <= diagonal) piece |= 1u << b;
            }
          }
        }
        left &= ~piece;
      }
      return count;
    };
    CAPTURE(solid);
    // Each loop bounds one disk, and each disk adds one component to the cell.
    CHECK(loopsOfCase(cube, solid).size() + 1 == pieces(true, 1) + pieces(false, 2));
  }
}

TEST_CASE("voids join across the diagonal of every face, and not across a cell") {
  for (const Int3 to : {Int3{1, 0, 0}, Int3{1, 1, 0}, Int3{1, -1, 0}, Int3{1, 0, 1}, Int3{1, 0, -1}, Int3{0, 1, 1},
                        Int3{0, 1, -1}, Int3{1, 1, 1}, Int3{1, -1, 1}, Int3{-1, 1, 1}, Int3{1, 1, -1}}) {
    // Two voids that only the samples a and b can connect: one void extends to the chunk's low x face, the other to its
    // high x face.
    const Int3 a{15, 16, 16}, b{16, 16 + to.y, 16 + to.z};
    const Signs signs = signsOf([&](Int3 p) {
      const bool low = p.x <= a.x + (to.x < 1 ? 1 : 0) - (to.x < 0 ? 1 : 0) && p.y == a.y && p.z == a.z;
      const bool high = p.x >= b.x && p.y == b.y && p.z == b.z;
      return !low && !high;
    });
    CAPTURE(to.x, to.y, to.z);
    const bool across_cell = to.x != 0 && to.y != 0 && to.z != 0;
    CHECK(voidComponents(signs).size() == (across_cell ? 2 : 1));
  }
}

TEST_CASE("random chunks have the voids, masks and blocks that a flood fill finds") {
  size_t several = 0, joined = 0;
  for (uint32_t seed = 1; seed <= rounds(60); ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    const double noise = std::array{0.0, 0.0, 0.02, 0.3, 0.5}[seed % 5];
    const Signs signs = seed % 10 == 9 ? signsOf([&](Int3) { return random() % 8 != 0; }) : randomChunk(random, noise);
    VoidComponents expected;
    VoidComponent sealed;
    size_t touching = 0;
    std::vector<std::pair<VoidComponent, Int3>> voids;
    for (const std::vector<Int3>& samples : floodFill(signs)) {
      const VoidComponent& c = voids.emplace_back(masksOf(samples), samples[samples.size() / 2]).first;
      if (!touches(c)) {
        join(sealed, c);
      } else if (++touching <= 63) {
        expected.push_back(c);
      } else {
        join(expected.back(), c);
      }
    }
    if (sealed != VoidComponent{}) expected.push_back(sealed);
    const VoidComponents found = voidComponents(signs);
    CHECK(found == expected);
    CHECK(found.size() <= kMaxVoidComponents);
    several += touching > 1;
    joined += touching > 63;

    for (const auto& [c, sample] : voids) {
      const Int3 cell{std::min(sample.x, 31), std::min(sample.y, 31), std::min(sample.z, 31)};
      const auto listed = std::find(found.begin(), found.end(), c);
      const std::ptrdiff_t at = listed == found.end() ? found.end() - found.begin() - 1 : listed - found.begin();
      if (touching <= 63) CHECK((voidsAround(found, cell) >> at & 1) != 0);
      CHECK(voidsAround(found, cell) != 0);
    }
  }
  CHECK(several > 5);
  CHECK(joined > 0);
}

TEST_CASE("chunks that share a face share the masks of its voids") {
  std::mt19937 random(5);
  for (int axis = 0; axis < 3; ++axis) {
    const Signs low = randomChunk(random, 0.3);
    const Signs high = signsOf([&](Int3 p) {
      if (p[axis] != 0) return random() % 2 == 0;
      p[axis] = kChunkCells;
      return solidAt(low, p);
    });
    uint64_t from_low = 0, from_high = 0;
    for (const VoidComponent& c : voidComponents(low)) from_low |= c.faces[static_cast<size_t>(2 * axis + 1)];
    for (const VoidComponent& c : voidComponents(high)) from_high |= c.faces[static_cast<size_t>(2 * axis)];
    CHECK(from_low == from_high);
    CHECK(from_low != 0);
  }
}

TEST_CASE("a chunk of one sign has one void or none") {
  const VoidComponents open = voidOfUniform(false);
  CHECK(open == voidComponents(signsOf([](Int3) { return false; })));
  CHECK(open.size() == 1);
  CHECK(voidsAround(open, {31, 0, 17}) == 1);
  CHECK(voidOfUniform(true).empty());
  CHECK(voidComponents(signsOf([](Int3) { return true; })).empty());
  CHECK(voidsAround({}, {31, 0, 17}) == 0);
}
