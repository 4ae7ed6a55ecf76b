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
  bool certain = false;  ///< true: no possible value lies within the range (an error); false: some do (a warning)
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
  /// enterLoose() begins a phase in which scope sizes are overestimated, or a range is evaluated in pieces;
  /// leaveLoose() ends it. Phases may be nested. In such a phase, an argument that only possibly lies outside its
  /// parameter's range is ignored. An argument that certainly lies outside counts only if it does so in all pieces.
  void enterLoose() { ++loose_; }
  void leaveLoose() { --loose_; }
  /// Returns and clears the misfits: one for each argument; for calls within the standard library, one for each call
  /// from outside into the library.
  std::vector<Misfit> take();

 private:
  bool compares_ = false;
  int loose_ = 0;
  std::vector<Misfit> misfits_;  ///< at most one for each argument and caller
  /// arguments (with Misfit::caller) that may be within the range for some piece, or in some overestimated scope
  std::set<std::pair<ExprId, ExprId>> loosely_fitting_;
};

/// Reports misfits, at the argument or at the call into the standard library: errors if they are certain, otherwise
/// warnings.
void reportMisfits(const Program& program, std::span<const Misfit> misfits, DiagnosticSink& sink);

/// Checks the arguments of every call of a rule, let or field against the declared ranges, even if no derivation can
/// reach the call. Only arguments that do not depend on the frame are checked; checkReach(), which knows the frames,
/// checks the others.
void checkRanges(const Program& program, const CompileLimits& limits, DiagnosticSink& sink);

}  // namespace sgm
