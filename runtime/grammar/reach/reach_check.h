#pragma once
// The proof of reach: an abstract interpretation of each layer's rules over intervals. Rules are evaluated once for
// each tuple of argument ranges and remembered, so that recursion costs its depth and not its leaves.
//
// reach.cpp: layers and what is said of them. reach_rules.cpp: calls and choice. reach_statements.cpp: statements.
// reach_transforms.cpp: transforms, loops, point sets. reach_split.cpp: parts of scopes. reach_treemap.cpp: rooms.
// reach_wfc.cpp: tiles. reach_automaton.cpp: cellular automata. reach_profiles.cpp: footprints, extrusions, roofs,
// assets. reach_overrides.cpp: overrides. reach_pieces.cpp: ranges in pieces. reach_report.cpp: what is said.

#include <functional>
#include <map>
#include <set>
#include <tuple>
#include <vector>

#include "grammar/check/check.h"
#include "grammar/range/reach_shapes.h"

namespace sgm {

inline constexpr double kUnit = 1.0 / kUnitsPerMetre;  ///< metres

class ReachCheck {
 public:
  ReachCheck(Program& program, const CompileLimits& limits, DiagnosticSink& sink);

  void run();

 private:
  /// A rule, whether a cut in it takes from the domain, the ranges of arguments and scope, and those rules with a
  /// `depth` that are active, each with how often, and what is known of overrides.
  using Key = std::tuple<uint32_t, bool, std::vector<double>, std::vector<std::pair<uint32_t, uint32_t>>,
                         std::vector<uint32_t>>;

  /// Where derivation stands with respect to overrides.
  struct EditState {
    std::vector<uint32_t> begun;   ///< by path: those whose first steps lead here, and that lead on
    uint32_t depth = 0;            ///< how many steps of them
    std::vector<uint32_t> within;  ///< by tag: those in whose own block this is
  };

  /// What the `inner` of an override's block stands for: a use of a rule, or a block with a tag.
  struct UnderEdit {
    uint32_t rule = 0;
    const std::vector<RangeValue>& args;
    const std::vector<uint32_t>& edits;  ///< those that may hold, as in Program::overrides
    const StmtNode* block = nullptr;     ///< with the tag; null: a use
    const RangeFrame* frame = nullptr;   ///< of that block
    size_t at = 0;                       ///< the one whose block this is, into `edits`
    EditState state;                     ///< of what `inner` derives
    const UnderEdit* outer = nullptr;
  };

  /// What is taken piece by piece of its range: nothing, what has no bound otherwise, or everything.
  enum class Pieces : uint8_t { none, lost, all };

  /// By how much shapes pass what their layer declares, metres: what some may, and what they do for certain.
  struct Excess {
    double may = 0, sure = 0;
  };

  // Layers.
  void layerReach(uint32_t index);
  Extent startExtent(uint32_t index);
  /// As tight as the budget allows where the plain proof is not enough.
  Extent provenExtent(uint32_t index);
  Extent overParameters(uint32_t layer);
  void setCell(const Layer& layer);
  bool isFinite(const Layer& layer) const { return !program_.domain.infinite && layer.cell_expr == kNoId; }
  Excess excessOf(const Layer& layer, const Extent& extent) const;
  bool isEnough(const Layer& layer, const Extent& extent) const;
  void seen(const Layer& layer, const RangeEvaluator::Sight& sight);

  // Pieces.
  bool cut(RangeValue& value, int depth, const std::function<Extent()>& extent, Extent& out, bool& first);
  Extent overPieces(const std::vector<RangeValue*>& values, const std::function<Extent()>& extent);
  Extent ruleInPieces(uint32_t rule, std::vector<RangeValue> args, const RangeFrame& caller, bool top);

  // What is said.
  /// What extends farthest, and where it is written.
  struct Culprit {
    std::string name;
    Span span;
  };
  Culprit culpritOf(const Layer& layer, const Extent& extent) const;
  std::string hint(const Extent& extent) const;
  bool needsBox(uint32_t index);
  std::string lossHint(const BoundLoss& loss) const;
  std::string lossText(const BoundLoss& loss) const;
  std::string_view written(ExprId id) const;
  /// What to declare so that all shapes of the layer fit, tried before it is said; empty where nothing would do.
  std::string roomHint(uint32_t index, const Extent& extent);
  static double cellOf(const Layer& layer);  ///< its edge along the axes that are cut into cells
  void report(uint32_t index, const Extent& extent);
  void reportOne(const Layer& layer, const Extent& extent, const std::string& room);
  void reportZeroDivisions();
  void finiteBox(Layer& layer, const Extent& extent);

  // Rules.
  enum class Call : uint8_t { start, instead, written };  ///< a layer's, that of depth and minsize, a statement
  Extent callExtent(ExprId id, const RangeFrame& frame, Call call);
  Extent ruleExtent(uint32_t rule, const std::vector<RangeValue>& args, const RangeFrame& caller, bool top);
  Extent remembered(uint32_t rule, const std::vector<RangeValue>& args, const RangeFrame& caller, bool top,
                    const std::vector<uint32_t>& edits);
  Extent alternatives(uint32_t rule, const std::vector<RangeValue>& args, const RangeFrame& caller, bool top);
  void idleHeads();
  void judgeWeight(ExprId id, Interval weight);
  Extent alternativeExtent(uint32_t rule, const Alternative& head, RangeFrame& frame);
  Extent automaton(const ExprNode& n, const RangeFrame& frame);
  bool tooFar();

  // Overrides.
  void startOverrides(uint32_t layer);
  std::vector<uint32_t> enter(uint32_t rule);
  std::vector<uint32_t> editKey(const std::vector<uint32_t>& ended) const;
  /// What the first `below` of the overrides make of it; above: the one whose `inner` asks, by path.
  Extent use(const UnderEdit& what, size_t below, RangeFrame& frame, const Override* above);
  Extent overridden(const UnderEdit& what, size_t at, const RangeFrame& place);
  Extent inner(const StmtNode& s, const RangeFrame& at);
  Extent tagged(const StmtNode& s, uint16_t tag, RangeFrame& frame);
  Extent untagged(const StmtNode& s, RangeFrame& frame);

  // Statements.
  Extent body(StmtId id, RangeFrame& frame);
  Extent statement(StmtId id, RangeFrame& frame);
  Extent statementKinds(const StmtNode& s, RangeFrame& frame);
  /// first: what stands before the block's own statements.
  Extent block(const StmtNode& s, RangeFrame& frame, Extent first = Extent::nothing());
  Extent blockFrom(const StmtNode& s, uint32_t next, RangeFrame& frame, Extent out);
  Extent meet(const StmtNode& s, RangeFrame& frame);
  Extent morph(const StmtNode& s, RangeFrame& frame);
  Extent displaced(const StmtNode& s, RangeFrame& frame);
  Extent warped(const StmtNode& s, RangeFrame& frame);
  Extent forEach(const StmtNode& s, RangeFrame& frame);
  Extent transformed(const StmtNode& s, RangeFrame& frame);
  Extent repeated(const StmtNode& s, RangeFrame& frame);
  Extent scattered(const StmtNode& s, RangeFrame& frame);
  Extent split(const StmtNode& s, RangeFrame& frame);
  Extent comp(const StmtNode& s, RangeFrame& frame);
  Extent treemap(const StmtNode& s, RangeFrame& frame);
  Extent wave(const StmtNode& s, RangeFrame& frame);
  Extent tile(StmtId child, const IntervalVector& edges, const IntervalVector& tile, RangeFrame& frame);
  Extent inPieces(StmtId child, const IntervalVector& edges, RangeFrame& frame);
  RangeValue footprint(const FootprintNode& plan, const RangeFrame& frame);
  Extent extrude(const StmtNode& s, RangeFrame& frame);
  Extent roof(const StmtNode& s, RangeFrame& frame);
  Extent fit(const StmtNode& s, RangeFrame& frame);
  IntervalVector pointOf(const XformNode& x, const RangeFrame& frame);
  void sized(const XformNode& x, RangeFrame& frame);
  void sizedAgain(IdRange xforms, double times, RangeFrame& frame);
  IntervalVector stepLengths(IdRange xforms, const RangeFrame& frame);
  IntervalVector areaOf(const ScatterNode& scatter, const RangeFrame& frame);

  Program& program_;
  DiagnosticSink& sink_;
  const CompileLimits limits_;
  const bool lossy_;    ///< not all of the text is here
  uint32_t steps_;      ///< left, of all layers together
  uint64_t spent_ = 0;  ///< in the last layer, on all attempts
  /// Ranges of sizes are taken in pieces in the outermost splits alone: pieces of pieces of pieces take all steps.
  bool few_pieces_ = false;
  Pieces pieces_ = Pieces::none;
  uint32_t rules_ = 0;  ///< rules on the path
  bool collects_ = false;
  std::vector<ExprId> top_calls_;  ///< where it collects: the calls that stand in the layer's own rule
  ExprId only_ = kNoId;            ///< of the calls in a start rule, the one that counts; kNoId: all
  int splits_ = 0;                 ///< that this stands in
  RangeEvaluator values_;
  IntervalVector cell_{};
  bool whole_ = false;                             ///< the start has no cells
  bool centred_ = false;                           ///< the cell lies about the origin: a finite domain's
  std::map<Key, Extent> known_, scaled_, placed_;  ///< by what was asked on the way; the latter two with longer keys
  std::set<Key> open_;                             ///< with the scale
  std::vector<uint32_t> active_;                   ///< activations of each rule on the path
  std::vector<bool> counted_;                      ///< rules whose activations matter
  std::map<uint32_t, uint32_t> counts_;            ///< of those, the active ones
  EditState edits_;
  const UnderEdit* under_ = nullptr;  ///< in an override's block: what is there otherwise
  int depth_ = 0;
  std::vector<std::vector<bool>> derived_;  ///< of each rule that is used, which heads can be derived
  bool cut_short_ = false;                  ///< the budget or the depth was not enough: nothing is proven
};

}  // namespace sgm
