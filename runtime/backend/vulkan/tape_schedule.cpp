#include "backend/vulkan/tape_schedule.h"

#include <algorithm>
#include <array>
#include <bitset>

#include "backend/vulkan/tape_fuse.h"
#include "backend/vulkan/tape_ops.h"

namespace sgm {

namespace {

// Maximum number of octaves of a noise. Their parameter words must fit into the first part of a record
// (shaders/mesher/tape.glsl).
constexpr uint32_t kMaxOctaves = (kFirstWords - 6) / 2;
// Maximum number of parameter words of a record. A shader would wait forever for a record larger than its window.
constexpr uint32_t kMaxWords = 100 * kTapeRecordWords;

class Scheduler {
 public:
  Scheduler(const ProgramView& program, TapeScratch& scratch)
      : program_(program), scratch_(scratch), nodes_(scratch.nodes), values_(scratch.values) {
    nodes_.clear();
    values_.clear();
  }

  /// Orders the program's instructions. Returns false if the program exceeds a limit of the shaders.
  bool run() {
    readNodes();
    fuseNodes(program_, scratch_);
    if (!fits_ || nodes_.size() > kMaxTapeRecords || layers_ > kMaxTapeLayers) return false;
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
        // In a layer, groups that cut come after groups that add. So the layer has cuts exactly if its last group cuts.
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
      fits_ = fits_ && (in.op == Op::noise ? params[3] <= kMaxOctaves
                                           : in.op == Op::copy || parameterWords(in.op, params) <= kMaxWords);
      const OpShape shape = shapeOf(in.op);
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
          n.group = in.dst;  // index of the place (warped position) that the warp makes
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

  /// Divides the program into blocks, and sorts each block. Blocks are so short that there are certainly enough slots
  /// for their values. In a block, at most one instruction makes a given place (warped position), and only instructions
  /// after it read this place.
  void sortBlocks() {
    for (const Node& n : nodes_) TapeScratch::forEachValue(n, [&](size_t v) { values_[v].last = n.order; });
    for (size_t first = 0; first < nodes_.size();) {
      const size_t last = endOfBlock(first);
      setStages(first, last);
      std::sort(nodes_.begin() + static_cast<std::ptrdiff_t>(first), nodes_.begin() + static_cast<std::ptrdiff_t>(last),
                [](const Node& a, const Node& b) {
                  if (a.stage != b.stage) return a.stage < b.stage;
                  if (sweepRank(a.kind) != sweepRank(b.kind)) return sweepRank(a.kind) < sweepRank(b.kind);
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
    // Counts the values that earlier blocks compute and that are still read in this block or later.
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
      const uint32_t rank = sweepRank(n.kind);
      n.stage = 0;
      const auto after = [&](uint32_t stage, uint32_t other) {
        n.stage = std::max(n.stage, other <= rank ? stage : stage + 1);
      };
      TapeScratch::forEachValue(n, [&](size_t v) {
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
      // `stage` is the number of the node's sweep. A sweep runs its nodes by turn (sweepRank); all ops that only join
      // values have the same turn. Nodes of one turn run by `step`, then by kind. `stage` and `step` are chosen so that
      // a node runs after the nodes whose results it reads.
      n.step = 0;
      TapeScratch::forEachValue(n, [&](size_t v) {
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
      TapeScratch::forEachValue(nodes_[i], [&](size_t v) { values_[v].last = i; });
    }
    uint64_t free = ~uint64_t{0};
    for (uint32_t i = 0; i < nodes_.size(); ++i) {
      const Node& n = nodes_[i];
      // A result gets the slot of its first operand if that operand is not needed later. Then the instruction costs
      // nothing if pruning reduces it to a copy of this operand.
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
  TapeScratch& scratch_;
  std::pmr::vector<Node>& nodes_;
  std::pmr::vector<TapeScratch::Value>& values_;
  std::array<int32_t, kMaxRegisters> registers_{};
  size_t made_ = 0;
  uint32_t layers_ = 0;
  bool fits_ = true;
};

}  // namespace

bool scheduleTape(const ProgramView& program, TapeScratch& scratch) { return Scheduler(program, scratch).run(); }

}  // namespace sgm
