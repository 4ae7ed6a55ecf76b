#pragma once
// Searches for a declaration of a layer (cell, reach, or the domain's box) in which its shapes fit. Each candidate is
// proven before a message suggests it.

#include <cstdint>
#include <string>

#include "grammar/range/extent.h"
#include "grammar/reach/reach_context.h"

namespace sgm::reach {

/// Saves a layer's and the domain's declaration while other values are tried; the destructor restores them.
class TrialDeclaration {
 public:
  /// index: into Program::layers. The context must outlive this object.
  TrialDeclaration(uint32_t index, ReachContext& context);
  ~TrialDeclaration();
  TrialDeclaration(const TrialDeclaration&) = delete;
  TrialDeclaration& operator=(const TrialDeclaration&) = delete;

 private:
  ReachContext& context_;
  Layer& layer_;
  const Int3 cell_;
  const int32_t reach_;
  const IntBox box_;
};

/// Whether the shapes of a finite grammar have a bound only if the domain declares a box, since without a box the
/// start's scope is unbounded.
bool needsBox(uint32_t index, ReachContext& context);

/// Returns a hint with a declaration in which all shapes of the layer fit; empty if no trial finds one. extent: must be
/// bounded; the extent of the shapes that exceed the written declaration.
std::string findRoom(uint32_t index, const Extent& extent, ReachContext& context);

}  // namespace sgm::reach
