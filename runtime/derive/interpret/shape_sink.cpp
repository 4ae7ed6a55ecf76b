#include "derive/interpret/shape_sink.h"

#include <algorithm>
#include <string>

#include "derive/draws.h"

namespace sgm::interpret {

Shape shapeIn(const Env& env, ShapeKind kind) {
  Shape s;
  s.kind = kind;
  s.material = env.material;
  s.tag = env.tag;
  return s;
}

uint32_t ShapeSink::addShape(Shape s, uint32_t ordinal, const Span& span, const Env& env, const ShapeList& children) {
  if (draft_.chunk().shapes.size() >= limits_.shapes) {
    budget_.fail("one cell has more than " + std::to_string(limits_.shapes) +
                     " shapes (derive fewer, or make the cells smaller)",
                 span, env.activation);
  } else {
    budget_.withinBytes(span, env.activation);
  }
  Origin origin;
  origin.key = env.key.child(kCombinerSalt + static_cast<uint64_t>(s.kind), ordinal);
  origin.activation = env.activation;
  origin.span = span;
  if (!children.empty() && s.inner_radius == 0) {
    const bool first_only = s.kind == ShapeKind::subtract || s.kind == ShapeKind::subtract_smooth;
    for (uint32_t child : children) {
      s.inner_radius = std::max(s.inner_radius, draft_.shape(child).inner_radius);
      if (first_only) break;
    }
  }
  return draft_.addShape(s, origin, children);
}

uint32_t ShapeSink::unite(const ShapeList& list, const StmtNode& s, const Env& env) {
  if (list.size() == 1) return list[0];
  return addShape(shapeIn(env, ShapeKind::unite), s.ordinal, s.span, env, list);
}

void ShapeSink::limitLevels(ShapeList& list, size_t from, int32_t coarsest, int32_t detail) {
  for (size_t i = from; i < list.size(); ++i) {
    Shape& s = draft_.shape(list[i]);
    s.coarsest = std::max(s.coarsest, coarsest);
    if (detail > 0) s.detail = s.detail > 0 ? std::min(s.detail, detail) : detail;
  }
}

void ShapeSink::addAnchor(const Anchor& anchor) {
  anchors_.push_back(anchor);
  budget_.hold(sizeof(Anchor));
}

}  // namespace sgm::interpret
