// Members after a dot that are not calls: parts of vectors, cells, faces and segments.

#include <algorithm>
#include <array>

#include "grammar/check/check.h"
#include "grammar/text/codes.h"

namespace sgm {

namespace {

/// A member of a kind of value. Parts of a vector have its dimension.
struct MemberInfo {
  ValueKind of;
  std::string_view name;
  Member id;
  Type type;
};

constexpr Type kRatioType{ValueKind::number, kRatio, false, false};
constexpr Type kPointType{ValueKind::vector, kLength, false, false};
constexpr std::array kMembers = {
    MemberInfo{ValueKind::vector, "x", Member::x, kRatioType},
    MemberInfo{ValueKind::vector, "y", Member::y, kRatioType},
    MemberInfo{ValueKind::vector, "z", Member::z, kRatioType},
    MemberInfo{ValueKind::cell, "x", Member::x, kRatioType},
    MemberInfo{ValueKind::cell, "y", Member::y, kRatioType},
    MemberInfo{ValueKind::cell, "z", Member::z, kRatioType},
    MemberInfo{ValueKind::cell, "size", Member::size, kPointType},
    MemberInfo{ValueKind::cell, "center", Member::center, kPointType},
    MemberInfo{ValueKind::cell, "faces", Member::faces, {ValueKind::faces, kRatio, false, false}},
    MemberInfo{ValueKind::face, "other", Member::other, {ValueKind::cell, kRatio, false, false}},
    MemberInfo{ValueKind::face, "axis", Member::axis, kRatioType},
    MemberInfo{ValueKind::face, "center", Member::center, kPointType},
    MemberInfo{ValueKind::segment, "from", Member::from, kPointType},
    MemberInfo{ValueKind::segment, "to", Member::to, kPointType},
    MemberInfo{ValueKind::segment, "along", Member::along, kRatioType},
    MemberInfo{ValueKind::segment, "depth", Member::depth, kRatioType},
};

/// Suggests the intended member, or lists all.
std::string memberHint(std::string_view word, ValueKind of) {
  if (of == ValueKind::faces || of == ValueKind::segments) return "go through the list: for s in ...";
  Suggestion suggestion(word);
  std::string all;
  for (const MemberInfo& m : kMembers) {
    if (m.of != of) continue;
    suggestion.offer(m.name);
    all += join({all.empty() ? "it has " : ", ", m.name});
  }
  if (of == ValueKind::cell) suggestion.offer("links");
  if (of == ValueKind::cell || of == ValueKind::face) suggestion.offer("point");
  return suggestion.hintOr(all.empty() ? "only vectors, cells, faces and segments have parts" : all);
}

}  // namespace

Type Checker::member(ExprId id) {
  ExprNode& n = node(id);
  const ExprId of = child(n, 0);
  const std::string_view word = text(n.name);
  if (node(of).kind == ExprKind::name) {
    // module.name of a let or field without arguments
    const NameId receiver = node(of).name;
    const auto found = symbols_[scope_.module].find(receiver);
    const bool hidden = std::any_of(scope_.locals.begin(), scope_.locals.end(),
                                    [&](const Local& local) { return local.name == receiver; });
    if (!hidden && found != symbols_[scope_.module].end() && (found->second.import || found->second.asset)) {
      n.kind = ExprKind::name;
      resolveCallee(id, false);
      return n.ref == Ref::none ? kUnknownType : name(id);
    }
  }
  const Type type = expression(of);
  n.member = Member::none;
  Type out = kUnknownType;
  for (const MemberInfo& m : kMembers) {
    if (m.name != word || (m.of != type.kind && type.kind != ValueKind::unknown)) continue;
    n.member = m.id;
    if (m.of == type.kind) out = m.type;
  }
  if (type.kind == ValueKind::vector) out.dim = type.dim;
  if (n.member == Member::none) {
    const bool method = (type.kind == ValueKind::cell && word == "links") ||
                        ((type.kind == ValueKind::cell || type.kind == ValueKind::face) && word == "point");
    sink_.error(n.span, codes::kUnknownMember, join({withArticle(typeName(type)), " has no `", word, "`"}),
                method ? join({"write `", word, "()` with its arguments"}) : memberHint(word, type.kind));
  }
  out.sample = type.sample;
  return out;
}

}  // namespace sgm
