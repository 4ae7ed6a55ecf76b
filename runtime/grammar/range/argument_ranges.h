#pragma once
// Arguments outside of the ranges of their parameters.

#include <cstdint>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "grammar/range/call_path.h"
#include "grammar/range/range_value.h"
#include "grammar/text/limits.h"
#include "grammar/text/sink.h"

namespace sgm {

/// An argument outside of its formal's range.
struct Misfit {
  ExprId argument = kNoId;
  ExprId call = kNoId;
  ExprId caller = kNoId;  ///< CallPath::writtenCaller of the call
  uint32_t formal = 0;    ///< into Ast::formals
  Interval given;
  bool certain = false;  ///< all of it lies outside
  bool loose = false;    ///< found while scopes were overestimated
};

/// Owns the misfits that an analysis found since they were last taken, and whether scopes are overestimated now.
class Misfits {
 public:
  /// Sets whether compare() compares; at first it does nothing.
  void enable(bool compares) { compares_ = compares; }
  /// Compares the arguments of a call with its formals. given: values of the bound arguments. calls: those around it.
  void compare(const Program& program, ExprId call, IdRange formals, std::span<const RangeValue> given,
               const CallPath& calls);
  /// Marks evaluation with overestimated scope sizes, or for pieces of ranges one by one: an argument that may lie
  /// outside then proves nothing, and one that certainly does counts only if it does in all pieces.
  void enterLoose() { ++loose_; }
  void leaveLoose() { --loose_; }
  /// Takes the misfits since the last call; one for each argument, or for each caller of the library.
  std::vector<Misfit> take();

 private:
  bool compares_ = false;
  int loose_ = 0;
  std::vector<Misfit> misfits_;                          ///< one for each argument and caller
  std::set<std::pair<ExprId, ExprId>> loosely_fitting_;  ///< those that may be in range when scopes are overestimated
};

/// Reports certain misfits as errors, others as warnings: at the argument, or at the library's caller.
void reportMisfits(const Program& program, std::span<const Misfit> misfits, DiagnosticSink& sink);

/// Checks every call, derived or not, whose arguments lie outside of the ranges of a rule, let or field, if that does
/// not depend on the frame. checkReach() checks the rest, where the frame is known.
void checkRanges(const Program& program, const CompileLimits& limits, DiagnosticSink& sink);

}  // namespace sgm
