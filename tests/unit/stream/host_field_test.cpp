// Tests a host's field together with the grammar's: the surface of both is closed in every frame, all queries agree,
// and the field is as exact as its samples.

#include <atomic>
#include <cmath>

#include "backend/cpu/instruction_sets.h"
#include "field/evaluate.h"
#include "query/queries.h"
#include "rounds.h"
#include "streaming_support.h"
#include "world/edits_support.h"

namespace sgm {
namespace {

constexpr double kHostMetre = kUnitsPerMetre;

using Distance = std::function<double(double x, double y, double z)>;

HostField hostOf(Distance distance, float steepness = 0) {
  HostField host;
  host.sample = [distance = std::move(distance)](const SampleLattice& at, std::span<float> values) -> Result<void> {
    size_t i = 0;
    for (uint32_t z = 0; z < at.count[2]; ++z) {
      for (uint32_t y = 0; y < at.count[1]; ++y) {
        for (uint32_t x = 0; x < at.count[0]; ++x, ++i) {
          values[i] = static_cast<float>(distance(at.origin.x + static_cast<double>(x) * at.spacing,
                                                  at.origin.y + static_cast<double>(y) * at.spacing,
                                                  at.origin.z + static_cast<double>(z) * at.spacing));
        }
      }
    }
    return {};
  };
  host.bounds = IntBox::everything();
  host.steepness = steepness;
  return host;
}

HostField hostBall(double x, double y, double z, double radius, float steepness = 0) {
  return hostOf([=](double px, double py, double pz) { return std::hypot(px - x, py - y, pz - z) - radius; },
                steepness);
}

/// A host's field that is solid below hills of about the given height.
HostField hills(double height, double phase, float steepness) {
  return hostOf(
      [=](double x, double y, double z) {
        return 0.7 *
               (y - height - 3 * kHostMetre * std::sin(x / (9 * kHostMetre) + phase) * std::cos(z / (7 * kHostMetre)));
      },
      steepness);
}

HostField countedHost(HostField host, std::atomic<uint64_t>& calls, std::atomic<uint64_t>& points) {
  host.sample = [inner = host.sample, &calls, &points](const SampleLattice& at, std::span<float> values) {
    ++calls;
    points += values.size();
    return inner(at, values);
  };
  return host;
}

const char* const kEmptyWorld =
    "sgm 1; units m; domain infinite; layer l cell 64m reach 8m { start Main; } rule Main { }";

WorldField hostedWorld(std::vector<HostField> hosts, int32_t cell = 512, const std::string& text = kEmptyWorld) {
  return WorldField(withHosts(settingsOf(text, cell), std::move(hosts)), std::pmr::get_default_resource());
}

std::vector<ChunkRequest> chunksAround(int level, int32_t half) {
  std::vector<ChunkRequest> requests;
  for (int32_t z = -half; z < half; ++z) {
    for (int32_t y = -half; y < half; ++y) {
      for (int32_t x = -half; x < half; ++x) requests.emplace_back().key = {level, {x, y, z}};
    }
  }
  return requests;
}

}  // namespace

TEST_CASE("a host's hills and the grammar's caves are one closed surface in every frame, dug too") {
  for (uint32_t seed = 1; seed <= rounds(2); ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    HostField above =
        hills(within(random, 90, 101) * kHostMetre, within(random, 0, 6), random() % 2 == 0 ? 1.0f : 0.0f);
    above.cut = true;
    above.sample = [inner = above.sample](const SampleLattice& at, std::span<float> values) -> Result<void> {
      if (Result<void> sampled = inner(at, values); !sampled) return sampled;
      for (float& value : values) value = -value;  // negated: the host's field then cuts away the air above the hills
      return {};
    };
    above.smooth = random() % 2 == 0 ? 2 * kUnitsPerMetre : 0;
    HostField rock =
        hostBall(96 * kHostMetre, 100 * kHostMetre, 96 * kHostMetre, 7 * kHostMetre, random() % 2 == 0 ? 1.0f : 0.0f);
    rock.label = makeLabel(1, 0);
    // The bounds contain only a part of the ball. The rock ends at the bounds.
    rock.bounds = {{90 * kUnitsPerMetre, 90 * kUnitsPerMetre, 90 * kUnitsPerMetre},
                   {101 * kUnitsPerMetre, 120 * kUnitsPerMetre, 120 * kUnitsPerMetre}};
    Scene scene(std::make_unique<LateJobs>(seed), caveText(), {}, {above, rock});
    Engine engine;
    Viewer viewer = viewerAt(96, 96, 96);
    EditLog log{EditSettings{}};
    for (int turn = 0; turn < 24; ++turn) {
      viewer = wander(random, viewer);
      REQUIRE(scene.world->setViewers({&viewer, 1}));
      if (turn == 12) {
        Brush dig;
        dig.cut = true;
        dig.from = {96 * kUnitsPerMetre, 100 * kUnitsPerMetre, 93 * kUnitsPerMetre};
        dig.radius = 3 * kUnitsPerMetre;
        REQUIRE(scene.world->edit(dig));
        REQUIRE(log.import(scene.world->exportEdits(0)));
      }
      for (int update = 0; update < 6; ++update) {
        REQUIRE(scene.world->update(size_t{1} << 30));
        engine.take(*scene.world);
        for (auto jobs = random() % 60; jobs > 0 && scene.jobs->help(); --jobs) {
        }
      }
      if (turn % 8 == 7 && turn < 12) checkFrame(scene, engine);
    }
    comeToRest(scene, engine);
    CHECK(engine.shown.size() > 20);
    checkFrame(scene, engine, log.snapshot().get());
  }
}

TEST_CASE("what a host's field is at a place does not depend on the box that asked") {
  size_t alone_in_all = 0;
  for (uint32_t seed = 1; seed <= rounds(12); ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    std::atomic<uint64_t> calls{0}, points{0};
    HostField host = hills(0, seed, random() % 3 == 0 ? 0.0f : 1.0f);
    host.cut = random() % 2 == 0;
    const bool steep = host.steepness > 0;
    host.smooth = random() % 2 == 0 ? 0 : within(random, 1, kWidestHostBlend);
    if (random() % 3 == 0) {
      host.bounds = {{-within(random, 1, 60'000), -40'000, -within(random, 1, 60'000)}, {30'000, 40'000, 50'000}};
    }
    HostField rock = hostBall(20'000, 0, -9'000, 15'000, random() % 2 == 0 ? 0.0f : 1.0f);
    const int32_t cells[] = {512, 256, 1000, 102};
    const WorldField world = hostedWorld({countedHost(host, calls, points), rock}, cells[random() % 4]);
    const int level = static_cast<int>(random() % 3);
    const int32_t edge = 32 * world.cellAt(level);
    size_t alone = 0;
    for (int round = 0; round < 12; ++round) {
      const auto at = [&] { return static_cast<int32_t>(random() % 8) - 4; };
      Int3 chunk{at() * edge, at() * edge, at() * edge};
      // Some chunks lie at the end of the world, which cuts off their samples' cells.
      if (round % 4 == 3) chunk[static_cast<int>(random() % 3)] = random() % 2 == 0 ? INT32_MIN : INT32_MAX - edge;
      const IntBox small{chunk, {chunk.x + edge, chunk.y + edge, chunk.z + edge}};
      const IntBox large = small.grown(static_cast<int32_t>(random() % static_cast<uint32_t>(edge)));
      const uint64_t calls_before = calls, points_before = points;
      const Result<std::shared_ptr<const FieldProgram>> own = world.compile(small, level);
      alone += calls - calls_before == 1 && points - points_before == 1;
      const Result<std::shared_ptr<const FieldProgram>> other = world.compile(large, level);
      REQUIRE(own);
      REQUIRE(other);
      std::vector<int32_t> x, y, z;
      for (int i = 0; i < 400; ++i) {
        // Some points are in corners, edges and faces, which belong to several chunks.
        const auto along = [&](int32_t first) {
          return random() % 4 == 0 ? first + edge * static_cast<int32_t>(random() % 2)
                                   : first + static_cast<int32_t>(random() % static_cast<uint32_t>(edge));
        };
        x.push_back(along(chunk.x));
        y.push_back(along(chunk.y));
        z.push_back(along(chunk.z));
      }
      const auto evaluated = [&](const FieldProgram& program) {
        EvalScratch scratch;
        std::vector<float> values(4 * x.size());
        std::vector<uint32_t> label(x.size());
        Attributes out;
        out.value = values.data();
        out.gradient_x = values.data() + x.size();
        out.gradient_y = values.data() + 2 * x.size();
        out.gradient_z = values.data() + 3 * x.size();
        out.label = label.data();
        bestKernels().attributes(program.view(), {x.data(), y.data(), z.data(), x.size()}, scratch, out);
        return std::pair(values, label);
      };
      CHECK(evaluated(**own) == evaluated(**other));
    }
    if (!steep) CHECK(alone == 0);
    alone_in_all += alone;
  }
  CHECK(alone_in_all > 0);
}

TEST_CASE("a host's surface nears what it samples with the square of the cell") {
  const double radius = 6.3 * kHostMetre, middle = 0.37 * kHostMetre;
  double before = 0;
  for (const int32_t cell : {1024, 512, 256}) {
    const WorldField world = hostedWorld({hostBall(middle, middle, middle, radius, 1)}, cell);
    double worst = 0;
    size_t vertices = 0;
    for (const PlacedChunk& chunk : meshAll(world, chunksAround(0, 1024 / cell), 2)) {
      for (const Vertex& vertex : chunk.mesh.body.vertices) {
        const Int3 p = vertexUnits(chunk.grid, vertex);
        worst = std::max(worst, std::abs(std::hypot(p.x - middle, p.y - middle, p.z - middle) - radius));
        ++vertices;
      }
    }
    CAPTURE(cell, worst, vertices);
    CHECK(vertices > 300);
    CHECK(worst < 0.02 * cell + 2);
    if (before > 0) CHECK(worst * 3 < before + 3);
    before = worst;
  }
}

TEST_CASE("an edit in a host's solid shows what that is made of, however far from its surface") {
  const std::string text =
      replaced(kEmptyWorld, "rule Main { }", "rule Main { at(20m, 10m, 10m) { sphere(1m); mat marble; } }");
  for (const float steepness : {0.0f, 1.0f}) {
    HostField rock = hostBall(0, 0, 0, 40 * kHostMetre, steepness);
    rock.label = makeLabel(1, 0);
    const WorldField world = hostedWorld({rock}, 512, text);
    EditLog edits{EditSettings{}};
    Brush dig;
    dig.cut = true;
    dig.radius = 2 * kUnitsPerMetre;
    REQUIRE(edits.add(dig));
    const std::shared_ptr<const EditSnapshot> snapshot = edits.snapshot();
    size_t vertices = 0, others = 0;
    for (const PlacedChunk& chunk : meshAll(world, chunksAround(0, 1), 2, snapshot.get())) {
      for (const Vertex& vertex : chunk.mesh.body.vertices) {
        ++vertices;
        others += vertex.material != 1;
      }
    }
    CAPTURE(steepness, vertices);
    CHECK(vertices > 100);
    CHECK(others == 0);
  }
}

TEST_CASE("rays hit a host's field, as far as it goes in the world") {
  const WorldField world = hostedWorld({hostBall(0, 0, 0, 5 * kHostMetre, 1)});
  const QueryField field = queryField(world);
  const Result<std::optional<SurfacePoint>> hit = rayCast(field, {0, 40 * kHostMetre, 0}, {0, -1, 0}, 60 * kHostMetre);
  REQUIRE(hit);
  REQUIRE(*hit);
  CHECK((*hit)->position[1] == Approx(5 * kHostMetre).margin(16));

  // Oblique rays through many small cells, with a field of unknown (0) or known (1) steepness.
  for (const float steepness : {0.0f, 1.0f}) {
    const WorldField fine = hostedWorld({hostBall(0, 0, 0, 5 * kHostMetre, steepness)}, 102);
    const double side = 40 * kHostMetre;
    const Result<std::optional<SurfacePoint>> slanting =
        rayCast(queryField(fine), {side, side, side}, {-1, -1, -1}, 90 * kHostMetre);
    REQUIRE(slanting);
    REQUIRE(*slanting);
    CHECK((*slanting)->distance == Approx(side * std::sqrt(3.0) - 5 * kHostMetre).margin(8));
    const Result<std::optional<SurfacePoint>> nearest =
        closestPoint(queryField(fine), {0, 9 * kHostMetre, 0}, 20 * kHostMetre);
    REQUIRE(nearest);
    REQUIRE(*nearest);
    CHECK((*nearest)->distance == Approx(4 * kHostMetre).margin(102));
  }

  // At the end of the world, the cells of the field's samples are cut off.
  const WorldField everywhere = hostedWorld({hills(0, 0, 0)}, 1000);
  for (const int32_t end : {INT32_MIN, INT32_MAX}) {
    const Int3 corner{end, 0, end};
    const Result<std::shared_ptr<const FieldProgram>> program = everywhere.compile({corner, corner}, 3);
    REQUIRE(program);
    int32_t q = 0;
    EvalScratch scratch;
    bestKernels().samples((*program)->view(), {&corner.x, &corner.y, &corner.z, 1}, scratch, &q);
    CHECK(std::abs(q) < 1 << 22);
  }
}

TEST_CASE("a host's field that fails, or is no number, fails its chunk with a message that says where") {
  HostField refused = hostOf([](double, double, double) { return 0.0; });
  refused.sample = [](const SampleLattice&, std::span<float>) -> Result<void> {
    return Error{Code::unsupported, "the host is out of order"};
  };
  const auto messageOf = [](const HostField& host) {
    const Result<std::shared_ptr<const FieldProgram>> program =
        hostedWorld({host}).compile({{0, 0, 0}, {99, 99, 99}}, 0);
    REQUIRE_FALSE(program);
    return program.error().message;
  };
  CHECK(messageOf(refused) == "the host is out of order");
  const HostField odd =
      hostOf([](double x, double y, double z) { return x == 512 && y == 0 && z == 512 ? std::nan("") : x; });
  CHECK(messageOf(odd) == "the host's field is not finite at 512, 0, 512 units");
  const Result<std::shared_ptr<const FieldProgram>> huge =
      hostedWorld({hills(0, 0, 0)}).compile({{0, 0, 0}, {1 << 24, 1 << 24, 1 << 24}}, 0);
  REQUIRE_FALSE(huge);
  CHECK(huge.error().code == Code::limit);
}

TEST_CASE("a host's field that is steeper than it says fails, instead of chunks that do not fit") {
  const HostField jump = hostOf([](double x, double, double) { return x < 1024 ? -2000.0 : 2000.0; }, 1);
  const Result<std::shared_ptr<const FieldProgram>> program = hostedWorld({jump}).compile({{0, 0, 0}, {99, 99, 99}}, 0);
  REQUIRE_FALSE(program);
  CHECK(program.error().message.find("steepness of 1") != std::string::npos);
}

TEST_CASE("a world's identity tells the host's fields apart") {
  HostField host = hostBall(0, 0, 0, kHostMetre);
  const auto identityOf = [](const std::vector<HostField>& hosts) { return hostedWorld(hosts).identity(); };
  const auto plain = identityOf({host});
  CHECK(plain == identityOf({host}));
  CHECK(plain != identityOf({}));
  CHECK(plain != identityOf({host, host}));
  HostField other = host;
  other.identity = 1;
  CHECK(plain != identityOf({other}));
  other = host;
  other.cut = true;
  CHECK(plain != identityOf({other}));
  other = host;
  other.smooth = 1;
  CHECK(plain != identityOf({other}));
  other = host;
  other.label = 1;
  CHECK(plain != identityOf({other}));
  other = host;
  other.steepness = 1;
  CHECK(plain != identityOf({other}));
  other = host;
  other.bounds.hi.z = 5;
  CHECK(plain != identityOf({other}));
  CHECK(identityOf({host, other}) != identityOf({other, host}));
}

}  // namespace sgm
