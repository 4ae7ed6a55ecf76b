// Tests a mesh and its wedges: the triangles are unchanged, charts are split only where necessary, and every triangle
// is in one chart.

#include <cmath>
#include <map>
#include <random>
#include <set>

#include "base/math.h"
#include "catch.h"
#include "rounds.h"
#include "seed.h"
#include "texture/unwrap.h"

using namespace sgm;

namespace {

/// A tube along y with its middle at the origin, made of rings of vertices.
struct Tube {
  std::vector<TexturePoint> positions, normals;
  std::vector<MaterialMix> materials;
  std::vector<uint32_t> labels, indices;
  GrammarChunk chunk;
  std::vector<TextureSpace> spaces;

  Tube(double radius, double half, uint32_t around, uint32_t rings) {
    for (uint32_t ring = 0; ring < rings; ++ring) {
      for (uint32_t i = 0; i < around; ++i) {
        const double turn = 2 * kPi * (i + 0.3) / around;
        positions.push_back({radius * std::sin(turn), -half + 2 * half * ring / (rings - 1), radius * std::cos(turn)});
        normals.push_back({std::sin(turn), 0, std::cos(turn)});
      }
    }
    for (uint32_t ring = 0; ring + 1 < rings; ++ring) {
      for (uint32_t i = 0; i < around; ++i) {
        const uint32_t a = ring * around + i, b = ring * around + (i + 1) % around;
        for (const uint32_t corner : {a, b, b + around, a, b + around, a + around}) indices.push_back(corner);
      }
    }
    Shape shape;
    shape.kind = ShapeKind::cylinder;
    shape.size = {static_cast<float>(radius), static_cast<float>(half) * 2, 0, 0, 0, 0};
    chunk.shapes.push_back(shape);
    spaces.emplace_back(Int3{}, kUnitsPerMetre);
    spaces.emplace_back(chunk, 0, kUnitsPerMetre);
    labels.assign(positions.size(), 1);
    materials.resize(positions.size());
  }

  UnwrapInput input() const {
    return {positions, labels,   indices, [this](uint32_t label) -> const TextureSpace& { return spaces[label]; },
            normals,   materials};
  }
};

}  // namespace

TEST_CASE("triangles keep their corners, and only the cut doubles vertices") {
  for (uint32_t seed = 1; seed <= rounds(20); ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    const uint32_t around = static_cast<uint32_t>(12 + random() % 40), rings = static_cast<uint32_t>(3 + random() % 20);
    const Tube tube(1000.0 + static_cast<double>(random() % 9000), 5000, around, rings);
    const Unwrapped unwrapped = unwrap(tube.input(), std::pmr::get_default_resource());
    REQUIRE(unwrapped.corners.size() == tube.indices.size());
    for (size_t i = 0; i < tube.indices.size(); ++i) {
      REQUIRE(unwrapped.wedges[unwrapped.corners[i]].vertex == tube.indices[i]);
    }
    CHECK(unwrapped.wedges.size() == tube.positions.size() + rings);
    // No triangle spans the seam at which the coordinate around the tube starts again.
    for (size_t t = 0; t < unwrapped.corners.size(); t += 3) {
      for (size_t i = 0; i < 3; ++i) {
        const Wedge a = unwrapped.wedges[unwrapped.corners[t + i]];
        const Wedge b = unwrapped.wedges[unwrapped.corners[t + (i + 1) % 3]];
        CHECK(std::fabs(a.u - b.u) < 0.3f * static_cast<float>(2 * kPi * 10000 / kUnitsPerMetre));
      }
    }
    const TexelDensity density = texelDensity(tube.input(), unwrapped, kUnitsPerMetre);
    CHECK(density.middle == Approx(1).epsilon(0.1));
    CHECK(density.high / density.low < 1.01);
    CHECK(density.seams == Approx(static_cast<double>(rings) / static_cast<double>(tube.positions.size())));
  }
}

TEST_CASE("a triangle lies in the space of two of its vertices, and the world's tiles are on one lattice") {
  Tube tube(3000, 5000, 24, 6);
  for (size_t i = 72; i < tube.labels.size(); ++i) tube.labels[i] = 0;
  const Unwrapped unwrapped = unwrap(tube.input(), std::pmr::get_default_resource());
  std::set<uint32_t> vertices;
  for (const Wedge& wedge : unwrapped.wedges) vertices.insert(wedge.vertex);
  CHECK(vertices.size() == tube.positions.size());
  // The upper part belongs to no shape, so its texture coordinates come from the world's axes. If their origin
  // moves by a whole number of tiles, the coordinates change by whole numbers.
  Tube moved = tube;
  moved.spaces[0] = TextureSpace({7 * kUnitsPerMetre, -3 * kUnitsPerMetre, 11 * kUnitsPerMetre}, kUnitsPerMetre);
  const Unwrapped other = unwrap(moved.input(), std::pmr::get_default_resource());
  REQUIRE(other.wedges.size() == unwrapped.wedges.size());
  for (size_t i = 0; i < other.wedges.size(); ++i) {
    for (const float off : {other.wedges[i].u - unwrapped.wedges[i].u, other.wedges[i].v - unwrapped.wedges[i].v}) {
      CHECK(std::fabs(off - std::round(off)) < 1e-4f);
    }
  }
}

TEST_CASE("all corners of a triangle have one pair of materials, and only pairs double vertices") {
  const unsigned seed = testSeed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  for (unsigned round = 0; round < rounds(20); ++round) {
    const uint32_t around = static_cast<uint32_t>(12 + random() % 40),
                   rings = static_cast<uint32_t>(10 + random() % 20);
    Tube tube(1000.0 + static_cast<double>(random() % 9000), 5000, around, rings);
    // The tube has one material below the ring `border`, another above it, and both in this ring. The two lowest rings
    // belong to no shape.
    const size_t border = 5 + random() % (rings - 8);
    for (size_t i = 0; i < 2 * size_t{around}; ++i) tube.labels[i] = 0;
    const size_t plain = unwrap(tube.input(), std::pmr::get_default_resource()).wedges.size();
    for (size_t i = 0; i < tube.materials.size(); ++i) {
      const size_t ring = i / around;
      for (size_t k = 0; k < kMaterialSamples; ++k) {
        tube.materials[i][k] = ring > border || (ring == border && k < 5) ? 4 : 2;
      }
    }
    const Unwrapped unwrapped = unwrap(tube.input(), std::pmr::get_default_resource());
    REQUIRE(unwrapped.corners.size() == tube.indices.size());
    std::map<std::pair<uint32_t, std::array<uint16_t, 2>>, std::set<uint8_t>> shares;
    for (size_t t = 0; t < unwrapped.corners.size(); t += 3) {
      const Wedge& first = unwrapped.wedges[unwrapped.corners[t]];
      size_t by_world = 0;
      for (size_t i = 0; i < 3; ++i) {
        const Wedge& wedge = unwrapped.wedges[unwrapped.corners[t + i]];
        REQUIRE(wedge.vertex == tube.indices[t + i]);
        CHECK(wedge.materials == first.materials);
        shares[{wedge.vertex, wedge.materials}].insert(wedge.share);
        const size_t ring = wedge.vertex / around;
        if (wedge.materials == std::array<uint16_t, 2>{2, 4}) {
          CHECK(wedge.share == (ring > border ? 255 : ring < border ? 0 : 142));
        } else {
          CHECK(wedge.materials[0] == (ring > border ? 4 : 2));
          CHECK(wedge.share == 0);
        }
        const int planes = wedge.plane_shares[0] + wedge.plane_shares[1] + wedge.plane_shares[2];
        CHECK((planes == 0 || planes == 255));
        by_world += planes != 0;
      }
      CHECK((by_world == 0 || by_world == 3));
      if (t == 0) CHECK(by_world == 3);
    }
    for (const auto& [place, seen] : shares) CHECK(seen.size() == 1);
    // The vertices of the rings below and above the border have two pairs of materials each, and so two wedges, also at
    // the seam.
    CHECK(unwrapped.wedges.size() == plain + 2 * (size_t{around} + 1));
  }
}

TEST_CASE("pairs of materials are the same without coordinates, with a wedge for each vertex and pair") {
  const unsigned seed = testSeed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  for (unsigned round = 0; round < rounds(20); ++round) {
    const uint32_t around = static_cast<uint32_t>(3 + random() % 40), rings = static_cast<uint32_t>(2 + random() % 20);
    Tube tube(2000, 5000, around, rings);
    for (MaterialMix& mix : tube.materials)
      for (uint16_t& material : mix) material = static_cast<uint16_t>(random() % 4);
    const Unwrapped with = unwrap(tube.input(), std::pmr::get_default_resource());
    const Unwrapped without = pairMaterials(tube.indices, tube.materials, std::pmr::get_default_resource());
    REQUIRE(without.corners.size() == tube.indices.size());
    std::set<std::pair<uint32_t, std::array<uint16_t, 2>>> places;
    for (size_t i = 0; i < without.corners.size(); ++i) {
      const Wedge &wedge = without.wedges[without.corners[i]], &charted = with.wedges[with.corners[i]];
      CHECK(wedge.vertex == tube.indices[i]);
      CHECK(wedge.materials == charted.materials);
      CHECK(wedge.share == charted.share);
      CHECK((wedge.u == 0 && wedge.v == 0));
      places.insert({wedge.vertex, wedge.materials});
    }
    CHECK(without.wedges.size() == places.size());
  }
  CHECK(pairMaterials({}, {}, std::pmr::get_default_resource()).wedges.empty());
}

TEST_CASE("a mesh without triangles has no wedges and no density") {
  Tube tube(3000, 5000, 24, 6);
  tube.indices.clear();
  const Unwrapped unwrapped = unwrap(tube.input(), std::pmr::get_default_resource());
  CHECK(unwrapped.wedges.empty());
  const TexelDensity density = texelDensity(tube.input(), unwrapped, kUnitsPerMetre);
  CHECK(density.middle == 0);
  CHECK(density.seams == 0);
}

TEST_CASE("far from a shape's origin coordinates are as fine as near it") {
  GrammarChunk chunk;
  Shape shape;
  shape.kind = ShapeKind::box;
  shape.size = {1e9f, 1e9f, 1e9f, 0, 0, 0};
  chunk.shapes.push_back(shape);
  for (const int32_t tile : {kUnitsPerMetre, 64}) {
    CAPTURE(tile);
    const std::vector<TextureSpace> spaces{{Int3{}, tile}, {chunk, 0, tile}};
    // A floor of triangles of 0.1 m, 500 km from the origin.
    constexpr uint32_t kSide = 60;
    std::vector<TexturePoint> positions;
    std::vector<uint32_t> indices;
    for (uint32_t z = 0; z <= kSide; ++z) {
      for (uint32_t x = 0; x <= kSide; ++x) positions.push_back({5.12e8 + 102.25 * x, 1e9, -3.3e8 + 102.25 * z});
    }
    for (uint32_t z = 0; z < kSide; ++z) {
      for (uint32_t x = 0; x < kSide; ++x) {
        const uint32_t a = z * (kSide + 1) + x, c = a + kSide + 1;
        for (const uint32_t corner : {a, c, c + 1, a, c + 1, a + 1}) indices.push_back(corner);
      }
    }
    const std::vector<TexturePoint> normals(positions.size(), TexturePoint{0, 1, 0});
    const std::vector<MaterialMix> materials(positions.size());
    const std::vector<uint32_t> labels(positions.size(), 1);
    const UnwrapInput input{positions, labels,
                            indices,   [&](uint32_t label) -> const TextureSpace& { return spaces[label]; },
                            normals,   materials};
    const Unwrapped unwrapped = unwrap(input, std::pmr::get_default_resource());
    for (const Wedge& wedge : unwrapped.wedges) {
      CHECK(std::fabs(double{wedge.u}) < kTilesKept / 2 + 110);
      CHECK(std::fabs(double{wedge.v}) < kTilesKept / 2 + 110);
    }
    const TexelDensity density = texelDensity(input, unwrapped, tile);
    CHECK(density.low > 0.99);
    CHECK(density.high < 1.01);
    CHECK(density.seams < 0.1);
  }
}
