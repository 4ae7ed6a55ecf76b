#pragma once
// Explains why a place is solid or open: the deciding shape, the rule that made it, and the other shapes involved.

#include <string>
#include <vector>

#include "world/world_field.h"

namespace sgm {

/// The deciding node, or a node inside of it.
struct ExplainedNode {
  ShapeKind kind = ShapeKind::sphere;
  int depth = 0;       ///< number of nodes around it
  double value = 0;    ///< of its field at the place, units; negative inside
  bool cuts = false;   ///< whether it is cut from the node around it, or from the domain
  double measure = 0;  ///< smooth unions, cuts and meets: the radius, units; morphs: t; displacements: the amount,
                       ///< units; warps: the distance, units
  size_t others = 0;   ///< its parts that do not decide; they are not listed
  std::string path;    ///< the use of the rule whose statement made it, as an override names it; if an override made
                       ///< it, the use whose block the override replaces
  Span span;           ///< of the statement
};

struct Explanation {
  bool solid = false;
  double value = 0;                ///< of the world's field at the place, units; a distance only near the surface
  uint16_t material = 0, tag = 0;  ///< indices into Program::materials and tags, for a surface at the place
  uint32_t layer = 0;              ///< of the deciding group
  Int3 cell;
  /// From the whole group down to the shape, each node after the node around it. A morph is followed by both sides.
  /// Empty if no shape comes near: then the domain decides.
  std::vector<ExplainedNode> nodes;
  size_t leaf = 0;  ///< index of the deciding shape in nodes
};

/// At level 0, without host fields and edits. Errors: those of WorldField::compile and trace.
Result<Explanation> explain(const WorldField& world, Int3 place);

}  // namespace sgm
