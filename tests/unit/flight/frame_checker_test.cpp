// Tests the frame checker: it finds every fault of a frame, none in a valid frame, and its running counts stay correct.

#include "tools/flight/frame_checker.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <random>

#include "drawn_world.h"
#include "rounds.h"
#include "world/world_support.h"

using namespace sgm;
using cli::DrawnParts;
using cli::FrameChecker;
using cli::FrameReport;
using cli::WholeReport;

namespace {

void drawAll(FrameChecker& checker, MeshedWorld& world, const Drawing& drawing) {
  world.want(drawing);
  for (const auto& [key, parts] : drawing) REQUIRE(checker.draw(world.view(key), parts));
}

/// Checks that the incremental counts equal those of a complete check.
WholeReport agreed(const FrameChecker& checker) {
  const WholeReport whole = checker.checkWhole();
  INFO(describe(whole.mesh));
  CHECK(whole.frame.chunks == checker.check().chunks);
  CHECK(whole.frame.triangles == checker.check().triangles);
  CHECK(whole.frame.edges == checker.check().edges);
  CHECK(whole.frame.open_edges == checker.check().open_edges);
  CHECK(whole.frame.nonmanifold_edges == checker.check().nonmanifold_edges);
  CHECK(whole.frame.overlaps == checker.check().overlaps);
  CHECK(whole.frame == checker.check());
  return whole;
}

}  // namespace

TEST_CASE("what an octree draws is closed, and stays so as octrees follow each other") {
  for (const char* grammar : {kClosedWorlds[0], kClosedWorlds[1], kBoxWorld}) {
    MeshedWorld world(grammar, grammar == kBoxWorld ? SGM_MESHING_SHARP : 0);
    FrameChecker checker;
    Drawing drawn;
    uint64_t triangles = 0, redrawn = 0, half_done = 0;
    for (uint32_t seed = 1; seed <= std::max(rounds(4), 4u); ++seed) {
      CAPTURE(grammar, seed);
      std::mt19937 random(seed);
      const Drawing next = drawingOf(randomTree(random));
      world.want(next);
      // Chunks are changed one by one in random order; the surface need not be closed before the last change.
      std::vector<ChunkKey> changes;
      for (const auto& [key, parts] : drawn)
        if (next.count(key) == 0) changes.push_back(key);
      for (const auto& [key, parts] : next)
        if (drawn.count(key) == 0 || !(drawn.at(key) == parts)) changes.push_back(key);
      std::shuffle(changes.begin(), changes.end(), random);
      for (size_t i = 0; i < changes.size(); ++i) {
        const auto to = next.find(changes[i]);
        if (to == next.end()) {
          REQUIRE(checker.erase(publicKey(changes[i])));
        } else if (drawn.count(changes[i]) != 0 && random() % 4 != 0) {
          REQUIRE(checker.redraw(publicKey(changes[i]), to->second));
          ++redrawn;
        } else {
          REQUIRE(checker.draw(world.view(changes[i]), to->second));
        }
        if (i == changes.size() / 2) half_done += agreed(checker).frame.closed() ? 0u : 1u;
      }
      drawn = next;
      const WholeReport whole = agreed(checker);
      CHECK(whole.mesh.closed());
      CHECK(whole.valid());
      CHECK(checker.check().valid());
      CHECK(checker.check().chunks == next.size());
      triangles += checker.check().triangles;
    }
    CHECK(triangles > 10000);
    CHECK(redrawn > 10);
    CHECK(half_done > 1);
    for (const auto& [key, parts] : drawn) CHECK(checker.erase(publicKey(key)));
    CHECK(checker.check() == FrameReport{});
  }
}

TEST_CASE("a seam that is missing shows as open edges, until it is drawn") {
  MeshedWorld world(kClosedWorlds[1]);
  std::mt19937 random(3);
  const Drawing drawing = drawingOf(randomTree(random));
  FrameChecker checker;
  drawAll(checker, world, drawing);
  REQUIRE(checker.check().closed());
  int left_out = 0;
  for (const auto& [key, parts] : drawing) {
    const sgm_mesh_view view = world.view(key);
    for (uint32_t face = 0; face < 6; ++face) {
      if ((parts.seams >> face & 1) == 0 || view.seams[face].index_count == 0 || left_out == 12) continue;
      CAPTURE(key.level, key.at.x, key.at.y, key.at.z, face);
      REQUIRE(checker.redraw(view.key, {parts.seams & ~(1u << face), parts.coarser}));
      CHECK(checker.check().open_edges > 0);
      agreed(checker);
      REQUIRE(checker.redraw(view.key, parts));
      CHECK(checker.check().closed());
      ++left_out;
    }
  }
  CHECK(left_out == 12);
}

TEST_CASE("a seam too many is open too") {
  MeshedWorld world(kClosedWorlds[0]);
  std::mt19937 random(5);
  const Drawing drawing = drawingOf(randomTree(random));
  FrameChecker checker;
  drawAll(checker, world, drawing);
  for (const auto& [key, parts] : drawing) {
    const sgm_mesh_view view = world.view(key);
    for (uint32_t face = 0; face < 6; ++face) {
      if ((parts.seams >> face & 1) != 0 || view.seams[face].index_count == 0) continue;
      REQUIRE(checker.redraw(view.key, {parts.seams | 1u << face, parts.coarser}));
      CHECK_FALSE(checker.check().closed());
      agreed(checker);
      REQUIRE(checker.redraw(view.key, parts));
      CHECK(checker.check().closed());
      return;
    }
  }
  FAIL("no chunk has such a seam");
}

TEST_CASE("a chunk that is drawn inside another one is seen, whichever came first") {
  MeshedWorld world(kClosedWorlds[0]);
  std::mt19937 random(4);
  const Octree tree = randomTree(random);
  const Drawing drawing = drawingOf(tree);
  FrameChecker checker;
  drawAll(checker, world, drawing);
  int tried = 0;
  for (const ChunkKey& node : tree.splitNodes()) {
    if (node.level > kTop) continue;
    const auto inside = static_cast<uint64_t>(
        std::count_if(drawing.begin(), drawing.end(), [&](const auto& leaf) { return holds(node, leaf.first); }));
    const Drawing over{{node, {}}};
    world.want(over);
    REQUIRE(checker.draw(world.view(node), {}));
    CHECK(checker.check().overlaps == inside);
    agreed(checker);
    const auto& [leaf, parts] =
        *std::find_if(drawing.begin(), drawing.end(), [&](const auto& drawn) { return holds(node, drawn.first); });
    // Draws the leaf again. It lies inside the coarser node, which was drawn after the leaf.
    REQUIRE(checker.draw(world.view(leaf), parts));
    CHECK(checker.check().overlaps == inside);
    REQUIRE(checker.erase(publicKey(node)));
    CHECK(checker.check().overlaps == 0);
    CHECK(checker.check().closed());
    ++tried;
  }
  CHECK(tried > 0);
}

TEST_CASE("wrong blocks around a chunk are seen, as open edges") {
  MeshedWorld world(kClosedWorlds[1]);
  std::mt19937 random(1);
  int open = 0, tried = 0;
  for (int round = 0; round < 2; ++round) {
    const Drawing drawing = drawingOf(randomTree(random));
    FrameChecker checker;
    drawAll(checker, world, drawing);
    for (const auto& [key, parts] : drawing) {
      if (parts.seams == 0 || world.view(key).index_count == 0 || random() % 4 != 0) continue;
      for (const Neighbourhood wrong : {Neighbourhood{0}, (1u << 27) - 1}) {
        REQUIRE(checker.redraw(publicKey(key), {parts.seams, wrong}));
        agreed(checker);
        open += checker.check().open_edges > 0;
        ++tried;
      }
      REQUIRE(checker.redraw(publicKey(key), parts));
    }
    CHECK(agreed(checker).closed());
  }
  CHECK(tried > 10);
  CHECK(open > 0);
}

TEST_CASE("wrong blocks that join two surfaces in a point are seen in that vertex") {
  // A pebble around the common corner of eight chunks, visible only at level 0. Two diagonally opposite chunks have
  // this level, and each closes its own eighth of the pebble.
  MeshedWorld world(
      "sgm 1;\nunits m;\ndomain finite box(120m, 120m, 120m) empty;\nstart Pebble;\n"
      "rule Pebble { detail 0.3m { sphere(1m); } }\n");
  Octree tree(kTop, kFinestCell);
  tree.split({1, {0, 0, 0}});
  tree.split({1, {-1, -1, -1}});
  refineToRules(tree);
  const Drawing drawing = drawingOf(tree);
  const ChunkKey upper{0, {0, 0, 0}};
  FrameChecker checker;
  drawAll(checker, world, drawing);
  CHECK(checker.checkWhole().closed());
  CHECK(checker.check().triangles > 100);
  // The wrong flags claim that the chunks across the lower edges are fine, and that the chunk across the lower corner
  // is coarse. The vertex in this corner then gets the key of another vertex.
  DrawnParts wrong = drawing.at(upper);
  wrong.coarser &= ~(neighbourBit(0, -1, -1) | neighbourBit(-1, 0, -1) | neighbourBit(-1, -1, 0));
  wrong.coarser |= neighbourBit(-1, -1, -1);
  REQUIRE(checker.redraw(publicKey(upper), wrong));
  CHECK(checker.check().closed());
  const WholeReport whole = agreed(checker);
  CHECK(whole.mesh.pinched_vertices == 1);
  CHECK_FALSE(whole.closed());
}

TEST_CASE("keys follow from packed vertices and the blocks around") {
  const bool sharp = GENERATE(false, true);
  CAPTURE(sharp);
  const char* grammar = sharp ? kBoxWorld : kClosedWorlds[1];
  std::mt19937 random(9);
  std::vector<ChunkRequest> requests = frameRequests(randomTree(random));
  for (ChunkRequest& request : requests) request.sharp = sharp;
  const WorldField field(settingsOf(grammar, kFinestCell), std::pmr::get_default_resource());
  const std::pmr::vector<PlacedChunk> chunks = meshAll(field, requests, 2);
  MeshedWorld world(grammar, sharp ? SGM_MESHING_SHARP : 0);
  std::array<size_t, 4> kinds{};
  size_t fans = 0, wrong = 0;
  for (size_t i = 0; i < requests.size(); ++i) {
    const ChunkRequest& request = requests[i];
    world.want({{request.key, {request.seams, request.coarser}}});
    const sgm_mesh_view view = world.view(request.key);
    for (int face = -1; face < 6; ++face) {
      if (face >= 0 && (request.seams >> face & 1) == 0) continue;
      const sgm_mesh_range& range = face < 0 ? view.body : view.seams[face];
      const MeshPart& part = face < 0 ? chunks[i].mesh.body : chunks[i].mesh.seams[static_cast<size_t>(face)];
      // Skips a seam that was meshed for a different set of coarser neighbours.
      if (request.outermost && part.keys.size() != range.vertex_count) continue;
      REQUIRE(part.keys.size() == range.vertex_count);
      cli::SeamOf seam;
      if (face >= 0) seam = {static_cast<Face>(face), seamFans(static_cast<Face>(face), request.coarser)};
      for (uint32_t v = 0; v < range.vertex_count; ++v) {
        const sgm_vertex& vertex = view.vertices[range.first_vertex + v];
        const std::optional<VertexKey> key =
            cli::vertexKey(chunks[i].grid, {vertex.x, vertex.y, vertex.z, vertex.kind}, face < 0 ? nullptr : &seam);
        wrong += !key || *key != part.keys[v];
        ++kinds[(vertex.kind & SGM_VERTEX_FEATURE) != 0 ? 3 : vertex.kind];
        fans += key && key->fan != 0;
      }
    }
  }
  CHECK(wrong == 0);
  if (sharp) {
    CHECK(std::min({kinds[0], kinds[1], kinds[3]}) > 10);
  } else {
    CHECK(std::min({kinds[0], kinds[1], kinds[2]}) > 10);
    CHECK(fans > 0);
  }
}

TEST_CASE("a mesh that is not well formed is refused, and changes nothing") {
  MeshedWorld world(kClosedWorlds[0]);
  std::mt19937 random(2);
  const Drawing drawing = drawingOf(randomTree(random));
  FrameChecker checker;
  drawAll(checker, world, drawing);
  const FrameReport before = checker.check();
  const auto whole = std::find_if(drawing.begin(), drawing.end(),
                                  [&](const auto& drawn) { return world.view(drawn.first).body.index_count > 0; });
  REQUIRE(whole != drawing.end());
  const sgm_mesh_view view = world.view(whole->first);
  const std::vector<sgm_vertex> vertices(view.vertices, view.vertices + view.vertex_count);
  const std::vector<uint32_t> indices(view.indices, view.indices + view.index_count);
  const auto refused = [&](auto&& spoil) {
    std::vector<sgm_vertex> other_vertices = vertices;
    std::vector<uint32_t> other_indices = indices;
    sgm_mesh_view other = view;
    spoil(other, other_vertices, other_indices);
    other.vertices = other_vertices.data();
    other.indices = other_indices.data();
    const Result<void> drawn = checker.draw(other, whole->second);
    return !drawn && drawn.error().code == Code::invalid_argument && checker.check() == before;
  };
  CHECK(refused([](auto&, auto& v, auto&) { v[0].x = v[0].y = v[0].z = 256; }));
  CHECK(refused([](auto&, auto& v, auto&) { v[0].x = v[0].y = 100; }));
  CHECK(refused([](auto&, auto& v, auto&) { v[0].x = 8300; }));
  CHECK(refused([](auto&, auto& v, auto&) { v[0].kind = SGM_VERTEX_COARSER; }));
  CHECK(refused([](auto&, auto& v, auto&) { v[0].kind = 3; }));
  CHECK(refused([](auto&, auto& v, auto&) { v[0].x = -1; }));
  // Feature vertices that a body must not have: one of the next coarser level, and one of a cell outside the chunk.
  CHECK(refused([](auto&, auto& v, auto&) { v[0].kind = SGM_VERTEX_FEATURE | 1 << 13 | 0x15; }));
  CHECK(refused([](auto&, auto& v, auto&) { v[0].kind = SGM_VERTEX_FEATURE | 1 << 14 | 0x15, v[0].x = -200; }));
  CHECK(refused([](auto& m, auto&, auto& i) { i[0] = m.body.vertex_count; }));
  CHECK(refused([](auto& m, auto&, auto&) { m.body.index_count -= 1; }));
  CHECK(refused([](auto& m, auto&, auto&) { m.vertex_count = m.body.vertex_count - 1; }));
  CHECK(refused([](auto& m, auto&, auto&) { m.key.level = 17; }));
  CHECK_FALSE(checker.redraw({0, 1000, 0, 0}, {}));
  CHECK_FALSE(checker.erase({0, 1000, 0, 0}));
}

TEST_CASE("an edge that three triangles use, and a triangle with a vertex twice, are seen") {
  MeshedWorld world(kClosedWorlds[0]);
  const Drawing drawing{{{kTop, {0, 0, 0}}, {}}};
  world.want(drawing);
  const sgm_mesh_view view = world.view({kTop, {0, 0, 0}});
  REQUIRE(view.body.index_count > 300);
  for (const uint32_t at : {0u, 150u, 297u}) {
    std::vector<uint32_t> indices(view.indices, view.indices + view.body.index_count);
    sgm_mesh_view other = view;
    for (sgm_mesh_range& seam : other.seams) seam = SGM_MESH_RANGE_INIT;
    FrameChecker checker;
    other.indices = indices.data();
    REQUIRE(checker.draw(other, {}));
    const FrameReport plain = checker.check();
    CHECK(plain.nonmanifold_edges + plain.degenerate_triangles == 0);
    indices.insert(indices.end(), {indices[at], indices[at + 1], indices[at + 2]});
    indices.insert(indices.end(), {indices[at], indices[at + 1], indices[at]});
    other.indices = indices.data();
    other.index_count = other.body.index_count = static_cast<uint32_t>(indices.size());
    REQUIRE(checker.draw(other, {}));
    CHECK(checker.check().nonmanifold_edges == 3);
    CHECK(checker.check().degenerate_triangles == 1);
    agreed(checker);
  }
}

TEST_CASE("triangles with two corners in one place, flat, folded and cutting ones are seen, and go again") {
  MeshedWorld world(kClosedWorlds[0]);
  std::mt19937 random(4);
  const Drawing drawing = drawingOf(randomTree(random));
  world.want(drawing);
  const auto full = std::find_if(drawing.begin(), drawing.end(),
                                 [&](const auto& c) { return world.view(c.first).body.index_count > 300; });
  REQUIRE(full != drawing.end());
  const sgm_mesh_view view = world.view(full->first);
  sgm_mesh_view other = view;
  for (sgm_mesh_range& seam : other.seams) seam = SGM_MESH_RANGE_INIT;
  FrameChecker checker;
  REQUIRE(checker.draw(other, {}));
  const FrameReport plain = checker.check();
  CHECK(plain.degenerate_triangles + plain.flat_triangles + plain.folded_triangles + plain.self_intersections == 0);
  // Two triangles of feature vertices, which may lie anywhere around their cell; the triangles share an edge.
  const auto corner = [](int x, int y, int z, uint16_t fan) {
    sgm_vertex v{};
    v.x = static_cast<int16_t>(2048 + x), v.y = static_cast<int16_t>(2048 + y), v.z = static_cast<int16_t>(2048 + z);
    v.kind = static_cast<uint16_t>(SGM_VERTEX_FEATURE | 1 << 14 | fan << 6 | 21);
    return v;
  };
  const auto with = [&](std::array<sgm_vertex, 6> more) {
    std::vector<sgm_vertex> vertices(view.vertices, view.vertices + view.vertex_count);
    std::vector<uint32_t> indices(view.indices, view.indices + view.body.index_count);
    // Appends the vertices after the body's vertices, in place of those of the seams.
    vertices.resize(view.body.first_vertex + view.body.vertex_count);
    for (const sgm_vertex& v : more) {
      indices.push_back(static_cast<uint32_t>(vertices.size()));
      vertices.push_back(v);
    }
    other.vertices = vertices.data();
    other.indices = indices.data();
    other.vertex_count = static_cast<uint32_t>(vertices.size());
    other.body.vertex_count = other.vertex_count - other.body.first_vertex;
    other.index_count = other.body.index_count = static_cast<uint32_t>(indices.size());
    REQUIRE(checker.draw(other, {}));
    agreed(checker);
    return checker.check();
  };
  const sgm_vertex a = corner(10, 10, 10, 0), b = corner(90, 10, 10, 1), c = corner(10, 90, 10, 2);
  const auto counts = [](const FrameReport& r) {
    return std::array<uint64_t, 4>{r.degenerate_triangles, r.flat_triangles, r.folded_triangles, r.self_intersections};
  };
  using Counts = std::array<uint64_t, 4>;
  CHECK(counts(with({a, b, c, b, a, corner(20, 20, 60, 3)})) == Counts{0, 0, 0, 0});
  CHECK(counts(with({a, b, corner(90, 10, 10, 4), b, a, c})) == Counts{1, 0, 0, 0});
  CHECK(counts(with({a, b, corner(50, 10, 10, 4), b, a, c})) == Counts{0, 1, 0, 0});
  CHECK(counts(with({a, b, c, b, a, corner(20, 20, 10, 4)})) == Counts{0, 0, 1, 0});
  CHECK(counts(with({a, b, c, a, corner(40, 40, 0, 4), corner(40, 40, 30, 5)})) == Counts{0, 0, 0, 1});
  CHECK_FALSE(checker.check().valid());
  CHECK(checker.erase(view.key));
  CHECK(checker.check() == FrameReport{});
}

TEST_CASE("parts that go through each other are seen when all is checked") {
  MeshedWorld world(kClosedWorlds[0]);
  std::mt19937 random(4);
  const Drawing drawing = drawingOf(randomTree(random));
  FrameChecker checker;
  drawAll(checker, world, drawing);
  CHECK(checker.checkWhole().between_parts == 0);
  // A chunk of another level at the same place.
  const auto coarse = std::find_if(drawing.begin(), drawing.end(), [&](const auto& chunk) {
    return chunk.first.level > 0 && world.view(chunk.first).body.index_count > 300;
  });
  REQUIRE(coarse != drawing.end());
  const Drawing finer{
      {childOf(coarse->first, 0), {}}, {childOf(coarse->first, 5), {}}, {childOf(coarse->first, 7), {}}};
  drawAll(checker, world, finer);
  const WholeReport whole = checker.checkWhole();
  CHECK(whole.between_parts > 10);
  CHECK_FALSE(whole.valid());
}

TEST_CASE("changes cost less than half a microsecond an edge", "[.measure]") {
  MeshedWorld world(kClosedWorlds[0]);
  std::mt19937 random(1);
  const Drawing drawing = drawingOf(randomTree(random));
  world.want(drawing);
  FrameChecker checker;
  uint64_t edges = 0;
  double best = 1e9;
  for (int round = 0; round < 20; ++round) {
    const auto start = std::chrono::steady_clock::now();
    for (const auto& [key, parts] : drawing) REQUIRE(checker.draw(world.view(key), parts));
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    edges = checker.check().edges;
    best = std::min(best, seconds.count());
  }
  const double microseconds = best / static_cast<double>(edges) * 1e6;
  std::printf("%.3f us an edge, erased and drawn\n", microseconds);
  CHECK(microseconds < 0.5);
}
