// Tests density volumes through the C interface: they equal the header's formula for the samples, in rows of any pitch,
// with and without edits.

#include <algorithm>
#include <cmath>
#include <vector>

#include "fixture.h"

namespace {

/// A fog with one large ball, and smaller balls that coarse levels omit.
constexpr const char* kFog =
    "sgm 1; units m; domain infinite axes xz output density edge 2m;\nlayer main cell 16m reach 8m { start Puff; }\n"
    "rule Puff { at(8m, 8m, 8m) { sphere(4m); detail 1m { at(4m, 0m, 0m) sphere(2m); } } }";

constexpr uint32_t kPoints = 40;
constexpr int32_t kFirst = 2 * 1024, kSpacing = 300;

sgm_density_desc volume(sgm_density_format format, void* values) {
  sgm_density_desc desc = SGM_DENSITY_DESC_INIT;
  for (int32_t& at : desc.origin) at = kFirst;
  desc.spacing = kSpacing;
  for (uint32_t& size : desc.size) size = kPoints;
  desc.format = format;
  desc.values = values;
  return desc;
}

/// Computes the expected densities from the samples of all points by the formula that sgm_density_desc documents.
std::vector<float> expected(sgm_field* field, double edge_metres, double cell_units, int32_t level) {
  std::vector<int32_t> points;
  for (uint32_t i = 0; i < kPoints * kPoints * kPoints; ++i) {
    for (const uint32_t at : {i % kPoints, i / kPoints % kPoints, i / kPoints / kPoints})
      points.push_back(kFirst + static_cast<int32_t>(at) * kSpacing);
  }
  std::vector<int32_t> q(points.size() / 3);
  sgm_sample_desc desc = SGM_SAMPLE_DESC_INIT;
  desc.points = points.data();
  desc.count = q.size();
  desc.level = level;
  desc.q = q.data();
  REQUIRE(sgm_field_sample(field, &desc, nullptr) == SGM_OK);
  const auto inverse = static_cast<float>(1 / (edge_metres * SGM_UNITS_PER_METRE * 1024 / cell_units));
  std::vector<float> density;
  for (const int32_t sample : q) {
    const float t = std::min(std::max(static_cast<float>(-sample) * inverse, 0.0f), 1.0f), rest = 1 - t;
    density.push_back(t < 0.5f ? 2 * (t * t) : 1 - 2 * (rest * rest));
  }
  return density;
}

}  // namespace

TEST_CASE("a density volume holds what the header says of the field's samples, at every level and edge") {
  const RuntimeOwner runtime = makeRuntime();
  const GrammarOwner grammar = compile(runtime.get(), kFog);
  const FieldOwner field = makeField(runtime.get(), grammar.get(), 256);
  sgm_domain_info domain = SGM_DOMAIN_INFO_INIT;
  REQUIRE(sgm_grammar_domain(grammar.get(), &domain) == SGM_OK);
  CHECK(domain.density_edge == 2.0f);
  std::vector<float> values(kPoints * kPoints * kPoints), plain, coarse;
  for (const double edge : {0.0, 2.0, 0.7, 5.0}) {
    for (const int32_t level : {0, 4}) {
      std::fill(values.begin(), values.end(), -1.0f);
      sgm_density_desc desc = volume(SGM_DENSITY_FLOAT32, values.data());
      desc.edge = edge;
      desc.level = level;
      REQUIRE(sgm_field_sample_density(field.get(), &desc, nullptr) == SGM_OK);
      CHECK(values == expected(field.get(), edge == 0 ? 2.0 : edge, 256, level));
      CHECK(*std::max_element(values.begin(), values.end()) > 0.5f);
      if (edge == 0) (level == 0 ? plain : coarse) = values;
    }
  }
  CHECK(plain != coarse);
}

TEST_CASE("rows of a density volume lie where their pitches say, and nothing else is written") {
  const RuntimeOwner runtime = makeRuntime();
  const FieldOwner field = makeField(runtime.get(), compile(runtime.get(), kFog).get(), 256);
  std::vector<float> values(kPoints * kPoints * kPoints);
  sgm_density_desc desc = volume(SGM_DENSITY_FLOAT32, values.data());
  REQUIRE(sgm_field_sample_density(field.get(), &desc, nullptr) == SGM_OK);
  constexpr size_t kRow = 256, kSlice = kRow * (kPoints + 3);
  std::vector<uint8_t> bytes(kSlice * kPoints, 99);
  desc = volume(SGM_DENSITY_UNORM8, bytes.data());
  desc.row_pitch = kRow;
  desc.slice_pitch = kSlice;
  uint64_t told = 0;
  desc.progress_user = &told;
  desc.progress = [](void* user, uint64_t done, uint64_t) -> int32_t {
    *static_cast<uint64_t*>(user) = done;
    return 0;
  };
  REQUIRE(sgm_field_sample_density(field.get(), &desc, nullptr) == SGM_OK);
  CHECK(told == 8);
  size_t wrong = 0, i = 0;
  for (size_t z = 0; z < kPoints; ++z) {
    for (size_t y = 0; y < kPoints + 3; ++y) {
      for (size_t x = 0; x < kRow; ++x) {
        const uint8_t byte = bytes[z * kSlice + y * kRow + x];
        const bool in = x < kPoints && y < kPoints;
        wrong += byte != (in ? static_cast<uint8_t>(std::floor(values[i] * 255 + 0.5f)) : 99);
        i += in;
      }
    }
  }
  CHECK(i == values.size());
  CHECK(wrong == 0);
}

TEST_CASE("what is dug out of a world's fog is clear, and its undo brings it back") {
  const RuntimeOwner runtime = makeRuntime();
  const FieldOwner field = makeField(runtime.get(), compile(runtime.get(), kFog).get(), 256);
  const WorldOwner world = makeWorld(field.get());
  std::vector<uint8_t> before(kPoints * kPoints * kPoints), after(before.size()), undone(before.size());
  const auto sample = [&](std::vector<uint8_t>& into) {
    const sgm_density_desc desc = volume(SGM_DENSITY_UNORM8, into.data());
    REQUIRE(sgm_world_sample_density(world.get(), &desc, nullptr) == SGM_OK);
  };
  sample(before);
  sgm_brush brush = SGM_BRUSH_INIT;
  for (int32_t& at : brush.from) at = 8 * 1024;
  brush.radius = 2 * 1024;
  sgm_edit_id id{};
  REQUIRE(sgm_world_edit(world.get(), &brush, &id, nullptr) == SGM_OK);
  sample(after);
  size_t dug = 0, grown = 0, kept = 0;
  for (size_t i = 0; i < before.size(); ++i) {
    const size_t at[3] = {i % kPoints, i / kPoints % kPoints, i / kPoints / kPoints};
    double away = 0;
    for (size_t axis = 0; axis < 3; ++axis)
      away += std::pow(kFirst + static_cast<int32_t>(at[axis]) * kSpacing - brush.from[axis], 2);
    const bool within = std::sqrt(away) < brush.radius - 2;
    if (within) kept += after[i] != 0;
    dug += within && before[i] != 0;
    grown += after[i] > before[i];
  }
  CHECK(dug > 100);
  CHECK(kept == 0);
  CHECK(grown == 0);
  std::vector<uint8_t> field_alone(before.size());
  const sgm_density_desc desc = volume(SGM_DENSITY_UNORM8, field_alone.data());
  REQUIRE(sgm_field_sample_density(field.get(), &desc, nullptr) == SGM_OK);
  CHECK(field_alone == before);
  REQUIRE(sgm_world_undo(world.get(), &id, nullptr, nullptr) == SGM_OK);
  sample(undone);
  CHECK(undone == before);
}
