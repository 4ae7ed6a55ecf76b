#pragma once
// Which cuts remove from the domain: those directly at the level of a layer's start rule.

#include <cstdint>
#include <set>
#include <vector>

#include "grammar/check/check_context.h"

namespace sgm {

/// The overrides whose blocks may be used at the level of a layer.
class LayerLevel {
 public:
  explicit LayerLevel(CheckContext& check) : check_(check) {}

  /// Sets StmtNode::layer_level in the rules that layers start with, and in the overrides that may apply there. Reports
  /// an `inner` inside of other shapes if it may derive such a cut. Precondition: all rules and overrides are checked.
  void mark();

 private:
  void markStatement(StmtId id);
  /// cuts: the replaced content has such a cut; so `inner` must be at the level of the layer.
  void markOverride(uint32_t index, bool cuts);
  bool cutsDomain(StmtId id) const;

  CheckContext& check_;
  std::set<uint32_t> overrides_;
};

}  // namespace sgm
