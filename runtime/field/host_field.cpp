#include "field/host_field.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "field/compile.h"

namespace sgm {

namespace {

constexpr double kNoLimit = 1e18, kLargestSample = 1e12;
constexpr double kStepsAUnit = 1024;
/// Of the samples of a box that is far from the surface, which are all alike.
constexpr int32_t kFarSpacing = 1 << 22;

/// Whole steps: no two hosts' last bits, and no denormals between them (shaders/common/lattice.h).
float settled(float sample) {
  const double held = std::clamp(static_cast<double>(sample), -kLargestSample, kLargestSample);
  return static_cast<float>(std::floor(held * kStepsAUnit + 0.5) / kStepsAUnit);
}

std::string textOf(Int3 p) { return std::to_string(p.x) + ", " + std::to_string(p.y) + ", " + std::to_string(p.z); }

Result<void> takeSamples(const HostField& field, const SampleLattice& at, std::span<float> values) {
  if (Result<void> sampled = field.sample(at, values); !sampled) return sampled;
  for (size_t i = 0; i < values.size(); ++i) {
    if (!std::isnan(values[i])) {
      values[i] = settled(values[i]);
      continue;
    }
    const size_t row = at.count[0], layer = row * at.count[1];
    const std::array<size_t, 3> place{i % row, i % layer / row, i / layer};
    Int3 p = at.origin;
    for (int axis = 0; axis < 3; ++axis) p[axis] += static_cast<int32_t>(place[static_cast<size_t>(axis)]) * at.spacing;
    return Error{Code::invalid_argument, "the host's field is not a number at " + textOf(p) + " units"};
  }
  return {};
}

/// Where one sample shows that all of the box counts as far: on which side of the surface; else 0.
Result<double> farSide(const HostField& field, const SampleLattice& lattice, double limit) {
  SampleLattice middle = lattice;
  double square = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<size_t>(axis);
    // Of the lattice's own points: a host knows no others.
    const int64_t cells = lattice.count[a] - 1, before = cells / 2, after = cells - before;
    middle.origin[axis] = saturate(int64_t{lattice.origin[axis]} + before * lattice.spacing);
    middle.count[a] = 1;
    const double reach = static_cast<double>(after) * lattice.spacing;
    square += reach * reach;
  }
  float sample = 0;
  if (Result<void> taken = takeSamples(field, middle, {&sample, 1}); !taken) return taken.error();
  const double value = static_cast<double>(sample);
  // Steps that samples were rounded by, and what is lost in mixing them.
  const double change = static_cast<double>(field.steepness) * std::sqrt(square) * (1 + 1e-5) + 1;
  if (std::abs(value) - change < limit * (1 + 1e-5)) return 0.0;
  return value < 0 ? -1.0 : 1.0;
}

}  // namespace

Result<void> emitHostField(ProgramBuilder& builder, const HostField& field, const IntBox& box, int32_t cell,
                           uint32_t layer, std::pmr::memory_resource* memory) {
  const IntBox influence = field.bounds.grown(influenceMargin(cell));
  Result<SampleLattice> lattice = latticeAround(box.clipped(influence), cell);
  if (!lattice) return lattice.error();
  const double limit = field.steepness > 0 ? static_cast<double>(field.steepness) * influenceMargin(cell) : kNoLimit;
  const Result<double> side = field.steepness > 0 ? farSide(field, *lattice, limit) : Result<double>(0.0);
  if (!side) return side.error();
  if (*side != 0) *lattice = {box.lo, kFarSpacing, {2, 2, 2}};
  std::pmr::vector<float> samples(lattice->points(), static_cast<float>(*side * kLargestSample), memory);
  if (*side == 0) {
    if (Result<void> taken = takeSamples(field, *lattice, samples); !taken) return taken;
  }
  const Value root = builder.lattice(*lattice, samples, static_cast<float>(limit), field.label);
  return builder.group(root, influence, layer, field.cut, static_cast<float>(field.smooth));
}

}  // namespace sgm
