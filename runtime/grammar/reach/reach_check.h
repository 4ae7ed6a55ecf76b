#pragma once
// The proof of reach: an abstract interpretation of each layer's rules over intervals. Rules are evaluated once for
// each tuple of argument ranges, with cached results, so that recursion costs its depth, not its number of leaves.
//
// reach.cpp: layers and their messages. reach_rules.cpp: calls and choice. reach_statements.cpp: statements.
// reach_transforms.cpp: transforms, loops, point sets. reach_split.cpp: parts of scopes. reach_treemap.cpp: rooms.
// reach_wfc.cpp: tiles. reach_automaton.cpp: cellular automata. reach_profiles.cpp: footprints, extrusions, roofs,
// assets. reach_overrides.cpp: overrides. reach_pieces.cpp: ranges in pieces. reach_report.cpp: messages.

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
  /// A rule; whether a cut in it applies to the domain; the ranges of arguments and scope; the active rules with a
  /// `depth` and their counts; and the state of overrides.
  using Key = std::tuple<uint32_t, bool, std::vector<double>, std::vector<std::pair<uint32_t, uint32_t>>,
                         std::vector<uint32_t>>;

  /// The state of derivation with respect to overrides.
  struct EditState {
    std::vector<uint32_t> begun;   ///< by path: those whose first steps lead here, and that continue
    uint32_t depth = 0;            ///< number of these steps
    std::vector<uint32_t> within;  ///< by tag: those whose own block this is in
  };

  /// The target of the `inner` of an override's block: a use of a rule, or a block with a tag.
  struct UnderEdit {
    uint32_t rule = 0;
    const std::vector<RangeValue>& args;
    const std::vector<uint32_t>& edits;  ///< those that may apply, as in Program::overrides
    const StmtNode* block = nullptr;     ///< the block with the tag; null: a use of a rule
    const RangeFrame* frame = nullptr;   ///< of that block
    size_t at = 0;                       ///< index in `edits` of the override of this block
    EditState state;                     ///< state of what `inner` derives
    const UnderEdit* outer = nullptr;
  };

  /// Which ranges are evaluated in pieces: none, those without a bound, or all.
  enum class Pieces : uint8_t { none, lost, all };

  /// By how much shapes exceed their layer's declaration, metres: possibly, and certainly.
  struct Excess {
    double may = 0, sure = 0;
  };

  // Layers.
  void layerReach(uint32_t index);
  Extent startExtent(uint32_t index);
  /// Proves as tight a bound as the budget allows if the plain proof is insufficient.
  Extent provenExtent(uint32_t index);
  Extent overParameters(uint32_t layer);
  void setCell(const Layer& layer);
  bool isFinite(const Layer& layer) const { return !program_.domain.infinite && layer.cell_expr == kNoId; }
  Excess excessOf(const Layer& layer, const Extent& extent) const;
  bool isEnough(const Layer& layer, const Extent& extent) const;
  void reportObservation(const Layer& layer, const Observation& farthest);

  // Pieces.
  bool cut(RangeValue& value, int depth, const std::function<Extent()>& extent, Extent& out, bool& first);
  Extent overPieces(const std::vector<RangeValue*>& values, const std::function<Extent()>& extent);
  Extent ruleInPieces(uint32_t rule, std::vector<RangeValue> args, const RangeFrame& caller, bool top);

  // Messages.
  /// The call that extends farthest, and its place.
  struct Contributor {
    std::string name;
    Span span;
  };
  Contributor describeContributor(const Layer& layer, const Extent& extent) const;
  std::string hint(const Extent& extent) const;
  bool needsBox(uint32_t index);
  std::string lossHint(const BoundLoss& loss) const;
  std::string lossText(const BoundLoss& loss) const;
  std::string_view written(ExprId id) const;
  /// The declaration with which all shapes of the layer fit, verified first; empty if there is none.
  std::string roomHint(uint32_t index, const Extent& extent);
  static double cellOf(const Layer& layer);  ///< edge along the axes that are cut into cells
  void report(uint32_t index, const Extent& extent);
  void reportOne(const Layer& layer, const Extent& extent, const std::string& room);
  void reportZeroDivisions();
  void finiteBox(Layer& layer, const Extent& extent);

  // Rules.
  enum class Call : uint8_t { start, instead, written };  ///< by a layer, by depth or minsize, by a statement
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
  /// The extent after the first `below` overrides; above: the override by path whose `inner` asks.
  Extent use(const UnderEdit& what, size_t below, RangeFrame& frame, const Override* above);
  Extent overridden(const UnderEdit& what, size_t at, const RangeFrame& place);
  Extent inner(const StmtNode& s, const RangeFrame& at);
  Extent tagged(const StmtNode& s, uint16_t tag, RangeFrame& frame);
  Extent untagged(const StmtNode& s, RangeFrame& frame);

  // Statements.
  Extent body(StmtId id, RangeFrame& frame);
  Extent statement(StmtId id, RangeFrame& frame);
  Extent statementKinds(const StmtNode& s, RangeFrame& frame);
  /// first: the extent before the block's own statements.
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
  const bool lossy_;    ///< a part of the text is missing
  uint32_t steps_;      ///< the rest of the budget, for all layers together
  uint64_t spent_ = 0;  ///< for the last layer, in all attempts
  /// Divide ranges of sizes only in the outermost splits: nested pieces would use up all steps.
  bool few_pieces_ = false;
  Pieces pieces_ = Pieces::none;
  uint32_t rules_ = 0;  ///< rules on the path
  bool collects_ = false;
  std::vector<ExprId> top_calls_;  ///< if collects_: the calls directly in the layer's own rule
  ExprId only_ = kNoId;            ///< the only call of a start rule to evaluate; kNoId: all
  int splits_ = 0;                 ///< number of splits around the current one
  RangeEvaluator values_;
  IntervalVector cell_{};
  bool whole_ = false;                             ///< the start has no cells
  bool centred_ = false;                           ///< the cell is centred on the origin: a finite domain's
  std::map<Key, Extent> known_, scaled_, placed_;  ///< by what was queried meanwhile; the latter two have longer keys
  std::set<Key> open_;                             ///< including the scale
  std::vector<uint32_t> active_;                   ///< number of activations of each rule on the path
  std::vector<bool> counted_;                      ///< rules whose number of activations matters
  std::map<uint32_t, uint32_t> counts_;            ///< active ones of these
  EditState edits_;
  const UnderEdit* under_ = nullptr;  ///< in an override's block: the original content
  int depth_ = 0;
  std::vector<std::vector<bool>> derived_;  ///< for each used rule, the heads that can be derived
  bool cut_short_ = false;                  ///< budget or depth was insufficient: nothing is proven
};

}  // namespace sgm
