#pragma once
// Reports layers whose shapes are not proven to stay within the reach that the layer declares. A message names the
// cause, at a line that the grammar's author can change, and suggests a remedy.

#include <cstdint>
#include <string>
#include <utility>

#include "grammar/range/extent.h"
#include "grammar/reach/reach_context.h"

namespace sgm::reach {

/// Writes the messages about one layer whose reach is not proven.
class LayerReport {
 public:
  /// room: a hint with a declaration in which the shapes fit, or empty (see findRoom). needs_box: the shapes are
  /// unbounded only because the domain declares no box. Layer and context must outlive this object.
  LayerReport(const Layer& layer, std::string room, bool needs_box, const ReachContext& context)
      : layer_(layer), room_(std::move(room)), needs_box_(needs_box), context_(context), program_(context.program) {}

  /// Reports shapes that exceed the layer's declaration: an error if they certainly do, a warning if they only may.
  void report(const Extent& extent) const;

 private:
  /// The call whose shapes extend farthest: its name and its position in the text.
  struct Contributor {
    std::string name;
    Span span;
  };
  Contributor describeContributor(const Extent& extent) const;
  ExprId divisor(const BoundLoss& loss) const;
  /// Returns the end of a message: the reason why a value has no bound.
  std::string lossText(const BoundLoss& loss) const;
  std::string lossHint(const BoundLoss& loss) const;
  /// The hint for shapes without a bound.
  std::string boundHint(const Extent& extent) const;

  const Layer& layer_;
  const std::string room_;
  const bool needs_box_;
  const ReachContext& context_;
  const Program& program_;
};

/// Reports all calls in the layer's own rule that exceed the layer's declaration by themselves, so that one run of the
/// compiler shows all of them. extent: the extent of all calls together. index: index into Program::layers.
void reportLayer(uint32_t index, const Extent& extent, ReachContext& context);

/// Reports the query that looks farthest if it may look beyond the layer's reach: a cell must depend only on content
/// within its reach.
void reportObservation(const Layer& layer, ReachContext& context);

/// Reports divisions whose divisor is always 0, each as an error at its line.
void reportZeroDivisions(ReachContext& context);

}  // namespace sgm::reach
