#pragma once
// Finds arguments outside of the declared ranges of their parameters.

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

/// An argument whose possible values are not all within its parameter's range.
struct Misfit {
  ExprId argument = kNoId;
  ExprId call = kNoId;
  /// for a call in the standard library: the author's call into it (CallPath::writtenCaller); otherwise kNoId
  ExprId caller = kNoId;
  uint32_t formal = 0;   ///< index of the parameter in Ast::formals
  Interval given;        ///< the possible values of the argument
  bool certain = false;  ///< no possible value lies within the range, which is an error; otherwise a warning
  bool loose = false;    ///< found while scope sizes were overestimated, so `given` may be too wide
};

/// Collects misfits during an analysis, and tracks whether scope sizes are overestimated at the moment.
class Misfits {
 public:
  /// Enables or disables compare(); initially disabled.
  void enable(bool compares) { compares_ = compares; }
  /// Compares the possible values of a call's arguments with the ranges of its formals. given: value ranges of the
  /// bound arguments. calls: the calls that enclose this one.
  void compare(const Program& program, ExprId call, IdRange formals, std::span<const RangeValue> given,
               const CallPath& calls);
  /// Mark that scope sizes are overestimated, or that a range is evaluated in pieces. Meanwhile an argument that may
  /// lie outside is ignored, and one that certainly lies outside counts only if it does so in all pieces. Pairs of
  /// calls may be nested.
  void enterLoose() { ++loose_; }
  void leaveLoose() { --loose_; }
  /// Returns and clears the misfits; one for each argument, or, within the standard library, for each of the library's
  /// callers.
  std::vector<Misfit> take();

 private:
  bool compares_ = false;
  int loose_ = 0;
  std::vector<Misfit> misfits_;  ///< at most one for each argument and caller
  /// arguments (with their callers) that fit for some piece or overestimated scope
  std::set<std::pair<ExprId, ExprId>> loosely_fitting_;
};

/// Reports misfits, at the argument or at the call into the standard library: errors if they are certain, otherwise
/// warnings.
void reportMisfits(const Program& program, std::span<const Misfit> misfits, DiagnosticSink& sink);

/// Checks the arguments of every call, even if no derivation can reach it, against the ranges of a rule, let or field,
/// as far as the arguments do not depend on the frame. checkReach() checks the rest, where the frame is known.
void checkRanges(const Program& program, const CompileLimits& limits, DiagnosticSink& sink);

}  // namespace sgm
