#include <atomic>
#include <random>
#include <thread>

#include "support.h"

using namespace sgm;
using namespace sgm::vulkan;

TEST_CASE("numbers go through all layers and come back", "[vulkan]") {
  TestDevice device;
  if (!device) return;
  for (const int32_t count : {1, 63, 64, 65, 100'000}) {
    std::vector<int32_t> in(static_cast<size_t>(count)), out(in.size());
    std::iota(in.begin(), in.end(), -5);
    std::iota(out.begin(), out.end(), -5);
    for (int32_t& x : out) x = 3 * (3 * x + 5) + 5;
    const auto back = throughAllLayers(*device, in, {});
    INFO((back ? std::string() : back.error().message));
    REQUIRE(back);
    REQUIRE(*back == out);
  }
}

TEST_CASE("the ring hands out as many recordings as it has", "[vulkan]") {
  TestDevice device;
  if (!device) return;
  auto queue = Queue::create(*device);
  REQUIRE(queue);
  auto ring = CommandRing::create(**queue, {2, 1, 2});
  REQUIRE(ring);
  {
    auto first = (*ring)->begin();
    auto second = (*ring)->begin();
    REQUIRE(first);
    REQUIRE(second);
    const auto third = (*ring)->begin(1000);
    REQUIRE(!third);
    CHECK(third.error().code == Code::limit);
  }
  // Both recordings were dropped without being submitted, so they are free again. There are more submissions here than
  // recordings, so that recordings are reused in turn.
  uint64_t last = 0;
  for (int i = 0; i < 20; ++i) {
    auto commands = (*ring)->begin();
    REQUIRE(commands);
    const auto value = (*ring)->submit(std::move(*commands));
    REQUIRE(value);
    CHECK(*value == last + 1);
    last = *value;
  }
  REQUIRE((*queue)->wait(last));
  CHECK(*(*queue)->reached() == last);
  CHECK(*(*queue)->wait(last, 0));
  CHECK((*queue)->wait(last + 1, 0).error().code == Code::invalid_argument);
}

TEST_CASE("more threads than recordings take their turns", "[vulkan][threads]") {
  TestDevice device;
  if (!device) return;
  auto queue = Queue::create(*device);
  REQUIRE(queue);
  auto ring = CommandRing::create(**queue, {2, 1, 2});
  REQUIRE(ring);
  constexpr uint64_t kThreads = 8, kTurns = 25;
  std::atomic<uint64_t> submitted = 0;
  std::vector<std::thread> threads;
  for (uint64_t t = 0; t < kThreads; ++t) {
    threads.emplace_back([&] {
      for (uint64_t turn = 0; turn < kTurns; ++turn) {
        auto commands = (*ring)->begin();
        if (!commands) continue;
        std::this_thread::yield();
        if ((*ring)->submit(std::move(*commands))) ++submitted;
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  CHECK(submitted == kThreads * kTurns);
  CHECK((*queue)->submitted() == kThreads * kTurns);
}

TEST_CASE("a recording has as many binds as the ring was made for", "[vulkan]") {
  TestDevice device;
  if (!device) return;
  auto queue = Queue::create(*device);
  REQUIRE(queue);
  auto ring = CommandRing::create(**queue, {1, 2, 2});
  REQUIRE(ring);
  const uint32_t constants[] = {0, 1};
  const auto shader = Pipeline::create(*device, affineShader(constants));
  REQUIRE(shader);
  Memory memory(*device);
  const auto buffer = memory.buffer(MemoryKind::device, 256);
  REQUIRE(buffer);
  const BufferRange ranges[] = {*buffer, *buffer};
  const int32_t none = 0;
  auto commands = (*ring)->begin();
  REQUIRE(commands);
  CHECK(commands->bind(*shader, std::span(ranges).first(1), bytesOf(none)).error().code == Code::invalid_argument);
  CHECK(commands->bind(*shader, ranges, {}).error().code == Code::invalid_argument);
  CHECK(commands->bind(*shader, ranges, bytesOf(none)));
  CHECK(commands->bind(*shader, ranges, bytesOf(none)));
}

TEST_CASE("a shader that makes no sense is refused", "[vulkan]") {
  TestDevice device;
  if (!device) return;
  const auto refused = [&](auto change) {
    PipelineDesc desc = affineShader({});
    change(desc);
    const auto made = Pipeline::create(*device, desc);
    return !made && made.error().code == Code::invalid_argument &&
           made.error().message.find("affine") != std::string::npos;
  };
  CHECK(refused([](PipelineDesc& desc) { desc.spirv = {}; }));
  CHECK(refused([](PipelineDesc& desc) { desc.buffers = kMaxBuffers + 1; }));
  CHECK(refused([](PipelineDesc& desc) { desc.push_bytes = 132; }));
  CHECK(refused([](PipelineDesc& desc) { desc.push_bytes = 6; }));
}

TEST_CASE("many threads record, submit and wait at one time", "[vulkan][threads]") {
  TestDevice device;
  if (!device) return;
  constexpr int kThreads = 8;
  const unsigned often = rounds(30);
  auto queue = Queue::create(*device);
  REQUIRE(queue);
  auto ring = CommandRing::create(**queue, {kThreads, 2, 2});
  REQUIRE(ring);
  MemoryOptions options;
  options.first_block = 1 << 16;
  Memory memory(*device, options);
  std::atomic<int> wrong{0}, submissions{0};
  std::vector<std::thread> threads;
  for (int t = 0; t < kThreads; ++t) {
    threads.emplace_back([&, t] {
      const uint32_t constants[] = {static_cast<uint32_t>(t), 2};
      const auto shader = Pipeline::create(*device, affineShader(constants));
      std::mt19937 random(static_cast<unsigned>(t));
      for (unsigned i = 0; i < often; ++i) {
        const auto count = static_cast<int32_t>(1 + random() % 5000);
        std::vector<int32_t> numbers(static_cast<size_t>(count));
        for (int32_t& x : numbers) x = static_cast<int32_t>(random() % 1000);
        const auto in = memory.buffer(MemoryKind::upload, numbers.size() * sizeof(int32_t));
        const auto out = memory.buffer(MemoryKind::readback, numbers.size() * sizeof(int32_t));
        auto commands = (*ring)->begin();
        if (!shader || !in || !out || !commands) {
          ++wrong;
          return;
        }
        write(*in, numbers);
        const bool bound = bool(commands->bind(*shader, std::array<BufferRange, 2>{*in, *out}, bytesOf(count)));
        commands->dispatch(static_cast<uint32_t>(count + 63) / 64);
        commands->barrier(kCompute, kHost);
        const auto value = (*ring)->submit(std::move(*commands));
        if (!bound || !value || !(*queue)->wait(*value) || !out->beforeRead()) {
          ++wrong;
          return;
        }
        ++submissions;
        for (int32_t& x : numbers) x = 2 * x + t;
        if (numbersOf(*out) != numbers) ++wrong;
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  CHECK(wrong == 0);
  CHECK(submissions == static_cast<int>(kThreads * often));
  CHECK(*(*queue)->reached() == kThreads * often);
  CHECK(memory.statistics().used == 0);
}
