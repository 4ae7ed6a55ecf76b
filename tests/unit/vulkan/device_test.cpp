// Devices of our own and an engine's.

#include "backend/vulkan/device.h"

#include "support.h"

using namespace sgm;
using namespace sgm::vulkan;

namespace {

/// An engine with a device of its own, as the loader gives it.
struct Engine {
  std::unique_ptr<Instance> instance;
  VkPhysicalDevice physical = VK_NULL_HANDLE;
  VkDevice device = VK_NULL_HANDLE;
  VkQueue queue = VK_NULL_HANDLE;
  DeviceTable calls;
  int locks = 0, unlocks = 0, held = 0;

  Engine() {
    auto made = Instance::create({Validation::synchronization});
    REQUIRE(made);
    instance = std::move(*made);
    const auto devices = instance->devices();
    REQUIRE(devices);
    for (VkPhysicalDevice candidate : *devices) {
      if (lackOf(describe(instance->calls(), candidate)).empty()) physical = candidate;
    }
    REQUIRE(physical);
    const float priority = 1;
    VkDeviceQueueCreateInfo queue_info{};
    queue_info.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
    queue_info.queueCount = 1;
    queue_info.pQueuePriorities = &priority;
    VkPhysicalDeviceTimelineSemaphoreFeatures timeline{};
    timeline.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_TIMELINE_SEMAPHORE_FEATURES;
    timeline.timelineSemaphore = VK_TRUE;
    VkDeviceCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
    info.pNext = &timeline;
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queue_info;
    REQUIRE(instance->calls().vkCreateDevice(physical, &info, nullptr, &device) == VK_SUCCESS);
    REQUIRE(loadDevice(instance->calls(), device, calls));
    calls.vkGetDeviceQueue(device, 0, 0, &queue);
  }
  ~Engine() {
    calls.vkDestroyDevice(device, nullptr);
    CHECK(instance->messages() == std::vector<std::string>());
  }
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;

  BorrowedDevice lend() {
    BorrowedDevice lent;
    lent.get_instance_proc_addr = instance->resolver();
    lent.instance = instance->handle();
    lent.physical = physical;
    lent.device = device;
    lent.queue = queue;
    lent.lock = [](void* user) { ++static_cast<Engine*>(user)->locks, ++static_cast<Engine*>(user)->held; };
    lent.unlock = [](void* user) { ++static_cast<Engine*>(user)->unlocks, --static_cast<Engine*>(user)->held; };
    lent.user = this;
    lent.api_version = VK_API_VERSION_1_2;
    lent.timeline_semaphores = true;
    return lent;
  }
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
  // It is still the engine's.
  CHECK(engine.calls.vkDeviceWaitIdle(engine.device) == VK_SUCCESS);
}

TEST_CASE("an engine's device is used without a lock where there is none", "[vulkan]") {
  if (!haveDevice()) return;
  Engine engine;
  BorrowedDevice lent = engine.lend();
  lent.lock = lent.unlock = nullptr;
  const auto device = Device::borrow(lent);
  REQUIRE(device);
  CHECK(throughAllLayers(**device, std::vector<int32_t>{7}, {}));
  CHECK(engine.locks == 0);
}

TEST_CASE("an engine's device that will not do is refused with what it lacks", "[vulkan]") {
  if (!haveDevice()) return;
  Engine engine;
  const auto refused = [&](Code code, const char* named, auto spoil) {
    BorrowedDevice lent = engine.lend();
    spoil(lent);
    const auto device = Device::borrow(lent);
    REQUIRE(!device);
    INFO(device.error().message);
    CHECK(device.error().code == code);
    CHECK(device.error().message.find(named) != std::string::npos);
  };
  using B = BorrowedDevice;
  refused(Code::invalid_argument, "vkGetInstanceProcAddr", [](B& lent) { lent.get_instance_proc_addr = nullptr; });
  refused(Code::invalid_argument, "needs", [](B& lent) { lent.instance = VK_NULL_HANDLE; });
  refused(Code::invalid_argument, "needs", [](B& lent) { lent.physical = VK_NULL_HANDLE; });
  refused(Code::invalid_argument, "needs", [](B& lent) { lent.device = VK_NULL_HANDLE; });
  refused(Code::invalid_argument, "needs", [](B& lent) { lent.queue = VK_NULL_HANDLE; });
  refused(Code::invalid_argument, "unlock", [](B& lent) { lent.unlock = nullptr; });
  refused(Code::invalid_argument, "queue family 77", [](B& lent) { lent.family = 77; });
  refused(Code::unsupported, "1.1", [](B& lent) { lent.api_version = VK_API_VERSION_1_1; });
  refused(Code::unsupported, "timelineSemaphore", [](B& lent) { lent.timeline_semaphores = false; });
  // A resolver that knows no functions: a loader of another world.
  refused(Code::unsupported, "lacks functions", [](B& lent) {
    lent.get_instance_proc_addr = [](VkInstance, const char*) -> PFN_vkVoidFunction { return nullptr; };
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
    CHECK(bool(device) == lackOf((*devices)[i]).empty());
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
  for (const DeviceInfo& info : *devices) hardware = hardware || (!info.software() && lackOf(info).empty());
  const auto device = Device::open();
  CHECK(bool(device) == hardware);
  if (device) CHECK(!(*device)->info().software());
  if (!device) CHECK(device.error().message.find("was not asked for") != std::string::npos);
}

TEST_CASE("the validation layer is heard", "[vulkan]") {
  if (!haveDevice()) return;
  const auto device = Device::open(watched());
  REQUIRE(device);
  VkBufferCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;  // of no bytes and for no use
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
