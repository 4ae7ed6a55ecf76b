#pragma once
// Evaluates expressions over intervals: their possible values for all seeds, cells and parameter settings.

#include <cstdint>
#include <optional>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "grammar/range/interval.h"
#include "grammar/syntax/program.h"

namespace sgm {

/// By kind: a number or condition uses v[0]; a vector or pair uses v. A cell is its offset from the derived cell, in
/// cells, and a face that of its lower cell. A segment (or a list of them) has the coordinates of its ends in v[0] and
/// its depth in v[1]. A plan has the edges of its pieces' boxes in v, and the places of their middles in `at`.
struct RangeValue {
  ValueKind kind = ValueKind::unknown;
  IntervalVector v{Interval::everything(), Interval::everything(), Interval::everything()};
  IntervalVector at{};
  uint32_t loss = 0;  ///< why it has no bound: index in RangeEvaluator::losses(); 0: it has one, or unknown

  bool bounded() const;  ///< or not a number, vector or pair

  static RangeValue number(Interval i) { return {ValueKind::number, {i, {}, {}}, {}}; }
  static RangeValue condition(Interval i) { return {ValueKind::boolean, {i, {}, {}}, {}}; }
  static RangeValue vector(const IntervalVector& v) { return {ValueKind::vector, v, {}}; }
  static RangeValue unknown() { return {}; }
};

/// The possible places of a scope: metres from the cell's low corner.
struct PlaceRange {
  IntervalVector offset{};
  Interval scale{1, 1};
  bool turned = false;  ///< in any direction

  void move(const IntervalVector& by);
  friend bool operator==(const PlaceRange&, const PlaceRange&) = default;
};

/// The context of a frame's expressions.
struct RangeFrame {
  std::vector<RangeValue> slots;
  IntervalVector scope{};  ///< edges of the scope's box
  PlaceRange place;        ///< of the statement
  PlaceRange start;        ///< of the rule
  bool top = false;        ///< the layer's own use of its start rule, where a cut applies to the domain
};

/// The place where a value loses its bound.
struct BoundLoss {
  enum class Cause : uint8_t { none, divisor, parameter } cause = Cause::none;
  ExprId expr = kNoId;    ///< the quotient, or the use of the parameter
  ExprId caller = kNoId;  ///< the innermost call around it outside of the library, or kNoId
  Interval divisor;
};

/// An argument outside of its formal's range.
struct Misfit {
  ExprId argument = kNoId;
  ExprId call = kNoId;
  ExprId caller = kNoId;  ///< as in BoundLoss
  uint32_t formal = 0;    ///< into Ast::formals
  Interval given;
  bool certain = false;  ///< all of it lies outside
  bool loose = false;    ///< found while scopes were overestimated
};

/// Whether a file (Span::file) belongs to the standard library and was imported.
bool isStandard(const Program& program, uint32_t file);

/// Whether the value can be divided for a proof in pieces: a number with a finite range.
bool hasPieces(const RangeValue& value);
/// The place to divide such a range: by ratio if all of it is positive, as for sizes.
double middleOf(Interval range);

/// Any vector with the length of one of these.
IntervalVector anyDirection(const IntervalVector& v);

class RangeEvaluator {
 public:
  /// steps: the rest of the caller's budget; at 0 every value is unknown.
  RangeEvaluator(const Program& program, uint32_t& steps);

  /// Sets the edges of a cell. centred: it lies around the origin of the start's scope, otherwise its low corner is
  /// there.
  void setCell(const IntervalVector& edges, bool centred) {
    cell_ = edges;
    low_ = centred ? -0.5 : 0.0;
  }

  /// What was queried since this was cleared: the place of a rule, and its scale. Without such a query, results are the
  /// same for other places or scales.
  struct Asked {
    bool place = false, scale = false;
  };
  Asked& asked() { return asked_; }

  /// The longest reach of queries out of the cell, along axes that are cut into cells, and the query responsible.
  struct Sight {
    double far = 0;
    ExprId query = kNoId;
  };
  Sight& sight() { return sight_; }

  /// The rule calls around the current evaluation, for messages.
  void enter(ExprId call) { callers_.push_back(call); }
  void leave() { callers_.pop_back(); }
  /// For an expression in the standard library: the innermost call around it outside of the library; else kNoId.
  ExprId callerOf(ExprId id) const;
  /// Index 0 is none.
  const std::vector<BoundLoss>& losses() const { return losses_; }
  /// Takes the loss of evaluations since the last call; 0 if all of them are bounded.
  uint32_t takeLoss() { return std::exchange(loss_, 0); }
  /// Restores an earlier loss after others were taken in between.
  void giveBackLoss(uint32_t loss) {
    if (loss != 0) loss_ = loss;
  }
  /// Divisions by a value that is certainly 0.
  const std::vector<BoundLoss>& zeroDivisions() const { return zeros_; }

  /// Sets whether arguments are compared with the ranges of their formals.
  void judgeArguments(bool judges) { judges_ = judges; }
  /// Compares the arguments of a call with its formals; `given`: values of the bound arguments.
  void judge(ExprId call, IdRange formals, std::span<const RangeValue> given);
  /// Marks evaluation with overestimated scope sizes, or for pieces of ranges one by one: an argument that may lie
  /// outside then proves nothing, and one that certainly does counts only if it does in all pieces.
  void enterLoose() { ++loose_; }
  void leaveLoose() { --loose_; }
  /// Takes the misfits since the last call; one for each argument, or for each caller of the library.
  std::vector<Misfit> takeMisfits();

  /// The possible values of a parameter; at first its whole range.
  Interval& parameter(uint32_t index) { return parameters_[index]; }
  const std::vector<bool>& askedParameters() const { return asked_parameters_; }
  /// Sets whether functions without a bound are evaluated in pieces of their arguments.
  void takePieces(bool takes) { pieces_ = takes; }

  RangeValue evaluate(ExprId id, const RangeFrame& frame);
  Interval number(ExprId id, const RangeFrame& frame);
  IntervalVector vector(ExprId id, const RangeFrame& frame);
  /// [0, 0]: false, [1, 1]: true, otherwise either.
  Interval condition(ExprId id, const RangeFrame& frame);

  /// Narrows the slots of a frame to values for which a condition holds (or not): comparisons of a local with a value,
  /// joined by `and` (if negated, by `or`).
  void refine(ExprId condition, bool holds, RangeFrame& frame);

 private:
  RangeValue valueOf(ExprId id, const RangeFrame& frame);
  RangeValue query(ExprId id, const RangeFrame& frame);
  RangeValue binary(ExprId id, const RangeFrame& frame);
  RangeValue call(ExprId id, const RangeFrame& frame);
  RangeValue builtin(const ExprNode& n, const RangeFrame& frame);
  RangeValue applied(ExprId id, const RangeFrame& frame);
  /// Evaluates a function in pieces of one argument's range; nullopt if a piece has no bound either.
  std::optional<RangeValue> inPieces(ExprId body, RangeFrame& frame, uint32_t slot, Interval range, int depth);
  void lose(BoundLoss::Cause cause, ExprId id, Interval divisor);
  RangeValue member(const ExprNode& n, const RangeFrame& frame);
  /// A point of the cell, relative to the scope with which the rule starts.
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
  std::vector<Misfit> misfits_;                          ///< one for each argument and caller
  std::set<std::pair<ExprId, ExprId>> loosely_fitting_;  ///< those that may be in range when scopes are overestimated
  std::vector<Interval> parameters_;
  std::vector<bool> asked_parameters_;
  std::vector<ExprId> callers_;
  std::vector<BoundLoss> losses_{1}, zeros_;
  uint32_t loss_ = 0;
};

}  // namespace sgm
