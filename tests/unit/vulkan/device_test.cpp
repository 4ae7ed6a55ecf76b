// Tests Vulkan devices that the library creates itself, and devices that it borrows from an engine.

#include "backend/vulkan/device.h"

#include "engine.h"
#include "support.h"

using namespace sgm;
using namespace sgm::vulkan;

namespace {

/// Sets an environment variable for the lifetime of this object.
struct Environment {
  const char* name;
  Environment(const char* variable, const char* value) : name(variable) { setenv(name, value, 1); }
  ~Environment() { unsetenv(name); }
};

}  // namespace

TEST_CASE("an engine's device is used under its lock and left as it was", "[vulkan]") {
  if (!haveDevice()) return;
  Engine engine;
  const std::vector<int32_t> numbers{1, 2, 3};
  for (int round = 0; round < 2; ++round) {
    const auto device = Device::borrow(engine.lend());
    INFO((device ? std::string() : device.error().message));
    REQUIRE(device);
    CHECK((*device)->borrowed());
    CHECK((*device)->queue() == engine.queue);
    const auto back = throughAllLayers(**device, numbers, {});
    REQUIRE(back);
    CHECK(*back == std::vector<int32_t>{29, 38, 47});
    CHECK(engine.locks == round + 1);
    CHECK(engine.unlocks == round + 1);
    CHECK(engine.held == 0);
  }
  // After the library's device is destroyed, the engine's device still works.
  CHECK(engine.calls.vkDeviceWaitIdle(engine.device) == VK_SUCCESS);
}

TEST_CASE("an engine's device is used without a lock where there is none", "[vulkan]") {
  if (!haveDevice()) return;
  Engine engine;
  BorrowedDevice external = engine.lend();
  external.lock = external.unlock = nullptr;
  const auto device = Device::borrow(external);
  REQUIRE(device);
  CHECK(throughAllLayers(**device, std::vector<int32_t>{7}, {}));
  CHECK(engine.locks == 0);
}

TEST_CASE("an engine's device that will not do is refused with what it lacks", "[vulkan]") {
  if (!haveDevice()) return;
  Engine engine;
  const auto refused = [&](Code code, const char* named, auto spoil) {
    BorrowedDevice external = engine.lend();
    spoil(external);
    const auto device = Device::borrow(external);
    REQUIRE(!device);
    INFO(device.error().message);
    CHECK(device.error().code == code);
    CHECK(device.error().message.find(named) != std::string::npos);
  };
  using B = BorrowedDevice;
  refused(Code::invalid_argument, "vkGetInstanceProcAddr",
          [](B& external) { external.get_instance_proc_addr = nullptr; });
  refused(Code::invalid_argument, "needs", [](B& external) { external.instance = VK_NULL_HANDLE; });
  refused(Code::invalid_argument, "needs", [](B& external) { external.physical = VK_NULL_HANDLE; });
  refused(Code::invalid_argument, "needs", [](B& external) { external.device = VK_NULL_HANDLE; });
  refused(Code::invalid_argument, "needs", [](B& external) { external.queue = VK_NULL_HANDLE; });
  refused(Code::invalid_argument, "unlock", [](B& external) { external.unlock = nullptr; });
  refused(Code::invalid_argument, "queue family 77", [](B& external) { external.family = 77; });
  refused(Code::unsupported, "1.1", [](B& external) { external.api_version = VK_API_VERSION_1_1; });
  refused(Code::unsupported, "timelineSemaphore", [](B& external) { external.timeline_semaphores = false; });
  // A resolver that knows no functions, like that of another loader.
  refused(Code::unsupported, "lacks functions", [](B& external) {
    external.get_instance_proc_addr = [](VkInstance, const char*) -> PFN_vkVoidFunction { return nullptr; };
  });
}

TEST_CASE("a device of our own is chosen by its number or its kind", "[vulkan]") {
  if (!haveDevice()) return;
  const auto devices = listDevices();
  REQUIRE(devices);
  for (size_t i = 0; i < devices->size(); ++i) {
    OwnDevice options;
    options.index = static_cast<int>(i);
    const auto device = Device::open(options);
    CHECK(bool(device) == unsupportedReason((*devices)[i]).empty());
    if (device) CHECK((*device)->info().name == (*devices)[i].name);
  }
  OwnDevice beyond;
  beyond.index = static_cast<int>(devices->size());
  const auto none = Device::open(beyond);
  REQUIRE(!none);
  CHECK(none.error().code == Code::unsupported);
  CHECK(none.error().message.find("counted from 0") != std::string::npos);
}

TEST_CASE("a software device is taken only where it was asked for", "[vulkan]") {
  if (!haveDevice()) return;
  const auto devices = listDevices();
  REQUIRE(devices);
  bool hardware = false;
  for (const DeviceInfo& info : *devices) hardware = hardware || (!info.software() && unsupportedReason(info).empty());
  const auto device = Device::open();
  CHECK(bool(device) == hardware);
  if (device) CHECK(!(*device)->info().software());
  if (!device) CHECK(device.error().message.find("was not requested") != std::string::npos);
}

TEST_CASE("the validation layer is heard", "[vulkan]") {
  if (!haveDevice()) return;
  const auto device = Device::open(watched());
  REQUIRE(device);
  VkBufferCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;  // an invalid buffer: its size and its usage are 0
  VkBuffer buffer = VK_NULL_HANDLE;
  if ((*device)->calls().vkCreateBuffer((*device)->handle(), &info, nullptr, &buffer) == VK_SUCCESS) {
    (*device)->calls().vkDestroyBuffer((*device)->handle(), buffer, nullptr);
  }
  CHECK(!(*device)->messages().empty());
}

TEST_CASE("shaders are watched on the device where that is asked for", "[vulkan]") {
  if (!haveDevice()) return;
  OwnDevice options = watched();
  options.validation = Validation::gpu_assisted;
  const auto device = Device::open(options);
  REQUIRE(device);
  const auto back = throughAllLayers(**device, std::vector<int32_t>{1}, {});
  REQUIRE(back);
  CHECK(*back == std::vector<int32_t>{29});
  CHECK((*device)->messages() == std::vector<std::string>());
}

TEST_CASE("a shader that reaches beyond its buffer is heard", "[vulkan]") {
  if (!haveDevice()) return;
  OwnDevice options = watched();
  options.validation = Validation::gpu_assisted;
  const auto device = Device::open(options);
  REQUIRE(device);
  const uint32_t constants[] = {0, 1};
  const auto shader = Pipeline::create(**device, affineShader(constants));
  REQUIRE(shader);
  // The validation layer checks bounds of whole VkBuffers only, so each of our buffers gets a block of its own here.
  MemoryOptions small;
  small.first_block = small.largest_block = 64 * sizeof(int32_t);
  Memory memory(**device, small);
  const auto in = memory.buffer(MemoryKind::device, 64 * sizeof(int32_t));
  const auto out = memory.buffer(MemoryKind::device, 64 * sizeof(int32_t));
  const auto queue = Queue::create(**device);
  REQUIRE((in && out && queue));
  const auto ring = CommandRing::create(**queue);
  REQUIRE(ring);
  for (const int32_t count : {64, 65}) {
    auto commands = (*ring)->begin();
    REQUIRE(commands);
    commands->fill(*in, 1);
    commands->barrier(kTransfer, kCompute);
    REQUIRE(commands->bind(*shader, std::array<BufferRange, 2>{*in, *out}, bytesOf(count)));
    commands->dispatch(2);
    const auto value = (*ring)->submit(std::move(*commands));
    REQUIRE(value);
    REQUIRE((*queue)->wait(*value));
    for (const std::string& text : (*device)->messages()) UNSCOPED_INFO(text);
    CHECK((*device)->messages().empty() == (count == 64));
  }
}

TEST_CASE("where there is no driver or no validation layer, the error says what to install", "[vulkan]") {
  if (!haveDevice()) return;
  {
    const Environment no_layers("VK_LAYER_PATH", "/nowhere");
    const auto device = Device::open(watched());
    REQUIRE(!device);
    CHECK(device.error().code == Code::unsupported);
    CHECK(device.error().message.find("vulkan-validationlayers") != std::string::npos);
  }
  const Environment no_drivers("VK_ICD_FILENAMES", "/nowhere/driver.json");
  const auto device = Device::open();
  REQUIRE(!device);
  CHECK(device.error().code == Code::unsupported);
  CHECK(device.error().message.find("driver") != std::string::npos);
}

TEST_CASE("a missing barrier is heard", "[vulkan]") {
  if (!haveDevice()) return;
  const auto device = Device::open(watched());
  REQUIRE(device);
  Memory memory(**device);
  const auto buffer = memory.buffer(MemoryKind::device, 256);
  const auto queue = Queue::create(**device);
  REQUIRE(buffer);
  REQUIRE(queue);
  const auto ring = CommandRing::create(**queue);
  REQUIRE(ring);
  for (const bool guarded : {true, false}) {
    auto commands = (*ring)->begin();
    REQUIRE(commands);
    commands->fill(*buffer, 1);
    if (guarded) commands->barrier(kTransfer, kTransfer);
    commands->fill(*buffer, 2);
    REQUIRE((*ring)->submit(std::move(*commands)));
    CHECK((*device)->messages().empty() == guarded);
  }
}
