#pragma once
// Finds the cuts that remove from the domain's solid: those directly at the top level of a layer's start rule, not
// nested in another shape.

#include <cstdint>
#include <set>
#include <vector>

#include "grammar/check/check_context.h"

namespace sgm {

/// Marks the statements at the top level of layers, where cuts remove from the domain. Collects the overrides whose
/// blocks may be used there.
class LayerLevel {
 public:
  explicit LayerLevel(CheckContext& check) : check_(check) {}

  /// Sets StmtNode::layer_level in the start rules of layers and in the overrides that may apply there. Reports an
  /// error if an `inner`, which stands for the content that an override replaces, is nested in other shapes although
  /// this content may contain a cut of the domain. Precondition: all rules and overrides are checked.
  void mark();

 private:
  void markStatement(StmtId id);
  /// index: into Program::overrides. cuts: true if the content that the override replaces contains a cut of the domain;
  /// `inner` must then stand at the top level of the layer.
  void markOverride(uint32_t index, bool cuts);
  bool cutsDomain(StmtId id) const;

  CheckContext& check_;
  std::set<uint32_t> overrides_;
};

}  // namespace sgm
