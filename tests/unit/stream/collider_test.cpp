// Tests colliders: they contain the drawn triangles with an area, for chunks near viewers and for no other chunks.

#include "catch.h"
#include "rounds.h"
#include "streaming_support.h"

using namespace sgm;

namespace {

constexpr double kColliderDistance = 16.0 * kUnitsPerMetre;

/// The triangles that a collider must have: the corner positions of the drawn triangles with an area, in order.
std::vector<std::array<float, 9>> wantedTriangles(const Engine::Shown& shown) {
  const ChunkSurface& surface = *shown.surface;
  const double metres = static_cast<double>(surface.grid.cell) / 256 / kUnitsPerMetre;
  std::vector<std::array<float, 9>> triangles;
  for (size_t part = 0; part < 7; ++part) {
    if (part > 0 && !(shown.seams >> (part - 1) & 1)) continue;
    const PackedRange& range = surface.mesh.ranges[part];
    for (size_t at = range.first_index; at < range.first_index + range.index_count; at += 3) {
      std::array<std::array<double, 3>, 3> p;
      for (size_t corner = 0; corner < 3; ++corner) {
        const Vertex& v = surface.mesh.vertices[surface.mesh.indices[at + corner]];
        p[corner] = {v.x * metres, v.y * metres, v.z * metres};
      }
      double area = 0;
      for (size_t a = 0; a < 3; ++a) {
        const size_t b = (a + 1) % 3, c = (a + 2) % 3;
        const double n = (p[1][b] - p[0][b]) * (p[2][c] - p[0][c]) - (p[1][c] - p[0][c]) * (p[2][b] - p[0][b]);
        area += n * n;
      }
      if (area == 0) continue;
      std::array<float, 9> flat{};
      for (size_t i = 0; i < 9; ++i) flat[i] = static_cast<float>(p[i / 3][i % 3]);
      triangles.push_back(flat);
    }
  }
  return triangles;
}

std::vector<std::array<float, 9>> trianglesOf(const Collider& collider) {
  std::vector<std::array<float, 9>> triangles(collider.indices.size() / 3);
  for (size_t i = 0; i < collider.indices.size(); ++i) {
    REQUIRE(collider.indices[i] < collider.positions.size() / 3);
    for (size_t axis = 0; axis < 3; ++axis) {
      triangles[i / 3][i % 3 * 3 + axis] = collider.positions[collider.indices[i] * 3 + axis];
    }
  }
  return triangles;
}

/// Checks that chunks near the viewer have a collider that equals their drawn surface, and that far chunks have none;
/// chunks between may have one.
void checkColliders(const Engine& engine, const Viewer& viewer) {
  size_t near = 0;
  for (const auto& [key, shown] : engine.shown) {
    const double away = distanceToChunk(viewer.position, key, kStreamedCell);
    const auto collider = engine.colliders.find(key);
    if (away <= kColliderDistance) {
      ++near;
      REQUIRE(collider != engine.colliders.end());
    } else if (away > kColliderDistance * 1.25) {
      CHECK(collider == engine.colliders.end());
    }
    if (collider == engine.colliders.end()) continue;
    CHECK(collider->second->key == key);
    CHECK(collider->second->grid.origin == shown.surface->grid.origin);
    CHECK(collider->second->materials.size() == collider->second->indices.size() / 3);
    CHECK((trianglesOf(*collider->second) == wantedTriangles(shown)));
  }
  for (const auto& [key, collider] : engine.colliders) CHECK(engine.shown.count(key) == 1);
  CHECK(near > 0);
}

}  // namespace

TEST_CASE("colliders are what is drawn near a viewer that moves and digs, and go when it leaves", "[threads]") {
  for (uint32_t seed = 1; seed <= rounds(2); ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    WorldSettings settings;
    settings.collider_distance = kColliderDistance;
    Scene scene(std::make_unique<LateJobs>(seed), caveText(), settings);
    Engine engine;
    Viewer viewer = viewerAt(96, 96, 96);
    for (int turn = 0; turn < 10; ++turn) {
      for (double& p : viewer.position) p += static_cast<double>(random() % 20000) - 10000;
      REQUIRE(scene.world->setViewers({&viewer, 1}));
      Brush brush;
      brush.cut = turn % 2 == 0;
      for (int axis = 0; axis < 3; ++axis) {
        brush.from[axis] = static_cast<int32_t>(viewer.position[static_cast<size_t>(axis)]) + 3000;
      }
      brush.radius = 4 * kUnitsPerMetre;
      REQUIRE(scene.world->edit(brush));
      for (auto updates = random() % 20; updates > 0; --updates) {
        REQUIRE(scene.world->update(size_t{1} << 20));
        engine.take(*scene.world);
        scene.jobs->help();
      }
      comeToRest(scene, engine);
      checkColliders(engine, viewer);
      CHECK(scene.world->stats().collider_bytes > 0);
    }
    viewer.position[1] += 200.0 * kUnitsPerMetre;
    lookFrom(scene, engine, viewer);
    for (const auto& [key, collider] : engine.colliders) CHECK(engine.shown.count(key) == 1);
  }
}

TEST_CASE("an update tells of few colliders, of none that has not changed, and takes none away too early",
          "[threads]") {
  for (uint32_t seed = 1; seed <= rounds(2); ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    WorldSettings settings;
    settings.collider_distance = kColliderDistance;
    settings.max_colliders = 1 + random() % 4;
    Scene scene(*makeThreadPool(2), caveText(), settings);
    std::map<ChunkKey, std::shared_ptr<const Collider>> given;
    std::map<ChunkKey, std::shared_ptr<const ChunkSurface>> ready, shown;
    Viewer viewer = viewerAt(96, 96, 96);
    size_t most = 0, all = 0, equal = 0, holes = 0;
    const auto frame = [&] {
      REQUIRE(scene.world->update(size_t{1} << 30));
      size_t told = 0;
      scene.world->poll([&](const WorldEvent& event) {
        using Kind = WorldEvent::Kind;
        if (event.kind == Kind::ready) ready[event.key] = event.surface;
        if (event.kind == Kind::shown || event.kind == Kind::replaced) shown[event.key] = ready[event.key];
        if (event.kind == Kind::removed) shown.erase(event.key);
        if (event.kind == Kind::collider) {
          ++told;
          ++all;
          const auto has = given.find(event.key);
          equal += has != given.end() && trianglesOf(*has->second) == trianglesOf(*event.collider) &&
                   has->second->materials == event.collider->materials;
          CHECK((has == given.end() || has->second->hash != event.collider->hash));
          given[event.key] = event.collider;
        }
        if (event.kind == Kind::collider_removed) {
          REQUIRE(given.erase(event.key) == 1);
          // A collider is removed only if at least one of the chunks that are now drawn in its place has a collider.
          size_t near = 0, with = 0;
          for (const auto& [key, surface] : shown) {
            if (!holds(key, event.key) && !holds(event.key, key)) continue;
            if (distanceToChunk(viewer.position, key, kStreamedCell) > kColliderDistance / 2) continue;
            ++near;
            with += given.contains(key);
          }
          holes += near > 0 && with == 0;
        }
        return true;
      });
      most = std::max(most, told);
    };
    for (int turn = 0; turn < 4; ++turn) {
      for (double& p : viewer.position) p += static_cast<double>(random() % 30000) - 15000;
      REQUIRE(scene.world->setViewers({&viewer, 1}));
      for (int updates = 0; updates < 100'000 && (updates == 0 || !scene.world->stats().idle); ++updates) {
        frame();
        workOrWait(scene);
      }
      REQUIRE(scene.world->stats().idle);
    }
    CHECK(all > 10);
    CHECK(most <= settings.max_colliders);
    CHECK(equal == 0);
    CHECK(holes == 0);
  }
}
