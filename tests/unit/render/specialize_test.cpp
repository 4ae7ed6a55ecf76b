#include "tools/render/specialize.h"
#include "seed.h"

#include <algorithm>
#include <random>

#include "catch.h"
#include "spirv/branches_comp.h"

using namespace sgm;

namespace {

// SPIR-V opcodes, section 3.42 of its specification.
constexpr uint32_t kFunction = 54, kFunctionCall = 57, kSpecConstant = 50;

size_t countOf(const std::vector<uint32_t>& code, uint32_t operation) {
  size_t count = 0;
  for (size_t at = 5; at < code.size(); at += std::max(code[at] >> 16, 1u)) count += (code[at] & 0xFFFF) == operation;
  return count;
}

std::vector<uint32_t> specializedFor(uint32_t constant) {
  const auto code = specialized(spirv::kBranchesComp, constant);
  REQUIRE(code);
  return *code;
}

}  // namespace

TEST_CASE("a specialized shader keeps the functions that its constant asks for", "[render]") {
  const std::vector<uint32_t> all = specializedFor(3), one = specializedFor(1), none = specializedFor(0);
  CHECK(countOf(all, kFunction) == 3);
  CHECK(countOf(one, kFunction) == 2);
  CHECK(countOf(none, kFunction) == 1);
  CHECK(countOf(one, kFunctionCall) == 1);
  for (const auto& code : {all, one, none}) CHECK(countOf(code, kSpecConstant) == 0);
  CHECK(none.size() < one.size());
}

TEST_CASE("data that is not a SPIR-V module is refused", "[render]") {
  const uint32_t seed = testSeed();
  INFO("seed " << seed);
  std::mt19937 random(seed);
  CHECK(!specialized({}, 0));
  std::vector<uint32_t> words(64);
  for (uint32_t& word : words) word = static_cast<uint32_t>(random());
  const auto code = specialized(words, 0);
  REQUIRE(!code);
  CHECK(code.error().message.starts_with("the shader of surfaces cannot be specialized: "));
}
