#pragma once
// Declarations of a layer that would give its shapes room: a proof is tried with each before a message suggests it.

#include <cstdint>
#include <string>

#include "grammar/range/extent.h"
#include "grammar/reach/reach_context.h"

namespace sgm::reach {

/// Owns the written declaration of a layer and of the domain while others are tried; its end restores them.
class TrialDeclaration {
 public:
  /// index: into Program::layers. The context must outlive this.
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

/// Whether the domain of a finite grammar needs a box: without one its scope is unbounded; with one, its content may be
/// bounded.
bool needsBox(uint32_t index, ReachContext& context);

/// The hint with the declaration in which all shapes of the layer fit; empty if no trial finds one. extent: bounded, of
/// the shapes that exceed the written declaration.
std::string findRoom(uint32_t index, const Extent& extent, ReachContext& context);

}  // namespace sgm::reach
