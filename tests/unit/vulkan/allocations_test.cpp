// Tests how much host memory recording and submitting allocate.

#include "counted_heap.h"
#include "support.h"

using namespace sgm;
using namespace sgm::vulkan;

TEST_CASE("once warm, recording, submitting and waiting take no memory of the host's", "[vulkan]") {
  if (!haveDevice()) return;
  OwnDevice options;
  // The validation layer stays off, because it makes many allocations itself.
  options.software = true;
  const auto device = Device::open(options);
  REQUIRE(device);
  const uint32_t constants[] = {0, 1};
  const auto shader = Pipeline::create(**device, affineShader(constants));
  REQUIRE(shader);
  Memory memory(**device);
  const auto in = memory.buffer(MemoryKind::device, 1000);
  const auto out = memory.buffer(MemoryKind::device, 1000);
  const auto queue = Queue::create(**device);
  REQUIRE((in && out && queue));
  const auto ring = CommandRing::create(**queue, {2, 8, 2});
  REQUIRE(ring);
  const int32_t count = 250;
  const BufferRange ranges[] = {*in, *out};
  const auto submitOnce = [&] {
    auto commands = (*ring)->begin();
    if (!commands) return false;
    commands->fill(*in, 1);
    commands->barrier(kTransfer, kCompute);
    for (int i = 0; i < 8; ++i) {
      if (!commands->bind(*shader, ranges, bytesOf(count))) return false;
      commands->dispatch(4);
      commands->barrier(kCompute, kCompute);
    }
    const auto value = (*ring)->submit(std::move(*commands));
    return value && (*queue)->wait(*value) && (*queue)->reached();
  };
  for (int i = 0; i < 4; ++i) REQUIRE(submitOnce());
  bool done = true;
  const int before = allocationsOfThread();
  for (int i = 0; i < 20; ++i) done = submitOnce() && done;
  const int after = allocationsOfThread();
  CHECK(done);
  CHECK(after == before);
  const auto counted = std::make_unique<int>();
  CHECK(allocationsOfThread() > after);
}
