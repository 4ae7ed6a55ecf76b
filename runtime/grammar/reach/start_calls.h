#pragma once
// The calls directly in a layer's own rule, which messages judge one by one.

#include <algorithm>
#include <utility>
#include <vector>

#include "grammar/syntax/ast.h"

namespace sgm::reach {

/// Owns the only call of the layer's own rule that is evaluated, if there is one, and the calls that were met while
/// they are collected.
class StartCalls {
 public:
  /// Collects a call, each one once. Returns whether it is evaluated.
  bool admit(ExprId call) {
    if (isRestricted() && call != only_) return false;
    if (collects_ && std::find(calls_.begin(), calls_.end(), call) == calls_.end()) calls_.push_back(call);
    return true;
  }

  void beginCollecting() {
    calls_.clear();
    collects_ = true;
  }
  /// Returns the calls since beginCollecting(), in the order of evaluation.
  std::vector<ExprId> endCollecting() {
    collects_ = false;
    return std::move(calls_);
  }

  /// Evaluates only this call from now on; kNoId: all calls.
  void restrictTo(ExprId call) { only_ = call; }
  bool isRestricted() const { return only_ != kNoId; }

 private:
  ExprId only_ = kNoId;
  bool collects_ = false;
  std::vector<ExprId> calls_;
};

}  // namespace sgm::reach
