#include "backend/vulkan/tape.h"

#include <algorithm>
#include <array>
#include <bit>
#include <bitset>
#include <cstring>

#include "field/interval.h"

namespace sgm {

namespace {

constexpr uint32_t kFirstWords = 28;  // of parameters, in a record's first 32 words
constexpr uint32_t kKinds = static_cast<uint32_t>(TapeOp::count);

/// The turn of each kind within a sweep.
constexpr std::array<uint32_t, kKinds> makeRanks() {
  std::array<uint32_t, kKinds> ranks{};
#include "sweep_ranks.inl"
  for (uint32_t kind = static_cast<uint32_t>(Op::count); kind < kKinds; ++kind) ranks[kind] = kind;
  return ranks;
}
constexpr std::array<uint32_t, kKinds> kRanks = makeRanks();

struct Shape {
  uint32_t operands = 0;
  bool position = false;
  uint32_t words = 0;  ///< of parameters, at most, where it does not read a position
};

Shape shapeOf(Op op) {
  switch (op) {
#define SGM_FORM_CONSTANT \
  Shape { 0, false, 1 }
#define SGM_FORM_POSITION \
  Shape { 0, true, 0 }
#define SGM_FORM_POSITION_1 \
  Shape { 1, true, 0 }
#define SGM_FORM_UNARY \
  Shape { 1, false, 0 }
#define SGM_FORM_UNARY_P \
  Shape { 1, false, 2 }
#define SGM_FORM_BINARY \
  Shape { 2, false, 0 }
#define SGM_FORM_TERNARY \
  Shape { 3, false, 0 }
#define SGM_FORM_COPY \
  Shape { 1, false, 0 }
#define SGM_FORM_ROUND_BEGIN \
  Shape { 0, false, 0 }
#define SGM_FORM_ROUND_ADD \
  Shape { 1, false, 1 }
#define SGM_FORM_ROUND_END \
  Shape { 2, false, 1 }
#define SGM_FORM_SUM_BEGIN \
  Shape { 0, false, 0 }
#define SGM_FORM_SUM_ADD \
  Shape { 1, false, 0 }
#define SGM_FORM_SUM_END \
  Shape { 2, false, 2 }
#define SGM_FORM_WARP \
  Shape { 3, false, 0 }
#define SGM_OP(name, function, form, error) \
  case Op::name:                            \
    return SGM_FORM_##form;
#include "field/ops.def"
#undef SGM_OP
    case Op::count:
      break;
  }
  return {};
}

/// What a header says of its record: kOperands and so on in shaders/mesher/items.glsl.
uint32_t traitsOf(const TapeScratch::Node& n, const ProgramView& program, bool layer_cuts) {
  constexpr uint32_t kReadsPosition = 4, kBeginsTwo = 8, kAddsTo = 16, kEndsRound = 32, kMakesPlace = 64,
                     kChooses = 128, kAddsRound = 256, kCuts = 512, kIsFold = 1024, kIsSmooth = 2048,
                     kIsLayerEnd = 4096;
  const bool cut = n.kind >= static_cast<uint32_t>(Op::count) && program.groups[n.group].cut;
  switch (n.kind) {
    case static_cast<uint32_t>(TapeOp::fold):
      if (n.ends_layer) return kIsLayerEnd | (layer_cuts ? kCuts : 0);
      return kIsFold | 1 | (cut ? kCuts : 0);
    case static_cast<uint32_t>(TapeOp::smooth):
      return kIsSmooth | 1 | (cut ? kCuts : 0);
    default:
      break;
  }
  const auto op = static_cast<Op>(n.kind);
  const Shape shape = shapeOf(op);
  if (shape.position && shape.operands == 0 && n.a >= 0) return 1 | kReadsPosition | kChooses;
  uint32_t traits = shape.operands | (shape.position ? kReadsPosition : 0);
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
      return traits;
  }
}

/// How many words of parameters an op has, at most.
uint32_t parameterWords(Op op, const uint32_t* p) {
  switch (op) {
    case Op::noise:
      return 6 + 2 * p[3];
    case Op::sweep:
      return 1 + 9 * p[0];
    case Op::prism:
      return 15 + 6 * p[14];
    case Op::lattice:
      return 10;  // the samples lie apart
    default:
      return shapeOf(op).position ? 21 : shapeOf(op).words;
  }
}

// Their words are read as those of a record's beginning (shaders/mesher/tape.glsl).
constexpr uint32_t kMostOctaves = (kFirstWords - 6) / 2;
// A record that never fits into a shader's window would be waited for without an end.
constexpr uint32_t kMostWords = 100 * kTapeRecordWords;

class Scheduler {
 public:
  Scheduler(const ProgramView& program, TapeScratch& scratch)
      : program_(program), nodes_(scratch.nodes), values_(scratch.values) {
    nodes_.clear();
    values_.clear();
  }

  /// false: too much for a shader.
  bool run() {
    readNodes();
    uniteShapes();
    if (!fits_ || nodes_.size() > kMostTapeRecords || layers_ > kMostTapeLayers) return false;
    sortBlocks();
    return assignSlots();
  }

 private:
  using Node = TapeScratch::Node;

  int32_t newValue() {
    values_.emplace_back();
    return static_cast<int32_t>(values_.size() - 1);
  }

  void readNodes() {
    for (uint32_t k = 0; k < program_.groups.size(); ++k) {
      const ProgramGroup& g = program_.groups[k];
      readGroup(g);
      const int32_t result = registers_[g.result];
      Node fold;
      fold.kind = static_cast<uint32_t>(g.smooth > 0 ? TapeOp::smooth : TapeOp::fold);
      fold.group = k;
      fold.a = result;
      add(fold);
      const bool last = k + 1 == program_.groups.size() || program_.groups[k + 1].layer != g.layer;
      if (g.smooth > 0) continue;
      if (last) {
        Node end;
        end.kind = static_cast<uint32_t>(TapeOp::fold);
        end.ends_layer = true;
        end.group = k;
        end.layer = layers_++;
        // The cuts of a layer stand behind its adds.
        end.layer_cuts = g.cut;
        add(end);
      }
    }
  }

  void readGroup(const ProgramGroup& g) {
    registers_.fill(-1);
    for (const Instr& in : program_.instrs.subspan(g.first, g.count)) {
      if (in.op == Op::copy) {
        registers_[in.dst] = registers_[in.a];
        continue;
      }
      Node n;
      n.kind = static_cast<uint32_t>(in.op);
      n.place = in.place;
      n.params = in.params;
      const uint32_t* params = program_.params.data() + in.params;
      fits_ = fits_ && (in.op == Op::noise ? params[3] <= kMostOctaves
                                           : in.op == Op::copy || parameterWords(in.op, params) <= kMostWords);
      const Shape shape = shapeOf(in.op);
      if (shape.operands > 0) n.a = registers_[in.a];
      if (shape.operands > 1) n.b = registers_[in.b];
      if (shape.operands > 2) n.c = registers_[in.c];
      switch (in.op) {
        case Op::round_begin:
        case Op::sum_begin:
          n.dst = registers_[in.dst] = newValue();
          n.second = registers_[in.b] = newValue();
          break;
        case Op::round_add:
        case Op::sum_add:
          n.dst = registers_[in.dst];
          n.second = registers_[in.b];
          break;
        case Op::warp:
          n.dst = -1;
          n.group = in.dst;  // the place that it makes
          break;
        default:
          n.dst = registers_[in.dst] = newValue();
          break;
      }
      add(n);
    }
  }

  void add(Node n) {
    n.order = static_cast<uint32_t>(nodes_.size());
    nodes_.push_back(n);
  }

  /// Reads a position and nothing else, in a form that takes a minimum with its operand.
  static bool isShape(uint32_t kind) {
    if (kind >= static_cast<uint32_t>(Op::count) || kind == static_cast<uint32_t>(Op::noise)) return false;
    const Shape shape = shapeOf(static_cast<Op>(kind));
    return shape.position && shape.operands == 0;
  }

  /// A minimum of what shapes before have come to and of the shape just before it goes into that shape, unless others
  /// want one of the two, or the shape would have to wait for another sweep.
  void uniteShapes() {
    for (const Node& n : nodes_) {
      forEachValue(n, [&](size_t v) { values_[v].uses += 1; });
      if (n.dst >= 0) values_[static_cast<size_t>(n.dst)].kind = n.kind;
    }
    int32_t values = 0;
    size_t kept = 0;
    for (size_t i = 0; i < nodes_.size(); ++i) {
      Node n = nodes_[i];
      if (n.kind == static_cast<uint32_t>(Op::minimum) && kept > 0) {
        const TapeScratch::Value &a = values_[static_cast<size_t>(n.a)], &b = values_[static_cast<size_t>(n.b)];
        Node& shape = nodes_[kept - 1];
        // Made once and read once.
        const bool alone = a.uses == 2 && b.uses == 2 && shape.dst == b.renamed && shape.a < 0;
        if (alone && isShape(shape.kind) && isShape(a.kind) && kRanks[a.kind] <= kRanks[shape.kind]) {
          shape.a = a.renamed;
          TapeScratch::Value& made = values_[static_cast<size_t>(n.dst)];
          made.renamed = shape.dst;
          made.kind = shape.kind;
          continue;
        }
      }
      for (int32_t* v : {&n.a, &n.b, &n.c, &n.dst, &n.second}) {
        if (*v < 0) continue;
        TapeScratch::Value& value = values_[static_cast<size_t>(*v)];
        if (value.renamed < 0) value.renamed = values++;
        *v = value.renamed;
      }
      n.order = static_cast<uint32_t>(kept);
      nodes_[kept++] = n;
    }
    nodes_.resize(kept);
    values_.assign(static_cast<size_t>(values), {});
  }

  template <class F>
  static void forEachValue(const Node& n, F&& f) {
    for (const int32_t v : {n.a, n.b, n.c, n.dst, n.second}) {
      if (v >= 0) f(static_cast<size_t>(v));
    }
  }

  /// Blocks are as long as their values surely find slots; a place is made once in a block and not read before.
  void sortBlocks() {
    for (const Node& n : nodes_) forEachValue(n, [&](size_t v) { values_[v].last = n.order; });
    for (size_t first = 0; first < nodes_.size();) {
      const size_t last = endOfBlock(first);
      setStages(first, last);
      std::sort(nodes_.begin() + static_cast<std::ptrdiff_t>(first), nodes_.begin() + static_cast<std::ptrdiff_t>(last),
                [](const Node& a, const Node& b) {
                  if (a.stage != b.stage) return a.stage < b.stage;
                  if (kRanks[a.kind] != kRanks[b.kind]) return kRanks[a.kind] < kRanks[b.kind];
                  if (a.step != b.step) return a.step < b.step;
                  if (a.kind != b.kind) return a.kind < b.kind;
                  return a.order < b.order;
                });
      first = last;
    }
  }

  size_t endOfBlock(size_t first) {
    const uint32_t begin = nodes_[first].order;
    size_t values = 0;
    for (TapeScratch::Value& v : values_) {
      v.in_block = false;
      v.stage = v.rank = 0;
    }
    // What was made before and is read in or after this block.
    for (size_t v = 0; v < made_; ++v) values += values_[v].last >= begin ? size_t{1} : size_t{0};
    std::bitset<kMaxPlaces> touched;
    size_t i = first;
    for (; i < nodes_.size(); ++i) {
      const Node& n = nodes_[i];
      const bool warps = n.kind == static_cast<uint32_t>(Op::warp);
      if (warps && touched.test(n.group)) break;
      size_t fresh = 0;
      for (const int32_t v : {n.dst, n.second})
        fresh += v >= 0 && static_cast<size_t>(v) >= made_ ? size_t{1} : size_t{0};
      if (values + fresh > kTapeSlots && i > first) break;
      values += fresh;
      made_ += fresh;
      touched.set(warps ? n.group : n.place);
      if (warps) touched.set(n.place);
    }
    return i;
  }

  void setStages(size_t first, size_t last) {
    std::array<uint32_t, kMaxPlaces> place_stage{};
    uint32_t fold_stage = 0, fold_rank = 0;
    for (size_t i = first; i < last; ++i) {
      Node& n = nodes_[i];
      const uint32_t rank = kRanks[n.kind];
      n.stage = 0;
      const auto after = [&](uint32_t stage, uint32_t other) {
        n.stage = std::max(n.stage, other <= rank ? stage : stage + 1);
      };
      forEachValue(n, [&](size_t v) {
        if (values_[v].in_block) after(values_[v].stage, values_[v].rank);
      });
      const bool warps = n.kind == static_cast<uint32_t>(Op::warp);
      if (n.kind < static_cast<uint32_t>(Op::count) && place_stage[n.place] > 0) {
        n.stage = std::max(n.stage, place_stage[n.place]);
      }
      if (n.kind >= static_cast<uint32_t>(Op::count)) {
        after(fold_stage, fold_rank);
        fold_stage = n.stage;
        fold_rank = rank;
      }
      if (warps) place_stage[n.group] = n.stage + 1;
      // Among those of one turn, which are all ops that join values, the kinds stand together in the same way.
      n.step = 0;
      forEachValue(n, [&](size_t v) {
        const TapeScratch::Value& read = values_[v];
        if (!read.in_block || read.stage != n.stage || read.rank != rank) return;
        n.step = std::max(n.step, read.kind <= n.kind ? read.step : read.step + 1);
      });
      for (const int32_t v : {n.dst, n.second}) {
        if (v < 0) continue;
        TapeScratch::Value& made = values_[static_cast<size_t>(v)];
        made.in_block = true;
        made.stage = n.stage;
        made.rank = rank;
        made.kind = n.kind;
        made.step = n.step;
      }
    }
  }

  bool assignSlots() {
    for (TapeScratch::Value& v : values_) v.last = 0;
    for (uint32_t i = 0; i < nodes_.size(); ++i) {
      forEachValue(nodes_[i], [&](size_t v) { values_[v].last = i; });
    }
    uint64_t free = ~uint64_t{0};
    for (uint32_t i = 0; i < nodes_.size(); ++i) {
      const Node& n = nodes_[i];
      // A result takes its first operand's slot where that is over: pruned to this operand alone it then costs nothing.
      for (const int32_t v : {n.a, n.b, n.c}) {
        if (v >= 0 && values_[static_cast<size_t>(v)].last == i) free |= bitOf(v);
      }
      for (const int32_t v : {n.dst, n.second}) {
        if (v < 0) continue;
        TapeScratch::Value& made = values_[static_cast<size_t>(v)];
        if (made.slot >= 0) continue;
        if (free == 0) return false;
        const bool in_place = v == n.dst && n.a >= 0 && (free & bitOf(n.a)) != 0;
        made.slot = in_place ? values_[static_cast<size_t>(n.a)].slot : std::countr_zero(free);
        free &= ~bitOf(v);
      }
      for (const int32_t v : {n.dst, n.second}) {
        if (v >= 0 && values_[static_cast<size_t>(v)].last == i) free |= bitOf(v);
      }
    }
    return true;
  }

  uint64_t bitOf(int32_t value) const { return uint64_t{1} << values_[static_cast<size_t>(value)].slot; }

  const ProgramView& program_;
  std::pmr::vector<Node>& nodes_;
  std::pmr::vector<TapeScratch::Value>& values_;
  std::array<int32_t, kMaxRegisters> registers_{};
  size_t made_ = 0;
  uint32_t layers_ = 0;
  bool fits_ = true;
};

/// Writes one record, 32 words and more, and returns how many times 32 words it has.
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
    count = static_cast<uint32_t>(std::min<size_t>(left == 0 ? 0 : parameterWords(op, params), left));
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
    return v < 0 ? 0u : static_cast<uint32_t>(scratch.values[static_cast<size_t>(v)].slot);
  };
  const Shape shape = is_op ? shapeOf(op) : Shape{};
  const bool unites = shape.position && shape.operands == 0;
  const bool two = n.second >= 0;
  record[0] = n.kind | n.place << 8 | pieces << 16;
  record[1] = (n.kind == static_cast<uint32_t>(Op::warp) ? n.group : slot(n.dst)) | slot(n.a) << 8 |
              (two ? slot(n.second) : slot(n.b)) << 16 | slot(n.c) << 24;
  if (n.ends_layer) record[1] = n.layer;
  if (unites) record[1] = slot(n.dst) | (n.a < 0 ? kFarSlot : slot(n.a)) << 8 | kFarSlot << 16;
  std::copy_n(params, std::min(count, kFirstWords), record + 2);
  if (count > kFirstWords) std::copy_n(params + kFirstWords, count - kFirstWords, record + kTapeRecordWords);
  if (shape.position) record[30] = std::bit_cast<uint32_t>(static_cast<float>(sizeSum(op, params)));
  return pieces;
}

/// The samples of a lattice behind each other; the place of what word 10 would be goes into its record. Their range,
/// which a device bounds the op by, too.
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
  if (!Scheduler(program, scratch).run()) return false;
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
    header[3] = traitsOf(n, program, n.layer_cuts);
    tape.kinds |= uint64_t{1} << n.kind;
    // What pruning may make of it.
    if (n.kind < static_cast<uint32_t>(Op::count) && shapeOf(static_cast<Op>(n.kind)).operands > 1) {
      tape.kinds |= uint64_t{1} << static_cast<uint32_t>(Op::copy);
    }
  }
  return true;
}

}  // namespace sgm
