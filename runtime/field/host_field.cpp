#include "field/host_field.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "field/compile.h"

namespace sgm {

namespace {

constexpr double kStepsAUnit = 1024;
/// Spacing in units of the small lattice that is used if all samples are equal, because the box is far from the
/// surface.
constexpr int32_t kFarSpacing = 1 << 22;

/// Rounds a sample to whole steps of 1/1024 unit, so that differences in the last bits of host programs do not matter
/// and there are no denormals (shaders/common/lattice.h).
float wholeSteps(float sample) {
  const double held = std::clamp(double{sample}, -double{kLargestSample}, double{kLargestSample});
  return static_cast<float>(std::floor(held * kStepsAUnit + 0.5) / kStepsAUnit);
}

Error badSample(const SampleLattice& at, size_t i, const std::string& what) {
  const size_t row = at.count[0], layer = row * at.count[1];
  const std::array<size_t, 3> place{i % row, i % layer / row, i / layer};
  std::string text = "the host's field " + what + " at ";
  for (int axis = 0; axis < 3; ++axis) {
    const auto offset = static_cast<int64_t>(place[static_cast<size_t>(axis)]) * at.spacing;
    text += std::to_string(at.origin[axis] + offset) + (axis < 2 ? ", " : " units");
  }
  return {Code::invalid_argument, text};
}

/// Rejects samples that are steeper than the host states. For a chunk far from the surface, the stated steepness allows
/// taking a single sample. If it were wrong, this chunk would not match a neighbour that takes all samples.
Result<void> checkSteepness(const HostField& field, const SampleLattice& at, std::span<const float> values) {
  const size_t row = at.count[0], layer = row * at.count[1];
  const double most = double{field.steepness} * at.spacing;
  for (size_t i = 0; i < values.size(); ++i) {
    const std::array<size_t, 3> steps{i % row + 1 < row ? size_t{1} : 0, i % layer + row < layer ? row : 0,
                                      i + layer < values.size() ? layer : 0};
    for (const size_t step : steps) {
      const double a = double{values[i]}, b = double{values[i + step]};
      if (std::abs(a - b) <= most + 1 + 1e-5 * (std::abs(a) + std::abs(b))) continue;
      return badSample(at, i, "changes by more than its steepness of " + std::to_string(field.steepness));
    }
  }
  return {};
}

Result<void> takeSamples(const HostField& field, const SampleLattice& at, std::span<float> values) {
  if (Result<void> sampled = field.sample(at, values); !sampled) return sampled;
  for (size_t i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i])) return badSample(at, i, "is not finite");
    values[i] = wholeSteps(values[i]);
  }
  return field.steepness > 0 ? checkSteepness(field, at, values) : Result<void>();
}

/// Samples one point of the lattice. If its value proves that the whole lattice is far from the surface, returns the
/// sign of the value (1 or -1); otherwise 0.
Result<float> farSide(const HostField& field, const SampleLattice& lattice, double limit) {
  SampleLattice middle = lattice;
  double square = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<size_t>(axis);
    // The sample is taken at a point of the lattice, since the host may not know the field at other positions.
    const int64_t cells = lattice.count[a] - 1, before = cells / 2, after = cells - before;
    middle.origin[axis] = static_cast<int32_t>(lattice.origin[axis] + before * lattice.spacing);
    middle.count[a] = 1;
    const double reach = static_cast<double>(after) * lattice.spacing;
    square += reach * reach;
  }
  float sample = 0;
  if (Result<void> taken = takeSamples(field, middle, {&sample, 1}); !taken) return taken.error();
  // The largest change of the field that checkSteepness() accepts, plus the rounding errors of samples and of their
  // interpolation.
  const double change = double{field.steepness} * std::sqrt(square) * (1 + 1e-5) + 1;
  if (std::abs(double{sample}) - change < limit * (1 + 1e-5)) return 0.0f;
  return sample < 0 ? -1.0f : 1.0f;
}

}  // namespace

Result<void> emitHostField(ProgramBuilder& builder, const HostField& field, const IntBox& box, int32_t cell,
                           uint32_t layer, uint32_t label, std::pmr::memory_resource* memory) {
  const IntBox influence = field.bounds.grown(field.smooth).grown(influenceMargin(cell));
  SampleLattice lattice = latticeAround(box.clipped(influence), cell);
  const double steep = double{field.steepness} * influenceMargin(cell);
  const double limit = steep > 0 ? std::max(steep, double{kWidestHostBlend}) : double{kFarSample};
  const Result<float> side = steep > 0 ? farSide(field, lattice, limit) : Result<float>(0.0f);
  if (!side) return side.error();
  // All samples are equal, so the positions of the lattice's points do not matter.
  if (*side != 0) lattice = {{0, 0, 0}, kFarSpacing, {4, 4, 4}};
  const std::optional<size_t> points = latticePoints(lattice);
  if (!points) {
    return Error{Code::limit, "the box takes more samples of a host field than fit; ask for a smaller one"};
  }
  std::pmr::vector<float> samples(*points, *side * kLargestSample, memory);
  if (*side == 0) {
    if (Result<void> taken = takeSamples(field, lattice, samples); !taken) return taken;
  }
  const Value root = builder.lattice(lattice, samples, static_cast<float>(limit), label);
  return builder.group(root, influence, layer, field.cut, static_cast<float>(field.smooth));
}

}  // namespace sgm
