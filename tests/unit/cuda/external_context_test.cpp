// Tests meshes that stay in an engine's context, on a simulated driver whose GPU memory the test can read.

#include <array>
#include <cstring>
#include <random>

#include "backend/cpu/cpu_backend.h"
#include "catch.h"
#include "cuda/cuda_backend.h"
#include "cuda/driver_device.h"
#include "cuda/kept_meshes.h"
#include "fake_driver.h"
#include "rounds.h"
#include "unit/backend/spheres.h"

using namespace sgm;
using cuda::FakeDriver;

namespace {

/// An engine that has a CUDA context, and optionally a stream of its own.
class Engine {
 public:
  explicit Engine(bool with_stream) : table_(driver.table()) {
    REQUIRE(table_.ctxCreate(&context_, 0, 0) == cuda::kCuSuccess);
    if (with_stream) REQUIRE(table_.streamCreate(&stream_, 0) == cuda::kCuSuccess);
    // The context that is current before a call of the runtime must also be current after it.
    cuda::CuContext popped = nullptr;
    table_.ctxPopCurrent(&popped);
  }
  ~Engine() {
    table_.ctxPushCurrent(context_);
    if (stream_ != nullptr) table_.streamDestroy(stream_);
    cuda::CuContext popped = nullptr;
    table_.ctxPopCurrent(&popped);
    table_.ctxDestroy(context_);
  }
  cuda::BorrowedContext lend() const { return {context_, stream_}; }
  const cuda::DriverTable& table() const { return table_; }

  FakeDriver driver;

 private:
  cuda::DriverTable table_;
  cuda::CuContext context_ = nullptr;
  cuda::CuStream stream_ = nullptr;
};

struct LentMachine {
  const Engine& engine;
  std::unique_ptr<JobSystem> jobs = *makeThreadPool(2);
  std::unique_ptr<Backend> scalar = *makeCpuBackend("scalar", *jobs, std::pmr::get_default_resource(), {});
  std::unique_ptr<Backend> cuda;

  explicit LentMachine(const Engine& of, uint64_t cap = UINT64_MAX) : engine(of) {
    CudaBackendOptions options;
    options.resident_cap = cap;
    options.open = [this] { return cuda::borrowDevice(engine.table(), cuda::kFakeImage, engine.lend()); };
    Result<std::unique_ptr<Backend>> made =
        makeCudaBackend(options, *makeCpuBackend("", *jobs, std::pmr::get_default_resource(), {}),
                        std::pmr::get_default_resource(), {});
    REQUIRE(made);
    cuda = std::move(*made);
  }
};

std::vector<ChunkJob> staying(uint32_t seed, uint32_t count) {
  std::vector<ChunkJob> jobs = spheres(seed, count);
  for (ChunkJob& job : jobs) job.resident = true;
  return jobs;
}

std::vector<const MeshPart*> partsOf(const ChunkMesh& mesh) {
  std::vector<const MeshPart*> parts{&mesh.body};
  for (const MeshPart& seam : mesh.seams) parts.push_back(&seam);
  return parts;
}

bool sameBytes(const DevicePart& found, const MeshPart& expected) {
  REQUIRE(found.kind() == BackendKind::cuda);
  const auto& part = static_cast<const cuda::CudaPart&>(found);
  const auto same = [](const auto* there, uint32_t count, const auto& array) {
    return count == array.size() && std::memcmp(there, array.data(), count * sizeof(array[0])) == 0;
  };
  return reinterpret_cast<uintptr_t>(part.vertices) % 256 == 0 &&
         reinterpret_cast<uintptr_t>(part.indices) % 256 == 0 &&
         same(part.vertices, part.vertex_count, expected.vertices) &&
         same(part.indices, part.index_count, expected.indices);
}

struct Stayed {
  size_t wanted = 0, there = 0;
};

/// Checks, for each chunk, that either all of its parts stay on the device or none. Compares the bytes of the parts on
/// the device with those of the meshes.
Stayed checkStayed(const std::vector<ChunkMesh>& meshes) {
  Stayed stayed;
  for (const ChunkMesh& mesh : meshes) {
    const std::vector<const MeshPart*> parts = partsOf(mesh);
    size_t wanted = 0, there = 0;
    for (size_t p = 0; p < parts.size(); ++p) {
      const DevicePart* const found = mesh.on_device[p].get();
      wanted += parts[p]->indices.empty() ? 0u : 1u;
      there += found ? 1u : 0u;
      if (found) CHECK(sameBytes(*found, *parts[p]));
    }
    CHECK((there == 0 || there == wanted));
    stayed.wanted += wanted;
    stayed.there += there;
  }
  return stayed;
}

}  // namespace

TEST_CASE("meshes stay in a lent context, with the host's bytes, and end with their parts", "[cuda]") {
  for (const bool with_stream : {false, true}) {
    CAPTURE(with_stream);
    const Engine engine(with_stream);
    const LentMachine machine(engine);
    CHECK(machine.cuda->capabilities().lends_meshes);
    const std::vector<ChunkJob> jobs = staying(41, 21);
    {
      const std::vector<ChunkMesh> meshes = meshesOf(*machine.cuda, jobs);
      checkSame(meshesOf(*machine.scalar, jobs), meshes);
      const Stayed stayed = checkStayed(meshes);
      CHECK(stayed.wanted > 20);
      CHECK(stayed.there == stayed.wanted);
      CHECK(machine.cuda->counters().resident > 0);
      CHECK(machine.cuda->counters().on_cpu == 0);
    }
    CHECK(machine.cuda->counters().resident == 0);
    // Jobs that do not request resident meshes have no parts on the device.
    for (const ChunkMesh& mesh : meshesOf(*machine.cuda, spheres(41, 3))) CHECK(mesh.on_device == DeviceParts{});
    CHECK((engine.driver.state().launched_on == engine.lend().stream) == with_stream);
  }
}

TEST_CASE("what the CPU has made is brought to a lent context", "[cuda]") {
  const Engine engine(false);
  const LentMachine machine(engine);
  const std::vector<ChunkMesh> meshes = meshesOf(*machine.scalar, spheres(42, 9));
  std::vector<const MeshPart*> parts;
  const MeshPart empty;
  for (const ChunkMesh& mesh : meshes) {
    for (const MeshPart* part : partsOf(mesh)) parts.push_back(part);
  }
  parts.push_back(&empty);
  {
    const auto brought = machine.cuda->upload(parts);
    REQUIRE(brought);
    REQUIRE(brought->size() == parts.size());
    for (size_t i = 0; i < parts.size(); ++i) {
      CAPTURE(i);
      REQUIRE(((*brought)[i] != nullptr) == !parts[i]->indices.empty());
      if ((*brought)[i]) CHECK(sameBytes(*(*brought)[i], *parts[i]));
    }
    CHECK(machine.cuda->counters().resident > 0);
  }
  CHECK(machine.cuda->counters().resident == 0);
  REQUIRE(machine.cuda->upload({}));
}

TEST_CASE("where the cap leaves no room a mesh is not there, and the others are", "[cuda]") {
  const Engine engine(false);
  const std::vector<ChunkJob> jobs = staying(43, 12);
  uint64_t all = 0;
  {
    const LentMachine machine(engine);
    const std::vector<ChunkMesh> meshes = meshesOf(*machine.cuda, jobs);
    all = machine.cuda->counters().resident;
  }
  for (const uint64_t cap : {uint64_t{0}, all / 2, all - 1, all}) {
    CAPTURE(cap, all);
    const LentMachine machine(engine, cap);
    const std::vector<ChunkMesh> meshes = meshesOf(*machine.cuda, jobs);
    checkSame(meshesOf(*machine.scalar, jobs), meshes);
    const Stayed stayed = checkStayed(meshes);
    CHECK((stayed.there == stayed.wanted) == (cap == all));
    CHECK((stayed.there == 0) == (cap == 0));
    CHECK(machine.cuda->counters().resident <= cap);
  }
}

TEST_CASE("what the engine gives its stream after a batch is not waited for", "[cuda]") {
  std::array<unsigned char, 256> later{};
  const Engine engine(true);
  const auto giveMore = [&] {
    const cuda::DriverTable& table = engine.table();
    table.ctxPushCurrent(engine.lend().context);
    table.memsetD8Async(reinterpret_cast<uintptr_t>(later.data()), 7, later.size(), engine.lend().stream);
    cuda::CuContext popped = nullptr;
    table.ctxPopCurrent(&popped);
  };
  std::vector<ChunkMesh> meshes;
  {
    const LentMachine machine(engine);
    // Submits the first batch, whose results are not copied back; its meshes stay on the device.
    auto batch = machine.cuda->submit(staying(44, 5));
    REQUIRE(batch);
    giveMore();
    (*batch)->wait();
    CHECK(later[0] == 0);
    meshes = *(*batch)->take();
    checkSame(meshesOf(*machine.scalar, spheres(44, 5)), meshes);
    const Stayed stayed = checkStayed(meshes);
    CHECK(stayed.there == stayed.wanted);
    CHECK(later[0] == 0);
    CHECK(machine.cuda->upload(std::vector<const MeshPart*>{&meshes[0].body}));
    meshes.clear();
    CHECK(later[0] == 0);
  }
  CHECK(later[0] == 0);
}

TEST_CASE("whatever call fails while meshes are to stay, they are right, and nothing stays behind", "[cuda]") {
  const Engine engine(false);
  const LentMachine machine(engine);
  const std::vector<ChunkJob> jobs = staying(45, 5);
  const std::vector<ChunkMesh> expected = meshesOf(*machine.scalar, jobs);
  std::vector<const MeshPart*> parts;
  for (const ChunkMesh& mesh : expected) parts.push_back(&mesh.body);
  constexpr uint32_t kSeed = 20'260'103;
  std::mt19937 random(kSeed);
  FakeDriver::State& state = engine.driver.state();
  uint64_t none = 0, failed = 0;
  for (uint32_t round = 0; round < rounds(200); ++round) {
    static const char* const kCalls[] = {"memcpyDtoDAsync",  "memcpyDtoDAsync", "memAllocFromPoolAsync",
                                         "memcpyHtoDAsync",  "memHostAlloc",    "eventRecord",
                                         "eventSynchronize", "eventQuery",      "memFreeAsync"};
    state.fail_call = kCalls[random() % std::size(kCalls)];
    state.fail_nth = 1 + static_cast<unsigned>(random() % 12);
    state.fail_result = cuda::kCuOutOfMemory;
    CAPTURE(kSeed, round, state.fail_call, state.fail_nth);
    if (random() % 3 == 0) {
      const auto brought = machine.cuda->upload(parts);
      failed += brought ? 0u : 1u;
      for (size_t i = 0; brought && i < parts.size(); ++i) {
        if ((*brought)[i]) CHECK(sameBytes(*(*brought)[i], *parts[i]));
      }
    } else {
      const std::vector<ChunkMesh> meshes =
          random() % 2 == 0 ? polled(*machine.cuda, jobs) : meshesOf(*machine.cuda, jobs);
      checkSame(expected, meshes);
      none += checkStayed(meshes).there == 0 ? 1u : 0u;
    }
    state.fail_nth = 0;
    CHECK(machine.cuda->counters().resident == 0);
  }
  CHECK(none > 0);
  CHECK(failed > 0);
}

TEST_CASE("meshes whose copies nobody could wait for are not to be read", "[cuda]") {
  const Engine engine(false);
  FakeDriver::State& state = engine.driver.state();
  const std::vector<ChunkJob> jobs = staying(47, 4);
  unsigned unsure = 0;
  for (const char* call : {"eventSynchronize", "eventRecord", "ctxPushCurrent"}) {
    for (unsigned nth = 1; nth < 60; ++nth) {
      CAPTURE(call, nth);
      const LentMachine machine(engine);
      (void)meshesOf(*machine.cuda, jobs);
      state.may_leave = true;
      state.fail_call = call, state.fail_nth = nth, state.fail_result = cuda::kCuOutOfMemory;
      const std::vector<ChunkMesh> meshes = meshesOf(*machine.cuda, jobs);
      state.fail_nth = 0;
      for (const ChunkMesh& mesh : meshes) {
        const std::vector<const MeshPart*> parts = partsOf(mesh);
        for (size_t p = 0; p < parts.size(); ++p) {
          if (!mesh.on_device[p]) continue;
          const auto& part = static_cast<const cuda::CudaPart&>(*mesh.on_device[p]);
          const bool lost = part.memory->meshes().device().lost();
          unsure += lost ? 1u : 0u;
          if (!lost) CHECK(sameBytes(part, *parts[p]));
        }
      }
    }
  }
  CHECK(unsure > 0);
}

TEST_CASE("a lent context that is lost stays lost, and the CPU goes on", "[cuda]") {
  const Engine engine(false);
  FakeDriver::State& state = engine.driver.state();
  state.may_leave = true;
  const std::vector<ChunkJob> jobs = staying(46, 4);
  {
    const LentMachine machine(engine);
    const std::vector<ChunkMesh> before = meshesOf(*machine.cuda, jobs);
    const auto& kept = static_cast<const cuda::CudaPart&>(*before[0].on_device[0]);
    CHECK_FALSE(kept.memory->meshes().device().lost());
    state.fail_call = "launchKernel", state.fail_nth = 1, state.fail_result = 719, state.lasts = true;
    const std::vector<ChunkMesh> meshes = meshesOf(*machine.cuda, jobs);
    checkSame(before, meshes);
    CHECK(checkStayed(meshes).there == 0);
    CHECK(kept.memory->meshes().device().lost());
    CHECK(machine.cuda->counters().device_lost == 1);
    state.fail_nth = 0;
  }
}

TEST_CASE("a context that cannot mesh is refused with the reason", "[cuda]") {
  const Engine engine(false);
  FakeDriver::State& state = engine.driver.state();
  const auto refusal = [&] {
    const auto device = cuda::borrowDevice(engine.table(), cuda::kFakeImage, engine.lend());
    REQUIRE(!device);
    CHECK(device.error().code == Code::unsupported);
    return device.error().message;
  };
  CHECK(cuda::borrowDevice(engine.table(), {}, engine.lend()).error().message.find("no CUDA kernels") !=
        std::string::npos);
  state.capability_major = 7, state.capability_minor = 0;
  CHECK(refusal().find("a GPU that pretends cannot be used: it has compute capability 7.0") == 0);
  state.capability_minor = 5;
  for (const char* call : {"ctxPushCurrent", "ctxGetDevice", "deviceGetName", "moduleLoadData", "memPoolCreate"}) {
    CAPTURE(call);
    state.fail_call = call, state.fail_nth = 1, state.fail_result = 201;
    CHECK_FALSE(refusal().empty());
  }
}

TEST_CASE("a stream of which nobody can tell the context is refused", "[cuda]") {
  const Engine engine(true);
  FakeDriver::State& state = engine.driver.state();
  state.fail_call = "streamGetCtx", state.fail_nth = 1, state.fail_result = 400;
  const auto refused = cuda::borrowDevice(engine.table(), cuda::kFakeImage, engine.lend());
  REQUIRE(!refused);
  CHECK(refused.error().code == Code::invalid_argument);
  CHECK(cuda::borrowDevice(engine.table(), cuda::kFakeImage, engine.lend()));
}
