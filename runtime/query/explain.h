#pragma once
// Explains why a place is solid or void: which shape decides, the rule that made it, and the other shapes involved.

#include <string>
#include <vector>

#include "world/world_field.h"

namespace sgm {

/// A node of the deciding group's tree of shapes.
struct ExplainedNode {
  ShapeKind kind = ShapeKind::sphere;
  int depth = 0;      ///< number of nodes that enclose it
  double value = 0;   ///< value of the node's field at the place, in units; negative inside
  bool cuts = false;  ///< true if the node is cut from the node that encloses it, or from the domain
  /// smooth unions, cuts and meets: the radius in units; morphs: t; displacements: the amount in units; warps: the
  /// distance in units
  double measure = 0;
  size_t others = 0;  ///< number of its children that do not decide and are not listed
  /// path, as an override names it, of the rule's use whose statement made the node; if an override made it, of the use
  /// whose block the override replaces
  std::string path;
  Span span;  ///< place of the statement in the source
};

struct Explanation {
  bool solid = false;
  /// value of the world's field at the place, in units; a distance only near the surface
  double value = 0;
  uint16_t material = 0, tag = 0;  ///< indices into Program::materials and tags of a surface at the place
  uint32_t layer = 0;              ///< layer of the deciding group
  Int3 cell;
  /// From the whole group down to the deciding shape: each node follows the node that encloses it. A morph is followed
  /// by both of its sides. Empty if no shape comes near: then the domain decides.
  std::vector<ExplainedNode> nodes;
  size_t leaf = 0;  ///< index of the deciding shape in nodes
};

/// Explains a place at level 0, without host fields and edits. Errors: those of WorldField::compile and trace.
Result<Explanation> explain(const WorldField& world, Int3 place);

}  // namespace sgm
