#include "world/layers_below.h"

#include <algorithm>

#include "backend/cpu/instruction_sets.h"

namespace sgm {

LayersBelow::LayersBelow(const WorldField& world, const IntBox& around) : world_(world), around_(around) {}

const FieldProgram* LayersBelow::program(uint32_t layer, const IntBox& box) const {
  if (error_) return nullptr;
  const bool near = around_.contains(box);
  std::shared_ptr<const FieldProgram>& kept = near ? programs_[layer] : elsewhere_;
  if (!near || !kept) {
    Result<std::shared_ptr<const FieldProgram>> compiled =
        world_.compileBelow(layer, near ? around_ : box, &parameters_);
    if (!compiled) {
      error_ = compiled.error();
      return nullptr;
    }
    kept = *compiled;
  }
  return kept.get();
}

Int3 LayersBelow::shifted(Int3 p) const { return saturatingAdd(p, world_.settings().shift); }

bool LayersBelow::solid(uint32_t layer, Int3 derived) const {
  const Int3 p = shifted(derived);
  const FieldProgram* field = program(layer, {p, p});
  if (!field) return true;
  int32_t q = 0;
  scalarKernels().samples(field->view(), {&p.x, &p.y, &p.z, 1}, scratch_, &q);
  return q < 0;
}

std::optional<int32_t> LayersBelow::probe(uint32_t layer, Int3 start, std::array<double, 3> direction,
                                          int32_t length) const {
  if (length < 0) return std::nullopt;
  const Int3 from = shifted(start);
  const Int3 end = probePoint(from, direction, length);
  IntBox box{{std::min(from.x, end.x), std::min(from.y, end.y), std::min(from.z, end.z)},
             {std::max(from.x, end.x), std::max(from.y, end.y), std::max(from.z, end.z)}};
  box = box.grown(1);  // the probe rounds the points between its two ends: the margin covers this rounding
  const FieldProgram* field = program(layer, box);
  if (!field) return std::nullopt;
  prune(field->view(), box, prune_scratch_, pruned_);
  if (pruned_.solid() || pruned_.empty()) return std::nullopt;

  // Gives the same answer as LowerLayers::probe, but evaluates all coarse samples in one call.
  auto sample = [&](size_t count) {
    q_.resize(count);
    bestKernels().samples(pruned_.view(), {x_.data(), y_.data(), z_.data(), count}, scratch_, q_.data());
  };
  auto add = [&](int32_t t) {
    const Int3 p = probePoint(from, direction, t);
    x_.push_back(p.x);
    y_.push_back(p.y);
    z_.push_back(p.z);
  };
  auto clear = [&] {
    x_.clear();
    y_.clear();
    z_.clear();
  };
  clear();
  add(0);
  for (int32_t t = 0; t < length;) add(t += std::min(kProbeStep, length - t));
  sample(x_.size());
  if (q_[0] < 0) return std::nullopt;
  const auto hit = std::find_if(q_.begin(), q_.end(), [](int32_t q) { return q < 0; });
  if (hit == q_.end()) return std::nullopt;
  const auto step = static_cast<int32_t>(hit - q_.begin());
  int32_t open = (step - 1) * kProbeStep, closed = std::min(step * kProbeStep, length);
  while (closed - open > 1) {
    const int32_t middle = open + (closed - open) / 2;
    clear();
    add(middle);
    sample(1);
    (q_[0] < 0 ? closed : open) = middle;
  }
  return closed;
}

BallProof LayersBelow::prove(uint32_t layer, const Ball& derived, BoxContent wanted) const {
  const Ball ball{shifted(derived.centre), derived.radius};
  const IntBox box = IntBox{ball.centre, ball.centre}.grown(ball.radius);
  const FieldProgram* field = program(layer, box);
  if (!field) return {};
  prune(field->view(), box, prune_scratch_, pruned_, Uniform::keep);
  return proveBall(ball, wanted, [&](const IntBox& piece) {
    if (piece.lo == piece.hi) {
      int32_t q = 0;
      scalarKernels().samples(pruned_.view(), {&piece.lo.x, &piece.lo.y, &piece.lo.z, 1}, scratch_, &q);
      return q < 0 ? BoxContent::solid : BoxContent::open;
    }
    prune(pruned_.view(), piece, prune_scratch_, piece_);
    return piece_.solid() ? BoxContent::solid : piece_.empty() ? BoxContent::open : BoxContent::unknown;
  });
}

}  // namespace sgm
