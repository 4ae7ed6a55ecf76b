#pragma once
// Why a place is solid or open: which shape decides there, whose rule made it, and what else had a say.

#include <string>
#include <vector>

#include "world/world_field.h"

namespace sgm {

/// A node of what decides, or one that it is made of.
struct ExplainedNode {
  ShapeKind kind = ShapeKind::sphere;
  int depth = 0;       ///< nodes that it stands in
  double value = 0;    ///< of its field there, units; negative inside of it
  bool cuts = false;   ///< it is taken away from what it stands in, or from the domain
  double measure = 0;  ///< smooth unions, cuts and meets: their radius, units; morphs: t; displacements: by how much,
                       ///< units; warps: how far, units
  size_t others = 0;   ///< parts of it that do not decide, and are not listed
  std::string path;    ///< of the use of a rule whose statement made it, what an override names: where an override made
                       ///< it, of the use whose block that takes the place of
  Span span;           ///< of that statement
};

struct Explanation {
  bool solid = false;
  double value = 0;                ///< of the world's field there, units; a distance only near the surface
  uint16_t material = 0, tag = 0;  ///< Program::materials and tags: of the surface that the place would lie on
  uint32_t layer = 0;              ///< of what decides
  Int3 cell;
  /// From the whole group to the shape, parts behind what they are part of. Of a morph both sides follow. None: no
  /// shape comes near, the domain is what it is there.
  std::vector<ExplainedNode> nodes;
  size_t leaf = 0;  ///< among the nodes: the shape that decides
};

/// At level 0, without host fields and edits. Errors: those of WorldField::compile and trace.
Result<Explanation> explain(const WorldField& world, Int3 place);

}  // namespace sgm
