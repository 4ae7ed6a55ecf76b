#pragma once
// Expressions over intervals: what a value may be, for all seeds, cells and settings of the parameters.

#include <cstdint>
#include <optional>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "grammar/range/interval.h"
#include "grammar/syntax/program.h"

namespace sgm {

/// A number or condition is v[0]; a vector or pair v; a cell its offset from the cell being derived, in cells, a face
/// that of its lower cell; a segment (and a list of them) the coordinates of its ends in v[0] and its depth in v[1];
/// a plan the edges of its pieces' boxes, and in `at` where their middles lie.
struct RangeValue {
  ValueKind kind = ValueKind::unknown;
  IntervalVector v{Interval::everything(), Interval::everything(), Interval::everything()};
  IntervalVector at{};
  uint32_t loss = 0;  ///< why it has no bound, into RangeEvaluator::losses(); 0: it has one, or nothing is known

  bool bounded() const;  ///< or no number, vector or pair

  static RangeValue number(Interval i) { return {ValueKind::number, {i, {}, {}}, {}}; }
  static RangeValue condition(Interval i) { return {ValueKind::boolean, {i, {}, {}}, {}}; }
  static RangeValue vector(const IntervalVector& v) { return {ValueKind::vector, v, {}}; }
  static RangeValue unknown() { return {}; }
};

/// Where a scope may lie: metres from the cell's low corner.
struct PlaceRange {
  IntervalVector offset{};
  Interval scale{1, 1};
  bool turned = false;  ///< in whatever way

  void move(const IntervalVector& by);
  friend bool operator==(const PlaceRange&, const PlaceRange&) = default;
};

/// What a frame's expressions may refer to.
struct RangeFrame {
  std::vector<RangeValue> slots;
  IntervalVector scope{};  ///< edges of the scope's box
  PlaceRange place;        ///< of the statement
  PlaceRange start;        ///< of the rule
  bool top = false;        ///< the layer's own use of its start rule, in which a cut takes from the domain
};

/// Where a value loses its bound.
struct BoundLoss {
  enum class Cause : uint8_t { none, divisor, parameter } cause = Cause::none;
  ExprId expr = kNoId;    ///< the quotient, or the use of the parameter
  ExprId caller = kNoId;  ///< the innermost call around it that the library does not make; or kNoId
  Interval divisor;
};

/// What is given to a formal and does not lie in its range.
struct Misfit {
  ExprId argument = kNoId;
  ExprId call = kNoId;
  ExprId caller = kNoId;  ///< as in BoundLoss
  uint32_t formal = 0;    ///< into Ast::formals
  Interval given;
  bool certain = false;  ///< all of it lies outside
  bool loose = false;    ///< found where scopes are larger than they may be
};

/// Whether a file (Span::file) is a part of the standard library that another file imports.
bool isStandard(const Program& program, uint32_t file);

/// What is wide enough to be proven piece by piece: a number with a finite range.
bool hasPieces(const RangeValue& value);
/// Where to cut such a range: by ratio where all of it is positive, as sizes are.
double middleOf(Interval range);

/// Any vector as long as one of these.
IntervalVector anyDirection(const IntervalVector& v);

class RangeEvaluator {
 public:
  /// steps: what is left of the caller's budget; at 0 every value is unknown.
  RangeEvaluator(const Program& program, uint32_t& steps);

  /// The edges of a cell; `centred`: it lies about the origin of the start's scope, otherwise that is its low corner.
  void setCell(const IntervalVector& edges, bool centred) {
    cell_ = edges;
    low_ = centred ? -0.5 : 0.0;
  }

  /// What has been asked since it was cleared: where a rule stands, and how it is scaled. Ranges of other places or
  /// scales are the same where it was not.
  struct Asked {
    bool place = false, scale = false;
  };
  Asked& asked() { return asked_; }

  /// How far from the cell queries look, along the axes that are cut into cells, and which looks farthest.
  struct Sight {
    double far = 0;
    ExprId query = kNoId;
  };
  Sight& sight() { return sight_; }

  /// The calls of rules around what is evaluated, for what is told of its values.
  void enter(ExprId call) { callers_.push_back(call); }
  void leave() { callers_.pop_back(); }
  /// Of what stands in the standard library: the innermost call around it that does not; otherwise kNoId.
  ExprId callerOf(ExprId id) const;
  /// Index 0 stands for none.
  const std::vector<BoundLoss>& losses() const { return losses_; }
  /// The loss of what has been evaluated since it was taken; 0 if all of it has a bound.
  uint32_t takeLoss() { return std::exchange(loss_, 0); }
  /// After others were taken between: of what had been evaluated before.
  void giveBackLoss(uint32_t loss) {
    if (loss != 0) loss_ = loss;
  }
  /// Divisions by what is 0 for certain.
  const std::vector<BoundLoss>& zeroDivisions() const { return zeros_; }

  /// Whether what is given to formals is held against their ranges.
  void judgeArguments(bool judges) { judges_ = judges; }
  /// What a call gives to its formals; `given` is what the bound arguments are.
  void judge(ExprId call, IdRange formals, std::span<const RangeValue> given);
  /// In parts of scopes whose sizes have ranges wider than they are, or parts of these ranges, one by one: what may lie
  /// outside there says nothing, and what does is certain only where it does in all of them.
  void enterLoose() { ++loose_; }
  void leaveLoose() { --loose_; }
  /// What did not fit since they were taken; of one argument, or of one caller of the library, once.
  std::vector<Misfit> takeMisfits();

  /// What a parameter may be; at first all of its range.
  Interval& parameter(uint32_t index) { return parameters_[index]; }
  const std::vector<bool>& askedParameters() const { return asked_parameters_; }
  /// Whether functions without a bound are followed piece by piece of their arguments.
  void takePieces(bool takes) { pieces_ = takes; }

  RangeValue evaluate(ExprId id, const RangeFrame& frame);
  Interval number(ExprId id, const RangeFrame& frame);
  IntervalVector vector(ExprId id, const RangeFrame& frame);
  /// [0, 0] false, [1, 1] true, otherwise either.
  Interval condition(ExprId id, const RangeFrame& frame);

  /// Narrows the slots of a frame to where a condition holds (or does not): comparisons of a local with a value, joined
  /// by `and` (or, denied, `or`).
  void refine(ExprId condition, bool holds, RangeFrame& frame);

 private:
  RangeValue valueOf(ExprId id, const RangeFrame& frame);
  RangeValue query(ExprId id, const RangeFrame& frame);
  RangeValue binary(ExprId id, const RangeFrame& frame);
  RangeValue call(ExprId id, const RangeFrame& frame);
  RangeValue builtin(const ExprNode& n, const RangeFrame& frame);
  RangeValue applied(ExprId id, const RangeFrame& frame);
  /// A function's value over a range of one argument, piece by piece; nothing if a piece has no bound either.
  std::optional<RangeValue> inPieces(ExprId body, RangeFrame& frame, uint32_t slot, Interval range, int depth);
  void lose(BoundLoss::Cause cause, ExprId id, Interval divisor);
  RangeValue member(const ExprNode& n, const RangeFrame& frame);
  /// A point of the cell, in the scope that the rule starts with.
  RangeValue point(const IntervalVector& from_cell, const RangeFrame& frame);
  uint32_t child(const ExprNode& n, uint32_t i) const { return program_.idAt(n.children, i); }

  const Program& program_;
  uint32_t& steps_;
  IntervalVector cell_{};
  double low_ = 0;  ///< of the cell, in cells
  Asked asked_;
  Sight sight_;
  int depth_ = 0;
  bool pieces_ = false;
  bool judges_ = false;
  int loose_ = 0;
  std::vector<Misfit> misfits_;                          ///< one of each argument and caller
  std::set<std::pair<ExprId, ExprId>> loosely_fitting_;  ///< what may lie in its range where scopes are loose
  std::vector<Interval> parameters_;
  std::vector<bool> asked_parameters_;
  std::vector<ExprId> callers_;
  std::vector<BoundLoss> losses_{1}, zeros_;
  uint32_t loss_ = 0;
};

}  // namespace sgm
