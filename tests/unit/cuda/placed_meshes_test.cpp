// Tests meshes that the CUDA backend places in the memory of a Vulkan device, which draws them, and failures of either
// API. CUDA is simulated (fake_gpu.h): its GPU pretends to be the Vulkan device.

#include "cuda/placed_meshes.h"
#include "seed.h"

#include <chrono>
#include <cstring>
#include <deque>
#include <random>
#include <thread>

#include "backend/vulkan/device_meshes.h"
#include "backend/vulkan/shared_meshes.h"
#include "catch.h"
#include "cuda/driver_device.h"
#include "fake_driver.h"
#include "unit/vulkan/engine.h"
#include "unit/vulkan/faults.h"
#include "unit/vulkan/have_device.h"

using namespace sgm;

/// Suppresses reports of leaks in the validation layer, which keeps objects in reference cycles. When a device is
/// destroyed, the layer itself checks that our objects were destroyed before.
extern "C" const char* __lsan_default_suppressions(void);
extern "C" const char* __lsan_default_suppressions(void) { return "leak:libVkLayer_khronos_validation.so"; }

namespace {

template <class T>
T take(Result<T> result) {
  INFO((result ? std::string() : result.error().message));
  REQUIRE(result);
  return std::move(*result);
}

/// The GPU that both APIs use: an engine's Vulkan device, the simulated CUDA driver, and the store that they share.
class OneGpu {
 public:
  OneGpu() : engine_(vulkan::Validation::synchronization, true) {
    const vulkan::DeviceInfo info = vulkan::describe(engine_.instance->calls(), engine_.physical);
    driver.state().id = info.id;
    vulkan::BorrowedDevice external = engine_.lend();
    external.external_memory = true;
    external.replace_calls = [](vulkan::DeviceTable& table) { vulkan::Faults::wrap(table); };
    store = take(vulkan::openSharedMeshes(external));
  }

  std::unique_ptr<cuda::Device> openCuda() const { return take(cuda::openDevice(driver.table(), cuda::kFakeImage)); }

  cuda::FakeDriver driver;

 private:
  vulkan::Engine engine_;

 public:
  vulkan::Faults faults;
  std::shared_ptr<MeshStore> store;
};

/// The results of a batch in device memory: chunks with a body of random bytes each.
class BatchOf {
 public:
  BatchOf(cuda::Stream& stream, size_t chunks, std::mt19937& random) : sources(chunks), bytes_(chunks) {
    for (size_t c = 0; c < chunks; ++c) {
      cuda::PartSource& body = sources[c][0];
      body.vertex_count = 1 + static_cast<uint32_t>(random() % 500);
      body.index_count = 3 + static_cast<uint32_t>(random() % 900);
      const size_t of_vertices = body.vertex_count * sizeof(Vertex), of_indices = body.index_count * sizeof(uint32_t);
      bytes_[c].resize(of_vertices + of_indices);
      for (std::byte& byte : bytes_[c]) byte = static_cast<std::byte>(random());
      memory_.emplace_back();
      REQUIRE(memory_.back().grow(stream, cuda::MemoryKind::device, of_vertices + of_indices));
      // The memory of the simulated GPU belongs to this process, so memcpy() can write to it.
      std::memcpy(memory_.back().data(), bytes_[c].data(), bytes_[c].size());
      body.vertices = reinterpret_cast<const Vertex*>(memory_.back().data());
      body.indices = reinterpret_cast<const uint32_t*>(memory_.back().data() + of_vertices);
    }
  }

  /// Whether the memory at the place contains the bytes of the place's chunk.
  bool arrived(const PartPlace& place) const {
    const cuda::PartSource& body = sources[place.chunk][0];
    const size_t of_vertices = body.vertex_count * sizeof(Vertex);
    std::vector<std::byte> there(bytes_[place.chunk].size());
    const int descriptor = take(place.block->descriptor());
    cuda::CuSharedMemory shared;
    shared.handle.descriptor = descriptor;
    shared.bytes = place.block->bytes();
    const cuda::DriverTable look = cuda::fakeTable();
    cuda::CuImported imported = nullptr;
    cuda::CuPointer begin = 0;
    cuda::CuSharedRange whole;
    whole.bytes = shared.bytes;
    cuda::CuContext context = nullptr;
    REQUIRE(look.ctxCreate(&context, 0, 0) == cuda::kCuSuccess);
    REQUIRE(look.importExternalMemory(&imported, &shared) == cuda::kCuSuccess);
    REQUIRE(look.externalMemoryGetMappedBuffer(&begin, imported, &whole) == cuda::kCuSuccess);
    const auto* memory = reinterpret_cast<const std::byte*>(static_cast<uintptr_t>(begin));
    std::memcpy(there.data(), memory + place.vertices, of_vertices);
    std::memcpy(there.data() + of_vertices, memory + place.indices, there.size() - of_vertices);
    look.memFree(begin);
    look.destroyExternalMemory(imported);
    look.ctxPopCurrent(&context);
    look.ctxDestroy(context);
    return there == bytes_[place.chunk];
  }

  std::vector<cuda::PartSources> sources;

 private:
  std::vector<std::vector<std::byte>> bytes_;
  std::deque<cuda::Memory> memory_;
};

bool there(const DeviceParts& parts) { return static_cast<const vulkan::VulkanPart&>(*parts[0]).memory().there(); }

/// Waits until all freed memory is released, which happens once the drawing device has completed the work that uses the
/// memory. Returns the number of bytes that the store still has.
uint64_t bytesAtRest(MeshStore& store) {
  for (int tries = 0; store.bytes() != 0 && tries < 60'000; ++tries) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return store.bytes();
}

}  // namespace

TEST_CASE("parts are where they were placed, and there once they are published", "[cuda]") {
  if (!vulkan::haveDevice()) return;
  const unsigned seed = testSeed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  OneGpu gpu;
  {
    const std::unique_ptr<cuda::Device> device = gpu.openCuda();
    const std::unique_ptr<cuda::Stream> stream = take(device->makeStream());
    const auto placed = take(cuda::PlacedMeshes::create(*device, gpu.store));
    CHECK(gpu.store->bytes() == 0);
    const BatchOf batch(*stream, 20, random);
    std::unique_ptr<MeshPlacement> placement = take(placed->keep(*stream, batch.sources));
    REQUIRE(placement->parts.size() == 20);
    for (const DeviceParts& parts : placement->chunks) CHECK(!there(parts));
    REQUIRE(stream->wait());
    REQUIRE(gpu.store->publish(*placement));
    for (const DeviceParts& parts : placement->chunks) CHECK(there(parts));
    for (const PartPlace& place : placement->parts) CHECK(batch.arrived(place));
    CHECK(gpu.store->bytes() > 0);
    placement.reset();
    CHECK(bytesAtRest(*gpu.store) == 0);
    // The store's block stays allocated, and the import of its memory stays valid.
    CHECK(gpu.driver.state().imports == 1);
  }
  gpu.store.reset();
  CHECK(gpu.driver.state().imports == 0);
}

TEST_CASE("parts that could not be published are not there, and harm nobody", "[cuda]") {
  if (!vulkan::haveDevice()) return;
  std::mt19937 random(11);
  OneGpu gpu;
  const std::unique_ptr<cuda::Device> device = gpu.openCuda();
  const std::unique_ptr<cuda::Stream> stream = take(device->makeStream());
  const auto placed = take(cuda::PlacedMeshes::create(*device, gpu.store));
  const BatchOf batch(*stream, 3, random);
  for (const char* call : {"vkBeginCommandBuffer", "vkEndCommandBuffer", "vkQueueSubmit", "", "vkQueueSubmit"}) {
    CAPTURE(call);
    std::unique_ptr<MeshPlacement> placement = take(placed->keep(*stream, batch.sources));
    REQUIRE(stream->wait());
    gpu.faults.arm(call, *call ? 1 : 0, VK_ERROR_OUT_OF_HOST_MEMORY);
    CHECK(static_cast<bool>(gpu.store->publish(*placement)) == (*call == '\0'));
    gpu.faults.disarm();
    for (const DeviceParts& parts : placement->chunks) CHECK(there(parts) == (*call == '\0'));
    placement.reset();
    CHECK(bytesAtRest(*gpu.store) == 0);
  }
  gpu.store.reset();
}

TEST_CASE("where the device that draws is lost nothing is placed on it, and CUDA is none the worse", "[cuda]") {
  if (!vulkan::haveDevice()) return;
  std::mt19937 random(16);
  OneGpu gpu;
  const std::unique_ptr<cuda::Device> device = gpu.openCuda();
  const std::unique_ptr<cuda::Stream> stream = take(device->makeStream());
  const auto placed = take(cuda::PlacedMeshes::create(*device, gpu.store));
  const BatchOf batch(*stream, 3, random);
  std::unique_ptr<MeshPlacement> placement = take(placed->keep(*stream, batch.sources));
  REQUIRE(stream->wait());
  gpu.faults.arm("vkQueueSubmit", 1, VK_ERROR_DEVICE_LOST);
  CHECK(!gpu.store->publish(*placement));
  gpu.faults.disarm();
  CHECK(gpu.store->lost());
  CHECK(!there(placement->chunks[0]));
  placement = take(placed->keep(*stream, batch.sources));
  CHECK(placement->chunks.size() == 3);
  CHECK(placement->parts.empty());
  MeshPart part(std::pmr::get_default_resource());
  part.vertices.resize(3);
  part.indices = {0, 1, 2};
  const MeshPart* const parts[] = {&part};
  const auto brought = gpu.store->upload(parts);
  REQUIRE(!brought);
  CHECK(brought.error().code == Code::unsupported);
  CHECK(!device->lost());
  placement.reset();
  gpu.store.reset();
}

TEST_CASE("a copy that fails is waited for, and its memory is the next one's", "[cuda]") {
  if (!vulkan::haveDevice()) return;
  std::mt19937 random(17);
  OneGpu gpu;
  const std::unique_ptr<cuda::Device> device = gpu.openCuda();
  const std::unique_ptr<cuda::Stream> stream = take(device->makeStream());
  const auto placed = take(cuda::PlacedMeshes::create(*device, gpu.store));
  const BatchOf batch(*stream, 3, random);
  gpu.driver.state().fail_call = "memcpyDtoDAsync";
  gpu.driver.state().fail_nth = 4;
  gpu.driver.state().fail_result = cuda::kCuOutOfMemory;
  const auto refused = placed->keep(*stream, batch.sources);
  REQUIRE(!refused);
  CHECK(take(stream->ended()));
  CHECK(gpu.store->bytes() == 0);
}

TEST_CASE("memory that may be written to still is nobody else's before the end", "[cuda]") {
  if (!vulkan::haveDevice()) return;
  std::mt19937 random(12);
  OneGpu gpu;
  {
    const std::unique_ptr<cuda::Device> device = gpu.openCuda();
    const std::unique_ptr<cuda::Stream> stream = take(device->makeStream());
    const auto placed = take(cuda::PlacedMeshes::create(*device, gpu.store));
    const BatchOf batch(*stream, 2, random);
    std::unique_ptr<MeshPlacement> left = take(placed->keep(*stream, batch.sources));
    const std::vector<PartPlace> places = left->parts;
    left.reset();
    CHECK(gpu.store->bytes() > 0);
    const std::unique_ptr<MeshPlacement> next = take(placed->keep(*stream, batch.sources));
    for (const PartPlace& old : places) {
      for (const PartPlace& now : next->parts) CHECK((old.block != now.block || old.vertices != now.vertices));
    }
    REQUIRE(stream->wait());
    REQUIRE(gpu.store->publish(*next));
  }
  gpu.store.reset();
  CHECK(gpu.driver.state().imports == 0);
}

TEST_CASE("a device opened after a loss imports the memory anew", "[cuda]") {
  if (!vulkan::haveDevice()) return;
  std::mt19937 random(13);
  OneGpu gpu;
  std::unique_ptr<MeshPlacement> before;
  for (int round = 0; round < 3; ++round) {
    const std::unique_ptr<cuda::Device> device = gpu.openCuda();
    const std::unique_ptr<cuda::Stream> stream = take(device->makeStream());
    const auto placed = take(cuda::PlacedMeshes::create(*device, gpu.store));
    const BatchOf batch(*stream, 4, random);
    std::unique_ptr<MeshPlacement> placement = take(placed->keep(*stream, batch.sources));
    REQUIRE(stream->wait());
    REQUIRE(gpu.store->publish(*placement));
    for (const PartPlace& place : placement->parts) CHECK(batch.arrived(place));
    CHECK(gpu.driver.state().imports == 1);
    before = std::move(placement);
  }
  // A block of memory stays valid as long as any mesh part in it is referenced. A device's import of the block ends
  // with that device.
  CHECK(there(before->chunks[0]));
  CHECK(gpu.driver.state().imports + gpu.driver.state().contexts == 0);
  before.reset();
  gpu.store.reset();
}

TEST_CASE("two devices may write to one block, each to what was placed for it", "[cuda]") {
  if (!vulkan::haveDevice()) return;
  std::mt19937 random(15);
  OneGpu gpu;
  {
    const std::unique_ptr<cuda::Device> old = gpu.openCuda(), anew = gpu.openCuda();
    const std::unique_ptr<cuda::Stream> first = take(old->makeStream()), second = take(anew->makeStream());
    const auto before = take(cuda::PlacedMeshes::create(*old, gpu.store));
    const auto after = take(cuda::PlacedMeshes::create(*anew, gpu.store));
    const BatchOf one(*first, 3, random), other(*second, 3, random);
    // The second device's transfer begins before the first device's has ended.
    std::unique_ptr<MeshPlacement> a = take(before->keep(*first, one.sources));
    std::unique_ptr<MeshPlacement> b = take(after->keep(*second, other.sources));
    std::unique_ptr<MeshPlacement> c = take(before->keep(*first, one.sources));
    REQUIRE(second->wait());
    REQUIRE(first->wait());
    for (MeshPlacement* placement : {a.get(), b.get(), c.get()}) REQUIRE(gpu.store->publish(*placement));
    for (const PartPlace& place : a->parts) CHECK(one.arrived(place));
    for (const PartPlace& place : b->parts) CHECK(other.arrived(place));
    for (const PartPlace& place : c->parts) CHECK(one.arrived(place));
  }
  gpu.store.reset();
  CHECK(gpu.driver.state().imports == 0);
}

TEST_CASE("where a block cannot be imported its chunks have no room; at the beginning it is an error", "[cuda]") {
  if (!vulkan::haveDevice()) return;
  std::mt19937 random(14);
  OneGpu gpu;
  const std::unique_ptr<cuda::Device> device = gpu.openCuda();
  const std::unique_ptr<cuda::Stream> stream = take(device->makeStream());
  for (const char* call : {"importExternalMemory", "externalMemoryGetMappedBuffer"}) {
    CAPTURE(call);
    gpu.driver.state().fail_call = call;
    gpu.driver.state().fail_nth = 1;
    gpu.driver.state().fail_result = 801;
    const auto refused = cuda::PlacedMeshes::create(*device, gpu.store);
    REQUIRE(!refused);
    CHECK(refused.error().code == Code::unsupported);
    CHECK(gpu.driver.state().imports == 0);
  }
  gpu.faults.arm("vkGetMemoryFdKHR", 1, VK_ERROR_TOO_MANY_OBJECTS);
  CHECK(!cuda::PlacedMeshes::create(*device, gpu.store));
  gpu.faults.disarm();
  const auto placed = take(cuda::PlacedMeshes::create(*device, gpu.store));
  // When the first block is full, the store allocates a second block.
  std::vector<cuda::PartSources> large(2);
  const BatchOf batch(*stream, 2, random);
  large[0] = batch.sources[0];
  large[1][0] = {batch.sources[1][0].vertices, batch.sources[1][0].indices, uint32_t{80} << 20 >> 4, 3};
  gpu.faults.arm("vkGetMemoryFdKHR", 1, VK_ERROR_TOO_MANY_OBJECTS);
  const std::unique_ptr<MeshPlacement> placement = take(placed->keep(*stream, large));
  gpu.faults.disarm();
  CHECK(placement->chunks[0][0] != nullptr);
  CHECK(placement->chunks[1][0] == nullptr);
  REQUIRE(stream->wait());
  REQUIRE(gpu.store->publish(*placement));
  CHECK(there(placement->chunks[0]));
}
