// The activations of one rule in a cell, each by itself.

#include "derive/interpret/interpreter.h"

namespace sgm {

bool Interpreter::collectAlone(const ShapeBounds& bounds, const ShapeList& list, bool cut,
                               std::vector<Group>& out) const {
  for (uint32_t root : list) {
    const IntBox box = bounds.level(root, 0);
    if (box.empty()) continue;
    if (!cut && !isBounded(box)) return false;
    out.push_back({root, cut, box, draft_.origin(root).key});
  }
  return true;
}

Result<std::vector<RuleInstance>> Interpreter::runInstances(uint32_t rule, std::pmr::memory_resource* memory) {
  watched_rule_ = rule;
  start();
  if (failed()) return *error_;
  const ShapeBounds bounds(draft_.chunk());
  DraftCopier copier(draft_.chunk());
  std::vector<RuleInstance> instances;
  size_t shapes = 0;
  for (const WatchedCall& call : watched_) {
    RuleInstance instance{activations_[call.activation].start.snap({}), pathText(call.activation), true,
                          GrammarChunk(memory)};
    instance.chunk.layer = layer_index_;
    instance.chunk.cell = cell_;
    std::vector<Group> groups;
    const bool cuts_only = call.shapes.empty();
    instance.bounded =
        collectAlone(bounds, call.shapes, false, groups) && collectAlone(bounds, call.layer_cuts, !cuts_only, groups);
    if (instance.bounded) copier.copy(groups, instance.chunk);
    instance.chunk.anchors.assign(anchors_.begin() + static_cast<std::ptrdiff_t>(call.first_anchor),
                                  anchors_.begin() + static_cast<std::ptrdiff_t>(call.end_anchor));
    // Nested activations repeat the shapes below them.
    shapes += instance.chunk.shapes.size();
    if (shapes > limits_.shapes) {
      return Error{Code::limit, "the uses of `" + std::string(program_.text(program_.rules[rule].name)) +
                                    "` in one cell have more than " + std::to_string(limits_.shapes) +
                                    " shapes together; ask for a smaller rule"};
    }
    instances.push_back(std::move(instance));
  }
  return instances;
}

}  // namespace sgm
