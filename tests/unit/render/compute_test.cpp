#include "conformance/vulkan_compute.h"
#include "scenes.h"
#include "spirv/scale_comp.h"

using namespace sgm;

namespace {

struct Push {
  int32_t factor, count;
};

std::optional<VulkanCompute> testCompute() {
  auto compute = VulkanCompute::create(vulkanRequired(), true);
  INFO((compute ? std::string() : compute.error().message));
  REQUIRE(compute);
  return std::move(*compute);
}

}  // namespace

TEST_CASE("a compute shader reads and writes storage buffers", "[render]") {
  auto compute = testCompute();
  if (!compute) return;
  CHECK(!compute->info().name.empty());
  const auto shader = compute->shader(spirv::kScaleComp, 2, sizeof(Push));
  REQUIRE(shader);
  for (const int32_t count : {1, 63, 64, 65, 1234}) {
    std::vector<int32_t> in(static_cast<size_t>(count)), out(in.size(), 7);
    for (size_t i = 0; i < in.size(); ++i) in[i] = static_cast<int32_t>(i) - 5;
    const ComputeBuffer buffers[] = {computeBuffer(std::span(in)), computeBuffer(std::span(out))};
    const Push push{-3, count};
    auto done = shader->run(buffers, std::as_bytes(std::span(&push, 1)), static_cast<uint32_t>(count + 63) / 64);
    REQUIRE(done);
    for (size_t i = 0; i < in.size(); ++i) REQUIRE(out[i] == 7 - 3 * (static_cast<int32_t>(i) - 5));
  }
  for (const std::string& message : compute->messages()) UNSCOPED_INFO(message);
  CHECK(compute->messages().empty());
}

TEST_CASE("a shader or a run that makes no sense is refused", "[render]") {
  auto compute = testCompute();
  if (!compute) return;
  std::vector<int32_t> data(64);
  const ComputeBuffer good[] = {computeBuffer(std::span(data)), computeBuffer(std::span(data))};
  const std::vector<std::byte> push(sizeof(Push)), short_push(4);
  const auto refused = [](const auto& result) {
    return !result && result.error().code == Code::invalid_argument && !result.error().message.empty();
  };
  CHECK(refused(compute->shader({}, 2, sizeof(Push))));
  CHECK(refused(compute->shader(spirv::kScaleComp, 0, sizeof(Push))));
  CHECK(refused(compute->shader(spirv::kScaleComp, 2, 132)));
  CHECK(refused(compute->shader(spirv::kScaleComp, 2, 7)));
  const auto shader = compute->shader(spirv::kScaleComp, 2, sizeof(Push));
  REQUIRE(shader);
  const ComputeBuffer with_empty[] = {good[0], ComputeBuffer{}};
  CHECK(refused(shader->run(with_empty, push, 1)));
  CHECK(refused(shader->run(std::span(good).first(1), push, 1)));
  CHECK(refused(shader->run(good, short_push, 1)));
  CHECK(refused(shader->run(good, push, 0)));
  CHECK(compute->messages().empty());
}
