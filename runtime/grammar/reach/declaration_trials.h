#pragma once
// Searches for a declaration of a layer (cell, reach, or the domain's box) in which its shapes fit. Each candidate is
// proven before a message suggests it.

#include <cstdint>
#include <string>

#include "grammar/range/extent.h"
#include "grammar/reach/reach_context.h"

namespace sgm::reach {

/// Keeps the original declarations of a layer and of the domain while other values are tried in their place; the
/// destructor restores the originals.
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

/// True if the domain is finite, and the shapes have a bound only if it declares a box: without a box, the scope of the
/// start rule is unbounded.
bool needsBox(uint32_t index, ReachContext& context);

/// Returns a hint with a declaration in which all shapes of the layer fit; empty if no trial finds one. extent: the
/// extent of the shapes, which exceeds the declaration in the grammar; must be bounded.
std::string findRoom(uint32_t index, const Extent& extent, ReachContext& context);

}  // namespace sgm::reach
