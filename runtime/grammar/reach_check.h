#pragma once
// The proof of reach: an abstract interpretation of each layer's rules over intervals. Rules are evaluated once for
// each tuple of argument ranges and remembered, so that recursion costs its depth and not its leaves.
//
// reach.cpp: layers and what is said of them. reach_rules.cpp: calls and choice. reach_statements.cpp: statements.
// reach_transforms.cpp: transforms, loops, point sets. reach_automaton.cpp: cellular automata.

#include <map>
#include <set>
#include <tuple>
#include <vector>

#include "grammar/check.h"
#include "grammar/reach_shapes.h"

namespace sgm {

class ReachCheck {
 public:
  ReachCheck(Program& program, const CompileLimits& limits, DiagnosticSink& sink);

  void run();

 private:
  /// A rule, whether a cut in it takes from the domain, the ranges of arguments and scope, and those rules with a
  /// `depth` that are active, each with how often.
  using Key = std::tuple<uint32_t, bool, std::vector<double>, std::vector<std::pair<uint32_t, uint32_t>>>;

  // Layers.
  void layerReach(Layer& layer);
  std::string nameOf(ExprId culprit) const;
  std::string hint(const Extent& extent, bool finite, double reach, double over) const;
  void report(const Layer& layer, const Extent& extent, bool finite, double over_may, double over_sure);
  void finiteBox(Layer& layer, const Extent& extent);

  // Rules.
  enum class Call : uint8_t { start, instead, written };  ///< a layer's, that of depth and minsize, a statement
  Extent callExtent(ExprId id, const RangeFrame& frame, Call call);
  Extent ruleExtent(uint32_t rule, const std::vector<RangeValue>& args, const RangeFrame& caller, bool top);
  Extent alternatives(uint32_t rule, const std::vector<RangeValue>& args, const RangeFrame& caller, bool top);
  Extent alternativeExtent(uint32_t rule, const Alternative& head, RangeFrame& frame);
  Extent automaton(const ExprNode& n, const RangeFrame& frame);
  bool tooFar();

  // Statements.
  Extent body(StmtId id, RangeFrame& frame);
  Extent statement(StmtId id, RangeFrame& frame);
  Extent statementKinds(const StmtNode& s, RangeFrame& frame);
  Extent block(const StmtNode& s, RangeFrame& frame);
  Extent meet(const StmtNode& s, RangeFrame& frame);
  Extent morph(const StmtNode& s, RangeFrame& frame);
  Extent displaced(const StmtNode& s, RangeFrame& frame);
  Extent warped(const StmtNode& s, RangeFrame& frame);
  Extent forEach(const StmtNode& s, RangeFrame& frame);
  Extent transformed(const StmtNode& s, RangeFrame& frame);
  Extent repeated(const StmtNode& s, RangeFrame& frame);
  Extent scattered(const StmtNode& s, RangeFrame& frame);
  IntervalVector pointOf(const XformNode& x, const RangeFrame& frame);
  void sized(const XformNode& x, RangeFrame& frame);
  void sizedAgain(IdRange xforms, RangeFrame& frame);
  IntervalVector stepLengths(IdRange xforms, const RangeFrame& frame);
  IntervalVector areaOf(const ScatterNode& scatter, const RangeFrame& frame);

  Program& program_;
  DiagnosticSink& sink_;
  uint32_t steps_;  ///< left, of all layers together
  RangeEvaluator values_;
  IntervalVector cell_{};
  bool whole_ = false;                             ///< the start has no cells
  bool centred_ = false;                           ///< the cell lies about the origin: a finite domain's
  std::map<Key, Extent> known_, scaled_, placed_;  ///< by what was asked on the way; the latter two with longer keys
  std::set<Key> open_;                             ///< with the scale
  std::vector<uint32_t> active_;                   ///< activations of each rule on the path
  std::vector<bool> counted_;                      ///< rules whose activations matter
  std::map<uint32_t, uint32_t> counts_;            ///< of those, the active ones
  int depth_ = 0;
  bool cut_short_ = false;  ///< the budget or the depth was not enough: nothing is proven
};

}  // namespace sgm
