// Checks members after a dot that are not calls (parts of vectors, cells, faces and segments), and queries of layers.

#include <array>

#include "grammar/check/types.h"
#include "grammar/text/codes.h"

namespace sgm {

namespace {

/// A member of values of the kind `of`, such as x of a vector. The members of a vector have the vector's dimension.
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

/// Returns the hint for an unknown member `word` of a value of the kind `of`: the member with the most similar name, or
/// a list of all members if no name is similar.
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

uint32_t Types::askLayer(NameId name, const Span& span, std::string_view verb) {
  const uint32_t layer = symbols_.findLayer(name, span);
  if (layer != kNoId) scope_.asked->push_back({kNoId, layer, span, verb});
  return layer;
}

Type Types::checkQuery(ExprId id) {
  const ExprNode n = check_.node(id);
  const Type answer{ValueKind::boolean, kRatio, false, false};
  if (n.children.count > 0) {
    const ExprId radius = check_.child(n, 0);
    require(radius, ValueKind::number, kLength, "the radius of a query");
    if (const auto metres = fold(radius); metres && *metres < 0)
      check_.sink.error(check_.node(radius).span, codes::kValueRange, "the radius of a query is 0m or more",
                        "such as `query clear 2m of`");
  }
  if (scope_.field) {
    check_.sink.error(n.span, codes::kStage,
                      "a query is answered once, when shapes are derived, and a field is evaluated at every point",
                      "ask in the rule, `let open = query ...;`, and pass that to the field as an argument");
    return answer;
  }
  if (!scope_.inRule()) {
    check_.sink.error(n.span, codes::kWrongUse, "a query is known inside rules only: it asks about the scope's place",
                      "ask in a rule, and pass the answer to a let as an argument");
    return answer;
  }
  const uint32_t layer = askLayer(n.name, n.span, "queries");
  check_.node(id).ref = Ref::layer;
  check_.node(id).id = layer;
  return answer;
}

Type Types::checkMember(ExprId id) {
  ExprNode& n = check_.node(id);
  const ExprId of = check_.child(n, 0);
  const std::string_view word = check_.text(n.name);
  if (check_.node(of).kind == ExprKind::name) {
    // The member may be of the form module.name, which refers to a let or a field without arguments.
    const NameId receiver = check_.node(of).name;
    const Symbol* const found = symbols_.find(scope_.module, receiver);
    if (!scope_.hides(receiver) && found != nullptr && (found->import || found->asset)) {
      n.kind = ExprKind::name;
      symbols_.resolveCallee(id, scope_, false);
      return n.ref == Ref::none ? kUnknownType : checkName(id);
    }
  }
  const Type type = checkExpression(of);
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
    check_.sink.error(n.span, codes::kUnknownMember, join({withArticle(typeName(type)), " has no `", word, "`"}),
                      method ? join({"write `", word, "()` with its arguments"}) : memberHint(word, type.kind));
  }
  out.sample = type.sample;
  return out;
}

}  // namespace sgm
