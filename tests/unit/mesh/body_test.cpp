// Tests bodies of single chunks, and of blocks of chunks of one level.

#include "mesh/body.h"

#include <bit>
#include <cmath>
#include <cstring>
#include <map>
#include <set>

#include "catch.h"
#include "fields.h"
#include "mesh/check.h"
#include "mesh/hash.h"
#include "mesh/tables.h"
#include "mesh/triangulate.h"
#include "mesh/vertex.h"

using namespace sgm;
using namespace sgm::test;

namespace {

MeshPart bodyOf(const LatticeField& field, const ChunkGrid& grid) {
  MeshPart part;
  polygonizeBody(sampleChunk(field, grid), grid, part);
  return part;
}

LatticeField noise(uint64_t seed, double density) {
  return [=](Int3 p, int) { return randomQ(pointHash(seed, p), density); };
}

/// A reference implementation: loops over samples, then over cells, with a map from edge to vertex.
MeshPart referenceBody(const ChunkSamples& s, const ChunkGrid& grid) {
  MeshPart part;
  std::map<std::array<int, 4>, uint32_t> number;
  const auto q = [&](int x, int y, int z) {
    return s.q[static_cast<size_t>(x + kChunkSamples * (y + kChunkSamples * z))];
  };
  for (int z = 0; z < kChunkSamples; ++z) {
    for (int y = 0; y < kChunkSamples; ++y) {
      for (int x = 0; x < kChunkSamples; ++x) {
        for (int axis = 0; axis < 3; ++axis) {
          const int ex = x + (axis == 0), ey = y + (axis == 1), ez = z + (axis == 2);
          if (std::max({ex, ey, ez}) >= kChunkSamples || (q(x, y, z) < 0) == (q(ex, ey, ez) < 0)) continue;
          const double a = std::abs(q(x, y, z)), b = std::abs(q(ex, ey, ez));
          const double t = std::clamp(std::floor(256 * a / (a + b) + 0.5), 1.0, 255.0);
          std::array<int, 3> at{x * kSubcell, y * kSubcell, z * kSubcell};
          at[static_cast<size_t>(axis)] += static_cast<int>(t);
          Vertex v{};
          v.x = static_cast<int16_t>(at[0]);
          v.y = static_cast<int16_t>(at[1]);
          v.z = static_cast<int16_t>(at[2]);
          number[{x, y, z, axis}] = static_cast<uint32_t>(part.vertices.size());
          part.vertices.push_back(v);
          part.keys.push_back(
              {{grid.origin.x + x * grid.cell, grid.origin.y + y * grid.cell, grid.origin.z + z * grid.cell},
               static_cast<uint8_t>(grid.level),
               static_cast<uint8_t>(axis),
               0});
        }
      }
    }
  }
  for (int z = 0; z < kChunkCells; ++z) {
    for (int y = 0; y < kChunkCells; ++y) {
      for (int x = 0; x < kChunkCells; ++x) {
        uint32_t solid = 0;
        for (int c = 0; c < 8; ++c)
          solid |= static_cast<uint32_t>(q(x + (c & 1), y + (c >> 1 & 1), z + (c >> 2)) < 0) << c;
        for (size_t i = kCubeLoopStart[solid]; i < kCubeLoopStart[solid + 1];) {
          const int n = kCubeLoops[i++];
          std::vector<LoopPoint> points;
          for (int k = 0; k < n; ++k) {
            const int e = kCubeLoops[i++], axis = e / 4, first = e & 1, second = e >> 1 & 1;
            std::array<int, 4> owner{x, y, z, axis};
            owner[axis == 0 ? 1 : 0] += first;
            owner[axis == 2 ? 1 : 2] += second;
            const uint32_t vertex = number.at(owner);
            const Vertex& v = part.vertices[vertex];
            points.push_back({v.x, v.y, v.z, chordMask(kCubeEdgeFaces[e], static_cast<uint32_t>(e), n), vertex});
          }
          std::vector<uint32_t> triangles(static_cast<size_t>(3 * (n - 2)));
          triangulateAnyLoop(points.data(), n, triangles.data());
          part.indices.insert(part.indices.end(), triangles.begin(), triangles.end());
        }
      }
    }
  }
  return part;
}

bool sameVertices(const MeshPart& a, const MeshPart& b) {
  return a.vertices.size() == b.vertices.size() &&
         std::memcmp(a.vertices.data(), b.vertices.data(), a.vertices.size() * sizeof(Vertex)) == 0;
}

double signedVolume(const MeshPart& part) {
  double sum = 0;
  for (size_t i = 0; i < part.indices.size(); i += 3) {
    std::array<std::array<double, 3>, 3> p{};
    for (size_t k = 0; k < 3; ++k) {
      const Vertex& v = part.vertices[part.indices[i + k]];
      p[k] = {v.x / 256.0, v.y / 256.0, v.z / 256.0};
    }
    sum += p[0][0] * (p[1][1] * p[2][2] - p[1][2] * p[2][1]) - p[0][1] * (p[1][0] * p[2][2] - p[1][2] * p[2][0]) +
           p[0][2] * (p[1][0] * p[2][1] - p[1][1] * p[2][0]);
  }
  return sum / 6;
}

}  // namespace

TEST_CASE("a body equals the plain algorithm, order and bits", "[mesh][body]") {
  MeshPart part;
  for (const double density : {0.02, 0.5, 0.9, 0.999}) {
    for (int level : {0, 2}) {
      const ChunkGrid grid = latticeChunk({-128, 0, 256}, level);
      const ChunkSamples samples = sampleChunk(noise(static_cast<uint64_t>(density * 1000), density), grid);
      const MeshPart expected = referenceBody(samples, grid);
      polygonizeBody(samples, grid, part);  // the same `part` is reused for all densities and levels
      INFO("density " << density << ", level " << level);
      CHECK(sameVertices(part, expected));
      CHECK((part.keys == expected.keys));
      CHECK((part.indices == expected.indices));
    }
  }
}

TEST_CASE("uniform chunks make nothing", "[mesh][body]") {
  for (const int32_t q : {-kMaxQ, -1, 0, kMaxQ}) {
    const MeshPart part = bodyOf([q](Int3, int) { return q; }, latticeChunk({}, 0));
    CHECK(part.vertices.empty());
    CHECK(part.indices.empty());
    CHECK(part.keys.empty());
  }
}

TEST_CASE("a vertex lies within its edge, by the ends' values in axis order", "[mesh][body]") {
  CHECK(crossing(-1, 1) == 128);
  CHECK(crossing(0, -1) == 1);
  CHECK(crossing(-1, 0) == 255);
  CHECK(crossing(-kMaxQ, kMaxQ) == 128);
  CHECK(crossing(kMaxQ, -1) == 255);
  CHECK(crossing(1, -511) == 1);  // 0.5 is rounded up
  CHECK(crossing(3, -509) == 2);  // 1.5 is rounded up
  // 254.5 is rounded up as well: halves are rounded towards the high end of the axis, whichever end is solid.
  CHECK(crossing(509, -3) == 255);
  size_t bad = 0;
  for (uint64_t i = 0; i < 100000; ++i) {
    const int shift = static_cast<int>(i % 22);
    const auto a = static_cast<int32_t>(hashCombine(1, i) & (kMaxQ - 1)) >> shift;
    const auto b = -1 - (static_cast<int32_t>(hashCombine(2, i) & (kMaxQ - 1)) >> (21 - shift));
    const double exact = 256.0 * a / (static_cast<double>(a) - b);
    bad += crossing(a, b) != static_cast<uint32_t>(std::clamp(std::floor(exact + 0.5), 1.0, 255.0));
  }
  CHECK(bad == 0);
}

TEST_CASE("a ball is closed, faces the void and has about its volume", "[mesh][body]") {
  const MeshPart ball = bodyOf(
      [](Int3 p, int) {
        const double d = std::sqrt((p.x - 16) * (p.x - 16) + (p.y - 16) * (p.y - 16) + (p.z - 16) * (p.z - 16)) - 11.3;
        return static_cast<int32_t>(std::floor(d * 1024 + 0.5));
      },
      latticeChunk({}, 0));
  const MeshPart* parts[] = {&ball};
  const MeshReport report = checkParts(parts);
  CHECK(report.closed());
  CHECK(report.vertices + report.triangles - report.edges == 2);
  CHECK(std::fabs(signedVolume(ball) / (4.18879 * 11.3 * 11.3 * 11.3) - 1) < 0.01);
  for (const Vertex& v : ball.vertices) {
    const SampleEdge edge = edgeOfBodyVertex(v);
    const std::array<int16_t, 3> at{v.x, v.y, v.z};
    REQUIRE(at[static_cast<size_t>(edge.axis)] % 256 != 0);
    REQUIRE(edge.sample() < size_t{kChunkSamples} * kChunkSamples * kChunkSamples);
  }
}

TEST_CASE("random signs over several chunks: closed, manifold, borders equal to the bit", "[mesh][body]") {
  for (const double density : {0.1, 0.5, 0.9}) {
    const LatticeField field = [&](Int3 p, int) -> int32_t {
      const auto outside = [](int32_t x) { return x <= -32 || x >= 32; };
      return outside(p.x) || outside(p.y) || outside(p.z) ? 9 : randomQ(pointHash(5, p), density);
    };
    std::vector<MeshPart> parts;
    std::vector<const MeshPart*> pointers;
    for (int i = 0; i < 8; ++i)
      parts.push_back(bodyOf(field, latticeChunk({(i & 1) * 32 - 32, (i >> 1 & 1) * 32 - 32, (i >> 2) * 32 - 32}, 0)));
    for (const MeshPart& part : parts) pointers.push_back(&part);
    const MeshReport report = checkParts(pointers);
    INFO(density << ": " << describe(report));
    CHECK(report.closed());
    CHECK(report.triangles > 100000);

    // Chunks 0 and 1 meet at x = 0: vertices there have the same keys and places in both.
    std::map<VertexKey, std::pair<uint16_t, uint16_t>> low, high;
    for (size_t i = 0; i < parts[0].vertices.size(); ++i)
      if (const Vertex& v = parts[0].vertices[i]; v.x == kChunkCells * kSubcell) low[parts[0].keys[i]] = {v.y, v.z};
    for (size_t i = 0; i < parts[1].vertices.size(); ++i)
      if (const Vertex& v = parts[1].vertices[i]; v.x == 0) high[parts[1].keys[i]] = {v.y, v.z};
    CHECK((low == high));
    CHECK(low.size() > 100);
  }
}

TEST_CASE("q is read at the ends of crossed edges only", "[mesh][body]") {
  const ChunkGrid grid = latticeChunk({}, 0);
  ChunkSamples samples = sampleChunk(noise(11, 0.01), grid);
  MeshPart plain, spoiled;
  polygonizeBody(samples, grid, plain);
  std::set<size_t> ends;
  constexpr std::array<size_t, 3> kStep{1, kChunkSamples, size_t{kChunkSamples} * kChunkSamples};
  for (const Vertex& v : plain.vertices) {
    const SampleEdge edge = edgeOfBodyVertex(v);
    ends.insert({edge.sample(), edge.sample() + kStep[static_cast<size_t>(edge.axis)]});
  }
  for (size_t i = 0; i < samples.q.size(); ++i)
    if (ends.count(i) == 0) samples.q[i] = std::numeric_limits<int32_t>::min();
  polygonizeBody(samples, grid, spoiled);
  CHECK(sameVertices(plain, spoiled));
  CHECK((plain.indices == spoiled.indices));
}

TEST_CASE("the content hash is a sum over places, and shows every change of a word", "[mesh][hash]") {
  MeshPart part = bodyOf(noise(3, 0.3), latticeChunk({}, 0));
  hashPart(part);
  const ContentHash hash = part.hash;

  ContentHash backwards;
  const auto* words = reinterpret_cast<const uint32_t*>(part.vertices.data());
  for (size_t i = part.vertices.size() * 4; i-- > 0;) addWord(backwards, words[i], static_cast<uint32_t>(i));
  for (size_t i = part.indices.size(); i-- > 0;)
    addWord(backwards, part.indices[i], (1u << 31) + static_cast<uint32_t>(i));
  CHECK(backwards == hash);

  const auto changed = [&](auto&& change) {
    MeshPart other = part;
    change(other);
    hashPart(other);
    return other.hash.a != hash.a && other.hash.b != hash.b;
  };
  CHECK(changed([](MeshPart& p) { p.vertices[7].normal_y = 1; }));
  CHECK(changed([](MeshPart& p) { p.vertices[9].tag = 4; }));
  CHECK(changed([](MeshPart& p) { p.vertices[9].kind = kLateralEdge; }));
  CHECK(changed([](MeshPart& p) {
    std::swap(p.indices[3], p.indices[4]);
    p.indices[3] += 1;
  }));
  CHECK(changed([](MeshPart& p) { p.indices.pop_back(); }));
  MeshPart swapped = part;
  std::swap(swapped.vertices[0], swapped.vertices[1]);
  hashPart(swapped);
  CHECK(swapped.hash != hash);
  part.keys.clear();
  hashPart(part);
  CHECK(part.hash == hash);
  MeshPart empty;
  hashPart(empty);
  CHECK(empty.hash == ContentHash{});
}

TEST_CASE("content hashes have golden values", "[mesh][hash]") {
  MeshPart body = bodyOf(noise(42, 0.2), latticeChunk({64, -32, 0}, 1));
  hashPart(body);
  CHECK(body.vertices.size() == 33738);
  CHECK(body.indices.size() == 156144);
  CHECK(body.hash.value() == 0xa078d7a0ff3f2692u);
}
