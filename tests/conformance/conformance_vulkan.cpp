// Tests the GLSL version of the operations: a compute shader evaluates random programs, and every bit must equal the
// CPU's.

#include <bit>
#include <cstdlib>
#include <iostream>
#include <span>

#include "catch.h"
#include "conformance/vulkan_compute.h"
#include "field/density.h"
#include "random_programs.h"
#include "spirv/density_comp.h"
#include "spirv/field_comp.h"
#include "spirv/field_rte_comp.h"

using namespace sgm;

namespace {

bool required() { return std::getenv("SGM_REQUIRE_VULKAN") || std::getenv("SGM_REQUIRE_ALL"); }

// The contents of the buffers of shaders/conformance/field.glsl, as words.
struct Packed {
  std::vector<uint32_t> instrs, params, groups, points, results;
};

Packed pack(const ProgramView& program, const PointSet& points) {
  Packed p;
  for (const Instr& in : program.instrs) {
    p.instrs.push_back(static_cast<uint32_t>(in.op) | uint32_t{in.dst} << 8 | uint32_t{in.a} << 16 |
                       uint32_t{in.b} << 24);
    p.instrs.push_back(in.c | uint32_t{in.place} << 8);
    p.instrs.push_back(in.params);
  }
  p.params.assign(program.params.begin(), program.params.end());
  for (size_t i = 0; i < program.groups.size(); ++i) {
    const ProgramGroup& g = program.groups[i];
    auto sameCuts = [&](size_t j) { return program.groups[j].cut && program.groups[j].layer == g.layer; };
    const bool first_cut = g.cut && (i == 0 || !sameCuts(i - 1));
    const bool last_cut = g.cut && (i + 1 == program.groups.size() || !sameCuts(i + 1));
    for (Int3 corner : {g.influence.lo, g.influence.hi}) {
      for (int axis = 0; axis < 3; ++axis) p.groups.push_back(static_cast<uint32_t>(corner[axis]));
    }
    p.groups.insert(p.groups.end(),
                    {g.first, g.count, g.result,
                     uint32_t{g.cut} | uint32_t{g.guarded} << 1 | uint32_t{first_cut} << 2 | uint32_t{last_cut} << 3,
                     std::bit_cast<uint32_t>(g.smooth)});
  }
  for (size_t i = 0; i < points.x.size(); ++i) {
    for (int32_t c : {points.x[i], points.y[i], points.z[i]}) p.points.push_back(static_cast<uint32_t>(c));
  }
  p.results.resize(8 * points.x.size());
  // Vulkan does not allow empty storage buffers, so add a word.
  for (std::vector<uint32_t>* words : {&p.instrs, &p.params, &p.groups})
    words->resize(std::max<size_t>(words->size(), 1));
  return p;
}

Evaluated unpack(const Packed& p) {
  Evaluated e;
  for (size_t i = 0; i + 8 <= p.results.size(); i += 8) {
    const uint32_t* r = p.results.data() + i;
    e.q.push_back(static_cast<int32_t>(r[0]));
    e.value.push_back(std::bit_cast<float>(r[1]));
    e.gx.push_back(std::bit_cast<float>(r[2]));
    e.gy.push_back(std::bit_cast<float>(r[3]));
    e.gz.push_back(std::bit_cast<float>(r[4]));
    e.nx.push_back(static_cast<int16_t>(static_cast<int32_t>(r[5])));
    e.ny.push_back(static_cast<int16_t>(static_cast<int32_t>(r[6])));
    e.label.push_back(r[7]);
  }
  return e;
}

size_t differentOnDevice(const ComputeShader& shader, const ProgramView& program, const PointSet& points) {
  Packed p = pack(program, points);
  const ComputeBuffer buffers[] = {computeBuffer(std::span(p.instrs)), computeBuffer(std::span(p.params)),
                                   computeBuffer(std::span(p.groups)), computeBuffer(std::span(p.points)),
                                   computeBuffer(std::span(p.results))};
  const uint32_t push[] = {static_cast<uint32_t>(points.x.size()), static_cast<uint32_t>(program.groups.size()),
                           std::bit_cast<uint32_t>(program.initial), program.initial_label,
                           std::bit_cast<uint32_t>(program.q_scale)};
  const Result<void> ran =
      shader.run(buffers, std::as_bytes(std::span(push)), static_cast<uint32_t>(points.x.size() + 63) / 64);
  INFO((ran ? "" : ran.error().message));
  REQUIRE(ran);
  return differentBits(evaluate(scalarKernels(), program, points.points()), unpack(p));
}

}  // namespace

TEST_CASE("the GLSL of every op gives the scalar evaluator's bits") {
  Result<std::optional<VulkanCompute>> device = VulkanCompute::create(required(), true);
  INFO((device ? "" : device.error().message));
  REQUIRE(device);
  if (!*device) return;  // no device: the reason has been printed to stderr
  const bool rte = (*device)->info().exact;
  std::cout << "device: " << (*device)->info().name << ", shader: "
            << (rte ? "field_rte.comp (RoundingModeRTE 32)" : "field.comp (no rounding can be demanded here)") << '\n';
  const std::span<const uint32_t> code =
      rte ? std::span<const uint32_t>(spirv::kFieldRteComp) : std::span<const uint32_t>(spirv::kFieldComp);
  const Result<ComputeShader> shader = (*device)->shader(code, 5, 5 * sizeof(uint32_t));
  INFO((shader ? "" : shader.error().message));
  REQUIRE(shader);
  const Int3 centres[] = {{0, 0, 0}, {2'000'000'000, -2'000'000'000, 1'999'000'000}};

  for (int o = 0; o < static_cast<int>(Op::count); ++o) {
    for (uint32_t seed = 1; seed <= 4; ++seed) {
      std::mt19937 random(seed);
      const Int3 centre = centres[seed % 2];
      const FieldProgram program = programOf(static_cast<Op>(o), random, centre);
      const PointSet points = randomPoints(random, centre, 40'000, 1000);
      INFO(opName(static_cast<Op>(o)) << ", seed " << seed);
      CHECK(differentOnDevice(*shader, program.view(), points) == 0);
    }
  }
  for (uint32_t seed = 1; seed <= 40; ++seed) {
    std::mt19937 random(seed * 13);
    RandomProgramOptions options;
    options.centre = centres[seed % 2];
    options.odd = {seed % 5 == 1, seed % 5 == 2};
    options.groups = 4;
    options.smooth_groups = static_cast<int>(seed % 4);
    const FieldProgram program = randomProgram(random, options);
    const PointSet points = randomPoints(random, options.centre, 3 * options.extent, 2000);
    INFO("random program, seed " << seed);
    CHECK(differentOnDevice(*shader, program.view(), points) == 0);
  }
  const std::vector<std::string> messages = (*device)->messages();
  for (const std::string& m : messages) std::cout << m << '\n';
  CHECK(messages.empty());
}

TEST_CASE("GLSL makes the same density of every sample") {
  auto compute = VulkanCompute::create(required(), true);
  INFO((compute ? std::string() : compute.error().message));
  REQUIRE(compute);
  if (!*compute) return;
  const auto shader = (*compute)->shader(spirv::kDensityComp, 2, 8);
  REQUIRE(shader);
  std::vector<int32_t> q;
  for (int32_t i = -70'000; i <= 100; ++i) q.push_back(i);
  for (int32_t i = 0; i <= 70'000; ++i) q.push_back(-4'194'304 + i * 59);
  std::mt19937 random(7);
  for (int round = 0; round < 40; ++round) {
    const double edge = std::exp2(static_cast<double>(random() % 22'000) / 1000);
    const DensityEdge rule = densityEdge(edge, 1024);
    std::vector<float> values(q.size());
    std::vector<uint8_t> bytes(q.size());
    densities(q, rule, values.data());
    densities(q, rule, bytes.data());
    std::vector<uint32_t> results(2 * q.size());
    const ComputeBuffer buffers[] = {computeBuffer(std::span(q)), computeBuffer(std::span(results))};
    const uint32_t push[] = {static_cast<uint32_t>(q.size()), std::bit_cast<uint32_t>(rule.inverse)};
    REQUIRE(shader->run(buffers, std::as_bytes(std::span(push)), static_cast<uint32_t>(q.size() + 63) / 64));
    size_t different = 0;
    for (size_t i = 0; i < q.size(); ++i)
      different += results[2 * i] != std::bit_cast<uint32_t>(values[i]) || results[2 * i + 1] != bytes[i];
    INFO("edge " << edge);
    CHECK(different == 0);
  }
  CHECK((*compute)->messages().empty());
}
