// Tests surface loops of single cells at a face of the chunk, and the fans (cones) over loops that have face vertices
// there.

#include <algorithm>
#include <map>
#include <random>

#include "catch.h"
#include "mesh/body.h"
#include "mesh/cell_loops.h"
#include "mesh/fan_triangles.h"
#include "mesh/sharp_loops.h"
#include "rounds.h"

using namespace sgm;

namespace {

constexpr ChunkGrid kGrid{{0, 0, 0}, 256, 0};

int anyOf(std::mt19937& random, int count) { return static_cast<int>(random() % static_cast<uint32_t>(count)); }

size_t sampleAt(const Int3& p) { return static_cast<size_t>(p.x + kChunkSamples * (p.y + kChunkSamples * p.z)); }

std::array<int32_t, 8> cornersOf(const ChunkSamples& samples, const Int3& cell) {
  std::array<int32_t, 8> q{};
  for (int c = 0; c < 8; ++c)
    q[static_cast<size_t>(c)] = samples.q[sampleAt({cell.x + (c & 1), cell.y + (c >> 1 & 1), cell.z + (c >> 2)})];
  return q;
}

std::vector<VertexKey> keysOf(const MeshPart& part, const SurfaceLoop& loop) {
  std::vector<VertexKey> keys;
  for (uint32_t i = 0; i < loop.count; ++i) keys.push_back(part.keys[loop.vertices[i]]);
  for (uint32_t i = loop.first_index; i < loop.end_index; ++i) keys.push_back(part.keys[part.indices[i]]);
  return keys;
}

std::array<int32_t, 8> randomCell(std::mt19937& random) {
  std::array<int32_t, 8> q{};
  for (int32_t& value : q)
    value = (anyOf(random, 2) == 0 ? 1 : -1) * (1 + anyOf(random, anyOf(random, 3) == 0 ? 3 : 1000));
  return q;
}

/// A side (the segment between two consecutive vertices) of a cell's loop. It lies in one of the cell's low faces, and
/// the loop has no other side in that face. If the face lies in a face of the chunk, the side may have a face vertex.
struct LowSide {
  uint32_t behind;
  int axis;
};

std::vector<LowSide> lowSidesOf(const MeshPart& part, const SurfaceLoop& loop) {
  std::array<int, 3> count{};
  std::vector<LowSide> all, once;
  for (uint32_t i = 0; i < loop.count; ++i) {
    const SharpSide side = sideBetween(loop.vertices[i], loop.vertices[(i + 1) % loop.count], part.keys);
    if (side.corner[side.axis] != loop.cell[side.axis] * kGrid.cell) continue;
    all.push_back({i, side.axis});
    ++count[static_cast<size_t>(side.axis)];
  }
  std::copy_if(all.begin(), all.end(), std::back_inserter(once),
               [&](const LowSide& side) { return count[static_cast<size_t>(side.axis)] == 1; });
  return once;
}

/// Takes the edge of a low face at the high or low end of the axis `across`. Returns whether both corners of this edge
/// are on the same side of the surface; then a face vertex may lie beyond the edge.
bool isUncut(const std::array<int32_t, 8>& q, int axis, int across, bool high) {
  const int along = 3 - axis - across;
  const size_t from = high ? size_t{1} << across : 0, to = from | size_t{1} << along;
  return (q[from] < 0) == (q[to] < 0);
}

}  // namespace

TEST_CASE("single cells have the loops that a body has", "[mesh][sharpen]") {
  for (unsigned seed = 1; seed <= rounds(5); ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    ChunkSamples samples;
    for (size_t i = 0; i < samples.q.size(); ++i) {
      samples.q[i] = (anyOf(random, 2) == 0 ? 1 : -1) * anyOf(random, 1000);
      const size_t row = i / kChunkSamples;
      samples.signs[row] |= uint64_t{samples.q[i] < 0} << i % kChunkSamples;
    }
    MeshPart body;
    polygonizeBody(samples, kGrid, body);
    const BodyLoops loops(kGrid, body, std::pmr::get_default_resource());
    size_t next = 0, wrong = 0;
    for (int32_t z = 0; z < kChunkCells; ++z) {
      for (int32_t y = 0; y < kChunkCells; ++y) {
        for (int32_t x = 0; x < kChunkCells; ++x) {
          MeshPart part;
          std::pmr::vector<SurfaceLoop> alone;
          addCellLoops(kGrid, {x, y, z}, cornersOf(samples, {x, y, z}), part, alone);
          for (const SurfaceLoop& loop : alone) {
            REQUIRE(next < loops.all().size());
            const SurfaceLoop& of_body = loops.all()[next++];
            auto theirs = keysOf(body, of_body), ours = keysOf(part, loop);
            // The same loop of the body may start at a different vertex.
            const auto start = std::find(ours.begin(), ours.begin() + loop.count, theirs.front());
            std::rotate(ours.begin(), start, ours.begin() + loop.count);
            wrong += ours != theirs || of_body.cell != loop.cell;
          }
        }
      }
    }
    CHECK(next == loops.all().size());
    CHECK(next > 20000);
    CHECK(wrong == 0);
  }
}

TEST_CASE("rounded loops with face vertices at the border are valid", "[mesh][sharpen]") {
  size_t cones = 0, beyond = 0, twice = 0;
  for (unsigned round = 0; round < rounds(30000); ++round) {
    std::mt19937 random(round);
    const std::array<int32_t, 8> q = randomCell(random);
    MeshPart part;
    std::pmr::vector<SurfaceLoop> loops;
    const Int3 cell{anyOf(random, 3), anyOf(random, 3), anyOf(random, 3)};
    addCellLoops(kGrid, cell, q, part, loops);
    if (loops.size() != 1) continue;
    const SurfaceLoop& loop = loops.front();
    std::map<uint32_t, std::vector<BorderVertex>> middles;
    std::vector<BorderVertex> at_border;
    for (const LowSide& side : lowSidesOf(part, loop)) {
      if (anyOf(random, 3) == 0) continue;
      const int across = (side.axis + 1 + anyOf(random, 2)) % 3, along = 3 - side.axis - across;
      Int3 place;
      place[across] = 1 + anyOf(random, kSubcell - 1);
      place[along] = 1 + anyOf(random, kSubcell - 1);
      const bool high = anyOf(random, 2) == 0;
      // Feature vertices may lie outside their cell, but not outside the chunk. These cells touch only low faces of the
      // chunk, so vertices may lie only beyond high faces of their cells.
      if (anyOf(random, 2) == 0 && high && isUncut(q, side.axis, across, high)) {
        place[across] = kSubcell + 9 + anyOf(random, kMaxOutside - 8);
        ++beyond;
      }
      for (int k = 0; k < 3; ++k) place[k] += cell[k] * kSubcell;
      std::vector<BorderVertex>& own = middles[side.behind];
      own.push_back({place, side.axis});
      // A second vertex is added if the path along the side through both vertices does not turn back.
      const Int3 from = placeOf(part, loop.vertices[side.behind]),
                 to = placeOf(part, loop.vertices[(side.behind + 1) % loop.count]);
      const auto along_side = [&](const Int3& p) {
        int64_t sum = 0;
        for (int k = 0; k < 3; ++k) sum += int64_t{p[k]} * (to[k] - from[k]);
        return sum;
      };
      Int3 second = place;
      second[across] = cell[across] * kSubcell + 1 + anyOf(random, kSubcell - 1);
      second[along] = cell[along] * kSubcell + 1 + anyOf(random, kSubcell - 1);
      const auto lies_within = [&](const Int3& p) {
        return along_side(from) < along_side(p) && along_side(p) < along_side(to);
      };
      if (anyOf(random, 2) == 0 && lies_within(place) && lies_within(second) &&
          along_side(place) != along_side(second)) {
        own.push_back({second, side.axis});
        if (along_side(second) < along_side(place)) std::swap(own[0], own[1]);
        ++twice;
      }
      at_border.insert(at_border.end(), own.begin(), own.end());
    }
    if (at_border.empty()) continue;
    std::vector<Int3> ring;
    for (uint32_t i = 0; i < loop.count; ++i) ring.push_back(placeOf(part, loop.vertices[i]));
    const Int3 centre = roundedCentre(cell, ring, at_border);
    std::vector<FanPoint> points;
    for (uint32_t i = 0; i < loop.count; ++i) {
      points.push_back({ring[i], loop.vertices[i]});
      for (uint32_t k = 0; k < middles[i].size(); ++k)
        points.push_back({middles[i][k].at, kFaceVertices + 2 * i + k, true});
    }
    const LoopTriangles fan = coneTriangles({centre, kCellVertices, true}, points, true);
    REQUIRE(fan.count() == points.size());
    ++cones;
    size_t faults = 0;
    for (size_t i = 0; i < fan.all().size(); ++i) {
      faults += !fan.all()[i].hasArea();
      for (size_t j = i + 1; j < fan.all().size(); ++j) faults += fan.all()[i].meets(fan.all()[j]);
    }
    CAPTURE(round);
    CHECK(faults == 0);
    for (int k = 0; k < 3; ++k) {
      CHECK(centre[k] > cell[k] * kSubcell);
      CHECK(centre[k] < (cell[k] + 1) * kSubcell);
    }
  }
  CHECK(cones * 10 > rounds(30000));
  CHECK(beyond * 100 > rounds(30000));
  CHECK(twice * 100 > rounds(30000));
}
