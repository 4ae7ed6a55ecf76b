// Makes every call that can fail do so once: an error must describe the failure, and nothing may be left behind.

#include "faults.h"

#include <set>

#include "engine.h"
#include "support.h"

using namespace sgm;
using namespace sgm::vulkan;

namespace {

/// The error codes that a Vulkan function may return.
std::vector<VkResult> failuresOf(const std::string& function) {
  const std::set<std::string> of_the_queue{"vkQueueSubmit", "vkWaitSemaphores", "vkGetSemaphoreCounterValue"};
  std::vector<VkResult> failures{VK_ERROR_OUT_OF_HOST_MEMORY, VK_ERROR_OUT_OF_DEVICE_MEMORY};
  if (of_the_queue.count(function)) failures = {VK_ERROR_DEVICE_LOST, VK_ERROR_OUT_OF_HOST_MEMORY};
  if (function == "vkCreateDevice") failures.push_back(VK_ERROR_INITIALIZATION_FAILED);
  if (function == "vkMapMemory") failures.push_back(VK_ERROR_MEMORY_MAP_FAILED);
  if (function == "vkAllocateDescriptorSets") failures.push_back(VK_ERROR_OUT_OF_POOL_MEMORY);
  if (function == "vkAllocateMemory") failures.push_back(VK_ERROR_TOO_MANY_OBJECTS);
  return failures;
}

Code codeOf(VkResult failure) {
  switch (failure) {
    case VK_ERROR_DEVICE_LOST:
      return Code::device_lost;
    case VK_ERROR_TOO_MANY_OBJECTS:
      return Code::limit;
    case VK_ERROR_INITIALIZATION_FAILED:
      return Code::unsupported;
    default:
      return Code::out_of_memory;
  }
}

/// Whether the library compensates for failures of this function, or no longer needs its result.
bool mayBeMadeGood(const std::string& function) {
  const std::set<std::string> functions{"vkCreateBuffer",
                                        "vkAllocateMemory",
                                        "vkBindBufferMemory",
                                        "vkMapMemory",  // if it fails, the library tries a smaller block
                                        "vkWaitSemaphores",
                                        "vkDeviceWaitIdle",  // called only before everything is destroyed
                                        "vkEnumerateDeviceExtensionProperties"};  // on failure, the budget is unknown
  return functions.count(function) != 0;
}

Result<std::vector<int32_t>> runOn(const Result<std::unique_ptr<Device>>& device) {
  if (!device) return device.error();
  return throughAllLayers(**device, std::vector<int32_t>{1, 2, 3}, {});
}

Result<std::vector<int32_t>> runOnOwn(const std::shared_ptr<MessageLog>& log) {
  OwnDevice options = watched(log);
  options.replace_instance_calls = [](InstanceTable& table) { Faults::wrap(table); };
  options.replace_calls = [](DeviceTable& table) { Faults::wrap(table); };
  return runOn(Device::open(options));
}

Result<std::vector<int32_t>> runOnBorrowed(Engine& engine) {
  BorrowedDevice external = engine.lend();
  external.replace_calls = [](DeviceTable& table) { Faults::wrap(table); };
  return runOn(Device::borrow(external));
}

/// Makes every function that `run` calls fail at each call that `wanted` selects; the validation layer must report
/// nothing.
template <class Run, class Wanted, class Quiet>
void failEverywhere(Run run, Wanted wanted, Quiet quiet) {
  const std::vector<int32_t> expected{29, 38, 47};
  Faults faults;
  const auto whole = run();
  REQUIRE(whole);
  REQUIRE(*whole == expected);
  const std::map<std::string, unsigned> counts = faults.counts();
  REQUIRE(counts.size() > 20);
  for (const auto& [function, calls] : counts) {
    for (const VkResult failure : failuresOf(function)) {
      for (unsigned nth = 1; nth <= calls; ++nth) {
        if (!wanted(nth)) continue;
        CAPTURE(function, nth, static_cast<int>(failure));
        faults.arm(function, nth, failure);
        const auto result = run();
        REQUIRE(faults.struck());
        if (result) {
          CHECK(mayBeMadeGood(function));
          CHECK(*result == expected);
        } else {
          INFO(result.error().message);
          CHECK(result.error().code == codeOf(failure));
          CHECK(result.error().message.find("VkResult " + std::to_string(failure)) != std::string::npos);
        }
        REQUIRE(quiet());
      }
    }
  }
}

}  // namespace

TEST_CASE("every call may fail on a device of our own", "[vulkan]") {
  if (!haveDevice()) return;
  const auto log = std::make_shared<MessageLog>();
  // Here, only the first call of each function fails. Later calls fail in the test with an engine's device, which need
  // not be opened each time.
  failEverywhere([&] { return runOnOwn(log); }, [](unsigned nth) { return nth == 1; },
                 [&] { return log->texts().empty(); });
}

TEST_CASE("every call may fail on an engine's device, which is left as it was", "[vulkan]") {
  if (!haveDevice()) return;
  Engine engine;
  failEverywhere([&] { return runOnBorrowed(engine); }, [](unsigned) { return true; },
                 [&] { return engine.held == 0 && engine.instance->messages().empty(); });
}

TEST_CASE("a lost device stays lost", "[vulkan]") {
  TestDevice watched_device;
  if (!watched_device) return;
  OwnDevice options = watched(watched_device.log);
  options.replace_calls = [](DeviceTable& table) { Faults::wrap(table); };
  for (const char* where : {"vkQueueSubmit", "vkWaitSemaphores", "vkGetSemaphoreCounterValue"}) {
    CAPTURE(where);
    Faults faults;
    const auto device = Device::open(options);
    REQUIRE(device);
    const auto queue = Queue::create(**device);
    REQUIRE(queue);
    const auto ring = CommandRing::create(**queue);
    REQUIRE(ring);
    auto commands = (*ring)->begin();
    auto more = (*ring)->begin();
    REQUIRE(commands);
    REQUIRE(more);
    const auto first = (*ring)->submit(std::move(*commands));
    REQUIRE(first);
    faults.arm(where, 1, VK_ERROR_DEVICE_LOST);
    const auto lost = [](const auto& result) { return !result && result.error().code == Code::device_lost; };
    if (std::string(where) == "vkQueueSubmit") CHECK(lost((*ring)->submit(std::move(*more))));
    if (std::string(where) == "vkWaitSemaphores") CHECK(lost((*queue)->wait(*first)));
    if (std::string(where) == "vkGetSemaphoreCounterValue") CHECK(lost((*queue)->reached()));
    REQUIRE(faults.struck());
    CHECK((*queue)->lost());
    CHECK(lost((*queue)->wait(*first)));
    CHECK(lost((*queue)->reached()));
    CHECK(lost((*ring)->begin()));
  }
}

TEST_CASE("a submission that finds no memory may be made again", "[vulkan]") {
  TestDevice watched_device;
  if (!watched_device) return;
  Faults faults;
  OwnDevice options = watched(watched_device.log);
  options.replace_calls = [](DeviceTable& table) { Faults::wrap(table); };
  const auto device = Device::open(options);
  REQUIRE(device);
  const auto queue = Queue::create(**device);
  REQUIRE(queue);
  const auto ring = CommandRing::create(**queue);
  REQUIRE(ring);
  for (uint64_t expected = 1; expected <= 2; ++expected) {
    faults.arm("vkQueueSubmit", 1, VK_ERROR_OUT_OF_DEVICE_MEMORY);
    auto commands = (*ring)->begin();
    REQUIRE(commands);
    const auto refused = (*ring)->submit(std::move(*commands));
    REQUIRE(!refused);
    CHECK(refused.error().code == Code::out_of_memory);
    CHECK((*queue)->submitted() == expected - 1);
    auto again = (*ring)->begin();
    REQUIRE(again);
    const auto value = (*ring)->submit(std::move(*again));
    REQUIRE(value);
    CHECK(*value == expected);
    CHECK(*(*queue)->wait(*value));
  }
}

TEST_CASE("memory that the driver refuses is asked for in smaller blocks, and then refused", "[vulkan]") {
  TestDevice watched_device;
  if (!watched_device) return;
  Faults faults;
  OwnDevice options = watched(watched_device.log);
  options.replace_calls = [](DeviceTable& table) { Faults::wrap(table); };
  const auto device = Device::open(options);
  REQUIRE(device);
  MemoryOptions small;
  small.first_block = 1 << 20;
  Memory memory(**device, small);
  faults.arm("vkAllocateMemory", 1, VK_ERROR_OUT_OF_DEVICE_MEMORY);
  const auto half = memory.buffer(MemoryKind::device, 1000);
  CHECK(half);
  CHECK(memory.statistics().reserved == 1 << 19);
  faults.arm("vkAllocateMemory", 1, VK_ERROR_OUT_OF_DEVICE_MEMORY);
  const auto refused = memory.buffer(MemoryKind::device, 16 << 20);
  REQUIRE(!refused);
  CHECK(refused.error().code == Code::out_of_memory);
  CHECK(memory.statistics().blocks == 1);
  CHECK(memory.statistics().used == 1000);
  faults.disarm();
  CHECK(memory.buffer(MemoryKind::device, 16 << 20));
}

TEST_CASE("a wait that ends too early says so", "[vulkan]") {
  TestDevice watched_device;
  if (!watched_device) return;
  Faults faults;
  OwnDevice options = watched(watched_device.log);
  options.replace_calls = [](DeviceTable& table) { Faults::wrap(table); };
  const auto device = Device::open(options);
  REQUIRE(device);
  const auto queue = Queue::create(**device);
  REQUIRE(queue);
  const auto ring = CommandRing::create(**queue, {1, 1, 1});
  REQUIRE(ring);
  auto commands = (*ring)->begin();
  REQUIRE(commands);
  const auto value = (*ring)->submit(std::move(*commands));
  REQUIRE(value);
  faults.arm("vkWaitSemaphores", 1, VK_TIMEOUT);
  const auto ended = (*queue)->wait(*value, 1);
  REQUIRE(ended);
  CHECK(!*ended);
  CHECK(!(*queue)->lost());
  CHECK(*(*queue)->wait(*value));
}

TEST_CASE("nothing is destroyed while it is in use, whatever the last wait says", "[vulkan]") {
  TestDevice watched_device;
  if (!watched_device) return;
  Faults faults;
  OwnDevice options = watched(watched_device.log);
  options.replace_calls = [](DeviceTable& table) { Faults::wrap(table); };
  const auto device = Device::open(options);
  REQUIRE(device);
  Memory memory(**device);
  const auto buffer = memory.buffer(MemoryKind::device, 32 << 20);
  const auto queue = Queue::create(**device);
  REQUIRE((buffer && queue));
  auto ring = CommandRing::create(**queue);
  REQUIRE(ring);
  auto commands = (*ring)->begin();
  REQUIRE(commands);
  for (uint32_t i = 0; i < 20; ++i) {  // so much work that it is still running when the wait fails at once
    commands->fill(*buffer, i);
    commands->barrier(kTransfer, kTransfer);
  }
  REQUIRE((*ring)->submit(std::move(*commands)));
  faults.arm("vkWaitSemaphores", 1, VK_ERROR_OUT_OF_HOST_MEMORY);
  ring->reset();
  CHECK(faults.struck());
  CHECK((*device)->messages() == std::vector<std::string>());
}
