#include <algorithm>
#include <cstring>
#include <numeric>
#include <tuple>
#include <vector>

#include "api/barrier.h"
#include "api/field.h"
#include "backend/cpu/instruction_sets.h"
#include "field/evaluate.h"
#include "field/prune.h"

using namespace sgm::api;

namespace {

constexpr size_t kSlice = size_t{1} << 18;  // number of points that are sorted and evaluated at a time
constexpr int kBlockCells = 32;             // edge in cells of a block whose points share one compiled program
constexpr int kBrickCells = 8;              // edge in cells of a brick whose points share one pruned program
constexpr size_t kWorthPruning = 32;        // minimum number of points in a brick for which pruning saves time

sgm_result checkSamples(const sgm_sample_desc& desc, sgm_error* error) {
  if (desc.count == 0) return SGM_OK;
  if (desc.points == nullptr) return nullArgument(error, "desc.points");
  const size_t stride = desc.point_stride == 0 ? 3 * sizeof(int32_t) : desc.point_stride;
  if (stride < 3 * sizeof(int32_t) || stride % alignof(int32_t) != 0)
    return fail(error, SGM_ERR_INVALID_ARGUMENT, "desc.point_stride is below 12 or not a multiple of 4");
  if (desc.count > SIZE_MAX / 2 / stride) return fail(error, SGM_ERR_INVALID_ARGUMENT, "desc.count is too large");
  return SGM_OK;
}

sgm::Int3 pointAt(const sgm_sample_desc& desc, size_t i) {
  const size_t stride = desc.point_stride == 0 ? 3 * sizeof(int32_t) : desc.point_stride;
  sgm::Int3 p;
  std::memcpy(&p, reinterpret_cast<const char*>(desc.points) + i * stride, sizeof p);
  return p;
}

struct Place {
  sgm::Int3 block, brick;
  size_t index;
  friend bool operator<(const Place& a, const Place& b) {
    return std::tie(a.block, a.brick, a.index) < std::tie(b.block, b.brick, b.index);
  }
};

/// Evaluates groups of points with one program each; reuses buffers for the results.
class Evaluation {
 public:
  Evaluation(const sgm_sample_desc& desc, std::pmr::memory_resource* memory)
      : desc_(desc), scratch_(memory), prune_scratch_(memory), pruned_(memory) {}

  /// Evaluates the field at a group of points. Precondition: the points lie in one brick.
  void run(const sgm::FieldProgram& program, std::span<const Place> places) {
    sgm::ProgramView view = program.view();
    if (places.size() >= kWorthPruning) {
      sgm::IntBox box;
      for (const Place& place : places) {
        const sgm::Int3 p = pointAt(desc_, place.index);
        box = box.joined({p, p});
      }
      sgm::prune(view, box, prune_scratch_, pruned_);
      // If pruning proves that the field has one sign in the brick, the whole program is used: pruning then keeps only
      // the sign, but exact values are needed here.
      if (!pruned_.solid() && !pruned_.empty()) view = pruned_.view();
    }
    for (size_t first = 0; first < places.size(); first += sgm::kEvalBlock)
      runBlock(view, places.subspan(first, std::min(sgm::kEvalBlock, places.size() - first)));
  }

 private:
  void runBlock(const sgm::ProgramView& view, std::span<const Place> places) {
    const size_t n = places.size();
    for (size_t i = 0; i < n; ++i) {
      const sgm::Int3 p = pointAt(desc_, places[i].index);
      x_[i] = p.x;
      y_[i] = p.y;
      z_[i] = p.z;
    }
    const sgm::Points points{x_, y_, z_, n};
    const sgm::FieldKernels& kernels = sgm::bestKernels();
    if (desc_.q != nullptr) {
      kernels.samples(view, points, scratch_, q_);
      for (size_t i = 0; i < n; ++i) desc_.q[places[i].index] = q_[i];
    }
    const bool labels = desc_.materials != nullptr || desc_.tags != nullptr;
    if (desc_.values == nullptr && desc_.gradients == nullptr && !labels) return;
    sgm::Attributes attributes;
    attributes.value = value_;
    attributes.gradient_x = gradient_[0];
    attributes.gradient_y = gradient_[1];
    attributes.gradient_z = gradient_[2];
    attributes.label = label_;
    kernels.attributes(view, points, scratch_, attributes);
    for (size_t i = 0; i < n; ++i) {
      const size_t at = places[i].index;
      if (desc_.values != nullptr) desc_.values[at] = value_[i] * (1.0f / sgm::kUnitsPerMetre);
      if (desc_.gradients != nullptr)
        for (size_t axis = 0; axis < 3; ++axis) desc_.gradients[3 * at + axis] = gradient_[axis][i];
      if (desc_.materials != nullptr) desc_.materials[at] = static_cast<uint16_t>(label_[i] & 0xFFFFu);
      if (desc_.tags != nullptr) desc_.tags[at] = static_cast<uint16_t>(label_[i] >> 16);
    }
  }

  const sgm_sample_desc& desc_;
  sgm::EvalScratch scratch_;
  sgm::PruneScratch prune_scratch_;
  sgm::PrunedProgram pruned_;
  int32_t x_[sgm::kEvalBlock], y_[sgm::kEvalBlock], z_[sgm::kEvalBlock], q_[sgm::kEvalBlock];
  float value_[sgm::kEvalBlock], gradient_[3][sgm::kEvalBlock];
  uint32_t label_[sgm::kEvalBlock];
};

/// Divides `places` into runs of adjacent elements for which the function `part` returns the same value.
template <class Part>
std::vector<std::span<const Place>> runsOf(std::span<const Place> places, Part part) {
  std::vector<std::span<const Place>> runs;
  for (size_t first = 0; first < places.size();) {
    size_t end = first + 1;
    while (end < places.size() && part(places[end]) == part(places[first])) ++end;
    runs.push_back(places.subspan(first, end - first));
    first = end;
  }
  return runs;
}

sgm::Result<void> sampleBlock(const sgm_field& field, const sgm_sample_desc& desc, std::span<const Place> places) {
  sgm::IntBox box;
  for (const Place& place : places) {
    const sgm::Int3 p = pointAt(desc, place.index);
    box = box.joined({p, p});
  }
  const sgm::Result<std::shared_ptr<const sgm::FieldProgram>> program = field.content->world.compile(box, desc.level);
  if (!program) return program.error();
  Evaluation evaluation(desc, field.content->world.memory());
  for (const std::span<const Place> brick : runsOf(places, [](const Place& p) { return p.brick; }))
    evaluation.run(**program, brick);
  return {};
}

sgm::Result<void> sampleSlice(const sgm_field& field, const sgm_sample_desc& desc, size_t first, size_t end) {
  const int32_t cell = field.content->world.cellAt(desc.level);
  std::pmr::vector<Place> places(field.content->world.memory());
  places.reserve(end - first);
  for (size_t i = first; i < end; ++i) {
    const sgm::Int3 p = pointAt(desc, i);
    Place place{{}, {}, i};
    for (int axis = 0; axis < 3; ++axis) {
      place.block[axis] = static_cast<int32_t>(sgm::floorDiv(p[axis], int64_t{cell} * kBlockCells));
      place.brick[axis] = static_cast<int32_t>(sgm::floorDiv(p[axis], int64_t{cell} * kBrickCells));
    }
    places.push_back(place);
  }
  std::sort(places.begin(), places.end());
  const std::vector<std::span<const Place>> blocks =
      runsOf(std::span<const Place>(places), [](const Place& p) { return p.block; });
  std::vector<std::optional<sgm::Error>> errors(blocks.size());
  sgm::parallelFor(*field.runtime.jobs, blocks.size(), [&](size_t i) {
    if (const sgm::Result<void> ok = sampleBlock(field, desc, blocks[i]); !ok) errors[i] = ok.error();
  });
  for (const std::optional<sgm::Error>& e : errors)
    if (e) return *e;
  return {};
}

}  // namespace

sgm_result sgm_field_sample(sgm_field* field, const sgm_sample_desc* desc, sgm_error* error) {
  return guarded(error, [&]() -> sgm_result {
    if (field == nullptr) return nullArgument(error, "field");
    if (sgm_result r = checkDesc(error, desc, "desc"); r != SGM_OK) return r;
    if (sgm_result r = checkSamples(*desc, error); r != SGM_OK) return r;
    if (sgm_result r = checkLevel(field->content->world.settings().finest_cell, desc->level, error); r != SGM_OK)
      return r;
    for (size_t first = 0; first < desc->count; first += kSlice) {
      const sgm::Result<void> ok = sampleSlice(*field, *desc, first, std::min(desc->count, first + kSlice));
      if (!ok) return fail(error, ok.error());
    }
    return SGM_OK;
  });
}
