#pragma once
// The calls that stand directly in a layer's start rule. Messages report each of them separately.

#include <algorithm>
#include <utility>
#include <vector>

#include "grammar/syntax/ast.h"

namespace sgm::reach {

/// Collects the calls of the start rule while collecting is on, and can restrict evaluation to a single one of them.
class StartCalls {
 public:
  /// Records a call, if collecting is on and the call is not recorded yet. Returns whether the call shall be evaluated.
  bool admit(ExprId call) {
    if (isRestricted() && call != only_) return false;
    if (collects_ && std::find(calls_.begin(), calls_.end(), call) == calls_.end()) calls_.push_back(call);
    return true;
  }

  void beginCollecting() {
    calls_.clear();
    collects_ = true;
  }
  /// Returns the calls recorded since beginCollecting(), in the order of evaluation.
  std::vector<ExprId> endCollecting() {
    collects_ = false;
    return std::move(calls_);
  }

  /// From now on admits only this call; kNoId: all calls.
  void restrictTo(ExprId call) { only_ = call; }
  bool isRestricted() const { return only_ != kNoId; }

 private:
  ExprId only_ = kNoId;
  bool collects_ = false;
  std::vector<ExprId> calls_;
};

}  // namespace sgm::reach
