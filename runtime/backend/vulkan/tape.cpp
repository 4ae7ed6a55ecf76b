#include "backend/vulkan/tape.h"

#include <algorithm>
#include <array>
#include <bit>

#include "backend/vulkan/tape_ops.h"
#include "backend/vulkan/tape_schedule.h"
#include "field/interval.h"

namespace sgm {

namespace {

namespace record_header {

using uint = uint32_t;
#include "mesher/record_header.h"

}  // namespace record_header

/// Returns the bits of a header that describe the record.
uint32_t traitsOf(const TapeScratch::Node& n, const ProgramView& program) {
  using namespace record_header;
  const uint32_t operands = n.c >= 0 ? 3 : n.b >= 0 ? 2 : n.a >= 0 ? 1 : 0;
  if (n.kind >= static_cast<uint32_t>(Op::count)) {
    if (n.ends_layer) return kIsLayerEnd | (n.layer_cuts ? kCuts : 0);
    const bool smooth = n.kind == static_cast<uint32_t>(TapeOp::smooth);
    return operands | (smooth ? kIsSmooth : kIsFold) | (program.groups[n.group].cut ? kCuts : 0);
  }
  const auto op = static_cast<Op>(n.kind);
  const OpShape shape = shapeOf(op);
  const uint32_t traits = operands | (shape.position ? kReadsPosition : 0);
  switch (op) {
    case Op::round_begin:
    case Op::sum_begin:
      return traits | kBeginsTwo;
    case Op::round_add:
      return traits | kAddsTo | kAddsRound;
    case Op::sum_add:
      return traits | kAddsTo;
    case Op::round_end:
      return traits | kEndsRound;
    case Op::warp:
      return traits | kMakesPlace;
    case Op::minimum:
    case Op::maximum:
    case Op::cut:
    case Op::morph:
      return traits | kChooses;
    default:
      return traits | (shape.position && shape.operands == 0 && n.a >= 0 ? kChooses : 0);
  }
}

/// Returns the maximum number of the node's own parameter words.
uint32_t wordsOf(const TapeScratch::Node& n, const uint32_t* params) {
  return parameterWords(n.weighs ? Op::kernel : static_cast<Op>(n.kind), params);
}

/// For a mix, a morph or a sum, returns the bits kHow... (record_header.h), which tell how its result or its added
/// value is computed; 0 for all other instructions.
uint32_t howOf(const TapeScratch::Node& n) {
  using namespace record_header;
  return (n.by_constant ? kHowByConstant : 0) | (n.morphs ? kHowMorphs : 0) | (n.weighs ? kHowWeighs : 0);
}

/// Returns the bits that the node adds to Tape::kinds.
uint64_t kindsOf(const TapeScratch::Node& n) {
  using namespace record_header;
  static_assert(static_cast<uint32_t>(TapeOp::count) <= 61, "the last three bits have other meanings");
  const bool joins = n.is(Op::mix) || n.is(Op::morph);
  const uint32_t others =
      (joins && !n.by_constant ? kSomeReadsThird : 0) | (n.morphs ? kSomeMorphs : 0) | (n.weighs ? kSomeWeighs : 0);
  // On the device, pruning may turn the instruction into a copy, so the tape's kinds include the copy.
  const bool may_copy = n.kind < static_cast<uint32_t>(Op::count) && shapeOf(static_cast<Op>(n.kind)).operands > 1;
  return uint64_t{1} << n.kind | uint64_t{others} << 32 |
         (may_copy ? uint64_t{1} << static_cast<uint32_t>(Op::copy) : 0);
}

/// Appends one record of at least 32 words. Returns its length in units of 32 words.
uint32_t writeRecord(const ProgramView& program, const TapeScratch& scratch, const TapeScratch::Node& n,
                     std::pmr::vector<uint32_t>& words) {
  const size_t at = words.size();
  const bool is_op = n.kind < static_cast<uint32_t>(Op::count);
  const auto op = static_cast<Op>(n.kind);
  uint32_t count = 8;
  std::array<uint32_t, 8> fold{};
  const uint32_t* params = fold.data();
  if (is_op) {
    const size_t left = program.params.size() - std::min<size_t>(n.params, program.params.size());
    params = program.params.data() + n.params;
    count = static_cast<uint32_t>(std::min<size_t>(left == 0 ? 0 : wordsOf(n, params), left));
  } else {
    const ProgramGroup& g = program.groups[n.group];
    fold = {static_cast<uint32_t>(g.influence.lo.x),
            static_cast<uint32_t>(g.influence.lo.y),
            static_cast<uint32_t>(g.influence.lo.z),
            static_cast<uint32_t>(g.influence.hi.x),
            static_cast<uint32_t>(g.influence.hi.y),
            static_cast<uint32_t>(g.influence.hi.z),
            (g.cut ? 1u : 0u) | (g.guarded ? 2u : 0u) | (n.ends_layer ? 4u : 0u),
            std::bit_cast<uint32_t>(g.smooth)};
  }
  const uint32_t pieces = count <= kFirstWords ? 1 : 2 + (count - kFirstWords - 1) / kTapeRecordWords;
  words.resize(at + size_t{pieces} * kTapeRecordWords);
  uint32_t* record = words.data() + at;
  std::fill(record, record + size_t{pieces} * kTapeRecordWords, 0u);
  const auto slot = [&](int32_t v) {
    return v < 0 ? kFarSlot : static_cast<uint32_t>(scratch.values[static_cast<size_t>(v)].slot);
  };
  const OpShape shape = is_op ? shapeOf(op) : OpShape{};
  const bool two = n.second >= 0;
  record[0] = n.kind | n.place << 8 | pieces << 16;
  record[1] = (n.kind == static_cast<uint32_t>(Op::warp) ? n.group : slot(n.dst)) | slot(n.a) << 8 |
              (two ? slot(n.second) : slot(n.b)) << 16 | slot(n.c) << 24;
  if (n.ends_layer) record[1] = n.layer;
  std::copy_n(params, std::min(count, kFirstWords), record + 2);
  if (count > kFirstWords) std::copy_n(params + kFirstWords, count - kFirstWords, record + kTapeRecordWords);
  if (const uint32_t how = howOf(n); how != 0) {
    record[2 + record_header::kByWord] = std::bit_cast<uint32_t>(n.by);
    record[2 + record_header::kHowWord] = how;
  }
  if (shape.position) record[30] = std::bit_cast<uint32_t>(static_cast<float>(sizeSum(op, params)));
  return pieces;
}

/// Appends the samples of a lattice contiguously; their offset goes into word 10 of the op's parameters in the record.
/// Also appends the range of the samples, by which a device bounds the op.
void writeLattice(const ProgramView& program, uint32_t params, size_t record, std::pmr::vector<uint32_t>& words) {
  const uint32_t* p = program.params.data() + params;
  const size_t points = size_t{p[5]} * p[6] * p[7], at = words.size();
  words.insert(words.end(), p + 10, p + 10 + points);
  float lo = std::bit_cast<float>(p[10]), hi = lo;
  for (size_t i = 0; i < points; ++i) {
    const float v = std::bit_cast<float>(p[10 + i]);
    lo = std::min(lo, v);
    hi = std::max(hi, v);
  }
  words[record + 2 + 10] = static_cast<uint32_t>(at) - 10;
  words[record + 2 + 11] = std::bit_cast<uint32_t>(lo);
  words[record + 2 + 12] = std::bit_cast<uint32_t>(hi);
}

void alignTo(std::pmr::vector<uint32_t>& words, size_t count) {
  words.resize((words.size() + count - 1) / count * count, 0u);
}

}  // namespace

bool appendTape(const ProgramView& program, TapeScratch& scratch, std::pmr::vector<uint32_t>& words, Tape& tape) {
  if (!scheduleTape(program, scratch)) return false;
  tape = {};
  tape.initial = program.initial;
  tape.initial_label = program.initial_label;
  tape.q_scale = program.q_scale;
  tape.records = static_cast<uint32_t>(scratch.nodes.size());
  alignTo(words, kTapeRecordWords);
  const size_t headers = words.size();
  tape.headers = static_cast<uint32_t>(headers / 4);
  words.resize(headers + 4 * scratch.nodes.size());
  alignTo(words, kTapeRecordWords);
  for (size_t i = 0; i < scratch.nodes.size(); ++i) {
    const TapeScratch::Node& n = scratch.nodes[i];
    const size_t record = words.size();
    writeRecord(program, scratch, n, words);
    if (n.kind == static_cast<uint32_t>(Op::lattice)) {
      writeLattice(program, n.params, record, words);
      alignTo(words, kTapeRecordWords);
    }
    uint32_t* header = words.data() + headers + 4 * i;
    header[0] = words[record];
    header[1] = words[record + 1];
    header[2] = static_cast<uint32_t>(record / kTapeRecordWords);
    header[3] = traitsOf(n, program);
    tape.kinds |= kindsOf(n);
  }
  return true;
}

}  // namespace sgm
