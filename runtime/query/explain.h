#pragma once
// Explains why a place is solid or void: which shape decides, the rule that made it, and the other shapes involved.

#include <string>
#include <vector>

#include "world/world_field.h"

namespace sgm {

/// A node of the shape tree of the group that decides the field's value.
struct ExplainedNode {
  ShapeKind kind = ShapeKind::sphere;
  int depth = 0;      ///< depth in the tree: number of nodes that enclose this node
  double value = 0;   ///< value of the node's field at the place, in units; negative inside
  bool cuts = false;  ///< true if the node is cut from the node that encloses it, or from the domain
  /// radius in units for smooth unions, cuts and meets; t for morphs; amount in units for displacements; distance in
  /// units for warps
  double measure = 0;
  size_t others = 0;  ///< number of the node's children that do not decide the value and are not listed
  /// Derivation path, in the format of overrides, of the rule use that made the node. If an override made the node, the
  /// path of the rule use whose block it replaces.
  std::string path;
  Span span;  ///< span of the statement in the source text
};

struct Explanation {
  bool solid = false;
  /// value of the world's field at the place, in units; only near the surface it is a distance
  double value = 0;
  uint16_t material = 0, tag = 0;  ///< indices into Program::materials and Program::tags of a surface at the place
  uint32_t layer = 0;              ///< layer of the group that decides the value
  Int3 cell;
  /// The nodes from the root of the group to the deciding shape; each node follows the node that encloses it. A morph
  /// is followed by both of its operands. Empty if no shape is near the place, so that the domain decides.
  std::vector<ExplainedNode> nodes;
  size_t leaf = 0;  ///< index of the deciding shape in `nodes`
};

/// Explains the value of the field at a place, at level 0, without host fields and edits. Errors: those of
/// WorldField::compile and trace.
Result<Explanation> explain(const WorldField& world, Int3 place);

}  // namespace sgm
