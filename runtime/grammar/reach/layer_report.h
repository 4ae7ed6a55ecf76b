#pragma once
// Messages if the reach of a layer is not proven: the cause, at a line that its author can change, and the remedy.

#include <cstdint>
#include <string>
#include <utility>

#include "grammar/range/extent.h"
#include "grammar/reach/reach_context.h"

namespace sgm::reach {

/// Owns a layer whose reach is not proven, and the declaration that would give its shapes room.
class LayerReport {
 public:
  /// room: the hint with that declaration, or empty. needs_box: a box of the domain would bound shapes without a bound.
  /// Layer and context must outlive this.
  LayerReport(const Layer& layer, std::string room, bool needs_box, const ReachContext& context)
      : layer_(layer), room_(std::move(room)), needs_box_(needs_box), context_(context), program_(context.program) {}

  /// Reports shapes of the layer that exceed its declaration: an error, or a warning if they may also stay within it.
  void report(const Extent& extent) const;

 private:
  /// The call that extends farthest, for a message, and its place.
  struct Contributor {
    std::string name;
    Span span;
  };
  Contributor describeContributor(const Extent& extent) const;
  ExprId divisor(const BoundLoss& loss) const;
  /// The reason that follows the message, if a value without a bound is the cause.
  std::string lossText(const BoundLoss& loss) const;
  std::string lossHint(const BoundLoss& loss) const;
  /// The remedy for shapes without a bound.
  std::string boundHint(const Extent& extent) const;

  const Layer& layer_;
  const std::string room_;
  const bool needs_box_;
  const ReachContext& context_;
  const Program& program_;
};

/// Reports all causes at once: every call in the layer's own rule that exceeds the declaration by itself. extent: of
/// all of them. index: into Program::layers.
void reportLayer(uint32_t index, const Extent& extent, ReachContext& context);

/// Content on which a cell depends must lie within its reach: reports the query that looks farthest, unless it does.
void reportObservation(const Layer& layer, ReachContext& context);

/// Reports divisions that never have a value. Each is an error of its own, at its line.
void reportZeroDivisions(ReachContext& context);

}  // namespace sgm::reach
