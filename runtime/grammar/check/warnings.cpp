#include "grammar/check/warnings.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "base/math.h"
#include "grammar/text/codes.h"

namespace sgm {
namespace {

/// Collects the declarations that the text of the root file uses.
struct Uses {
  std::set<std::pair<Ref, uint32_t>> values;
  std::set<NameId> qualifiers;
  struct Local {
    NameId name;
    Span span;
  };
  std::vector<Local> locals;

  explicit Uses(const Program& program) {
    for (const ExprNode& n : program.ast.exprs) {
      if (n.ref == Ref::parameter || n.ref == Ref::let || n.ref == Ref::field) values.emplace(n.ref, n.id);
      if (n.ref == Ref::local) locals.push_back({n.name, n.span});
      if (n.qualifier != kNoId && n.span.file == 0) qualifiers.insert(n.qualifier);
    }
    for (const StmtNode& s : program.ast.stmts)
      if (s.kind == StmtKind::fit && s.span.file == 0) qualifiers.insert(s.name);
  }
};

bool within(const Span& inner, const Span& outer) {
  return inner.file == outer.file && inner.begin >= outer.begin && inner.end <= outer.end;
}

class Unused {
 public:
  Unused(const Program& program, DiagnosticSink& sink) : program_(program), sink_(sink), uses_(program) {}

  void values() {
    for (uint32_t i = 0; i < program_.params.size(); ++i) {
      const Param& param = program_.params[i];
      if (param.module == 0 && uses_.values.count({Ref::parameter, i}) == 0)
        say(param.span, "parameter", param.name, "it changes nothing: use it, or remove it");
    }
    for (uint32_t i = 0; i < program_.lets.size(); ++i)
      if (program_.lets[i].module == 0 && uses_.values.count({Ref::let, i}) == 0)
        say(program_.lets[i].span, "let", program_.lets[i].name, kRemove);
    for (uint32_t i = 0; i < program_.fields.size(); ++i)
      if (program_.fields[i].module == 0 && uses_.values.count({Ref::field, i}) == 0)
        say(program_.fields[i].span, "field", program_.fields[i].name, kRemove);
  }

  void imports(const ModuleSyntax& root) {
    for (const ImportDecl& import : root.imports) {
      if (uses_.qualifiers.count(import.alias) != 0 || inPaths(import.module)) continue;
      say(import.alias_span, "import", import.alias, kRemove);
    }
  }

  void locals() {
    for (const Rule& rule : program_.rules)
      if (rule.module == 0)
        for (const Alternative& a : rule.alternatives) localsOf(a.body, program_.stmt(a.body).span);
    for (const Override& edit : program_.overrides) localsOf(edit.body, program_.stmt(edit.body).span);
  }

 private:
  static constexpr const char* kRemove = "use it, or remove it";

  void say(const Span& span, std::string_view what, NameId name, const char* hint) {
    sink_.warning(span, codes::kUnusedValue, join({"nothing uses the ", what, " `", program_.text(name), "`"}), hint);
  }

  /// Whether the path of some override contains a rule of this imported module.
  bool inPaths(uint32_t module) const {
    return std::any_of(program_.path_steps.begin(), program_.path_steps.end(),
                       [&](const PathStep& step) { return program_.rules[step.rule].module == module; });
  }

  void localsOf(StmtId id, const Span& body) {
    if (id == kNoId) return;
    const StmtNode& s = program_.stmt(id);
    if (s.kind == StmtKind::let) {
      const bool used = std::any_of(uses_.locals.begin(), uses_.locals.end(), [&](const Uses::Local& use) {
        return use.name == s.name && within(use.span, body) && use.span.begin >= s.span.end;
      });
      if (!used) say(s.span, "let", s.name, kRemove);
    }
    localsOf(s.body, body);
    for (uint32_t i = 0; i < s.children.count; ++i) localsOf(program_.idAt(s.children, i), body);
  }

  const Program& program_;
  DiagnosticSink& sink_;
  const Uses uses_;
};

/// The range of values of one expression, `asked`, for which a guard holds. The ends may be open or closed. asked:
/// kNoId if the guard is too complicated to be analysed.
struct GuardRange {
  ExprId asked = kNoId;
  double low = -kInfinity, high = kInfinity;
  bool low_open = false, high_open = false;
};

/// Returns the value of a number literal, possibly negated; nullopt for other expressions.
std::optional<double> literalValue(const Program& program, ExprId id) {
  const ExprNode& n = program.expr(id);
  if (n.kind == ExprKind::number) return n.value;
  if (n.kind != ExprKind::negate) return std::nullopt;
  const std::optional<double> positive = literalValue(program, program.idAt(n.children, 0));
  return positive ? std::optional(-*positive) : std::nullopt;
}

std::optional<GuardRange> rangeOf(const Program& program, ExprId guard) {
  const ExprNode& n = program.expr(guard);
  if (n.kind != ExprKind::binary) return std::nullopt;
  const ExprId left = program.idAt(n.children, 0), right = program.idAt(n.children, 1);
  const std::optional<double> on_left = literalValue(program, left), on_right = literalValue(program, right);
  if (on_left.has_value() == on_right.has_value()) return std::nullopt;
  GuardRange range;
  range.asked = on_left ? right : left;
  const double number = on_left ? *on_left : *on_right;
  const auto above = [&](bool open) { range.low = number, range.low_open = open; };
  const auto below = [&](bool open) { range.high = number, range.high_open = open; };
  switch (n.binary) {
    case BinaryOp::less:
      on_left ? above(true) : below(true);
      return range;
    case BinaryOp::less_equal:
      on_left ? above(false) : below(false);
      return range;
    case BinaryOp::greater:
      on_left ? below(true) : above(true);
      return range;
    case BinaryOp::greater_equal:
      on_left ? below(false) : above(false);
      return range;
    case BinaryOp::equal:
      range.low = range.high = number;
      return range;
    default:
      return std::nullopt;
  }
}

/// Whether two expressions are the same name, or the same member of the same value. Parameters of a rule are compared
/// by position: heads may use different names for one parameter.
bool sameValue(const Program& program, ExprId a, ExprId b) {
  const ExprNode &l = program.expr(a), &r = program.expr(b);
  if (l.kind != r.kind || l.ref != r.ref || l.member != r.member) return false;
  if (l.kind == ExprKind::member)
    return l.name == r.name && sameValue(program, program.idAt(l.children, 0), program.idAt(r.children, 0));
  return l.kind == ExprKind::name && l.id == r.id;
}

/// Finds values that are always whole numbers, for all parameters and calls.
class WholeNumbers {
 public:
  explicit WholeNumbers(const Program& program) : program_(program) {
    for (uint32_t r = 0; r < program.rules.size(); ++r)
      for (const Alternative& a : program.rules[r].alternatives)
        frames_.push_back({r, a.span, a.body, a.formals.count});
    for (const Override& edit : program.overrides) {
      const uint32_t steps = edit.steps.count;
      const uint32_t rule = steps == 0 ? kNoId : program.path_steps[edit.steps.first + steps - 1].rule;
      const uint32_t formals = rule == kNoId ? 0 : program.rules[rule].alternatives[0].formals.count;
      frames_.push_back({rule, edit.span, edit.body, formals});
    }
    for (uint32_t e = 0; e < program.ast.exprs.size(); ++e)
      if (program.expr(e).ref == Ref::rule) calls_[program.expr(e).id].push_back(e);
  }

  bool holds(ExprId id) {
    formals_.clear();
    return isWhole(id);
  }

 private:
  /// A head of a rule, or an override, with its body: the scope in which the slots of local names are numbered.
  struct Frame {
    uint32_t rule;
    Span head;
    StmtId body;
    uint32_t formals;
  };

  bool isWhole(ExprId id) {
    if (id == kNoId) return false;
    const ExprNode& n = program_.expr(id);
    switch (n.kind) {
      case ExprKind::number:
        return n.value == std::floor(n.value);
      case ExprKind::negate:
        return isWhole(program_.idAt(n.children, 0));
      case ExprKind::binary:
        return (n.binary == BinaryOp::add || n.binary == BinaryOp::subtract || n.binary == BinaryOp::multiply) &&
               isWhole(program_.idAt(n.children, 0)) && isWhole(program_.idAt(n.children, 1));
      case ExprKind::name:
        return n.ref == Ref::parameter ? program_.params[n.id].whole : n.ref == Ref::local && isWholeLocal(n);
      default:
        return false;
    }
  }

  bool isWholeLocal(const ExprNode& n) {
    for (const Frame& frame : frames_) {
      if (!within(n.span, frame.head) && !within(n.span, program_.stmt(frame.body).span)) continue;
      return n.id < frame.formals ? isWholeFormal(frame.rule, n.id) : isWholeIn(frame.body, n.id);
    }
    return false;
  }

  /// Whether all calls pass whole numbers for a formal. A formal that is being evaluated, because of recursion, is
  /// assumed to be whole.
  bool isWholeFormal(uint32_t rule, uint32_t formal) {
    if (!formals_.emplace(rule, formal).second) return true;
    const std::vector<ExprId>& calls = calls_[rule];
    return !calls.empty() && std::all_of(calls.begin(), calls.end(), [&](ExprId call) {
      const IdRange bound = program_.expr(call).bound;
      return formal < bound.count && isWhole(program_.idAt(bound, formal));
    });
  }

  /// Whether the loop variable or let in this slot is always a whole number.
  bool isWholeIn(StmtId id, uint32_t slot) {
    if (id == kNoId) return false;
    const StmtNode& s = program_.stmt(id);
    if (s.kind == StmtKind::for_each && s.slot == slot) return program_.expr(s.expr).kind == ExprKind::range;
    if (s.kind == StmtKind::let && s.slot == slot) return isWhole(s.expr);
    if (isWholeIn(s.body, slot)) return true;
    for (uint32_t i = 0; i < s.children.count; ++i)
      if (isWholeIn(program_.idAt(s.children, i), slot)) return true;
    return false;
  }

  const Program& program_;
  std::vector<Frame> frames_;
  std::map<uint32_t, std::vector<ExprId>> calls_;  ///< all calls of each rule, by rule index
  /// the formals that are being evaluated, as pairs of rule and index
  std::set<std::pair<uint32_t, uint32_t>> formals_;
};

/// Shrinks a range to closed ends that are whole numbers.
GuardRange wholeOf(GuardRange range) {
  range.low = range.low_open ? std::floor(range.low) + 1 : std::ceil(range.low);
  range.high = range.high_open ? std::ceil(range.high) - 1 : std::floor(range.high);
  range.low_open = range.high_open = false;
  return range;
}

bool overlap(const GuardRange& a, const GuardRange& b) {
  const double low = std::max(a.low, b.low), high = std::min(a.high, b.high);
  if (low != high) return low < high;
  const auto holds = [&](const GuardRange& range) {
    return (low > range.low || !range.low_open) && (low < range.high || !range.high_open);
  };
  return holds(a) && holds(b);
}

}  // namespace

void warnOfUnused(const Program& program, std::span<const ModuleSyntax> syntax, DiagnosticSink& sink) {
  if (program.layers.empty()) return;
  Unused unused(program, sink);
  unused.values();
  unused.imports(syntax[0]);
  unused.locals();
}

namespace {

bool isLetter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

/// Whether two names differ by one additional letter, or by two swapped neighbours, such as `bric` and `brick`. A
/// different letter does not count, since it may make another word, such as glass and grass.
bool misspelt(std::string_view a, std::string_view b) {
  if (a.size() > b.size()) std::swap(a, b);
  if (a.size() < 4 || b.size() > a.size() + 1) return false;
  const auto [in_a, in_b] = std::mismatch(a.begin(), a.end(), b.begin(), b.end());
  if (b.size() > a.size()) return isLetter(*in_b) && std::equal(in_a, a.end(), in_b + 1, b.end());
  if (a.end() - in_a < 2 || !isLetter(*in_a) || !isLetter(*in_b)) return false;
  return in_a[0] == in_b[1] && in_a[1] == in_b[0] && std::equal(in_a + 2, a.end(), in_b + 2, b.end());
}

}  // namespace

void warnOfMaterials(const Program& program, DiagnosticSink& sink) {
  std::vector<size_t> uses(program.materials.size(), 0);
  std::map<uint32_t, Span> first;
  for (const StmtNode& s : program.ast.stmts) {
    if (s.kind != StmtKind::mat || s.extra >= uses.size()) continue;
    ++uses[s.extra];
    if (s.span.file == 0) first.emplace(s.extra, s.span);
  }
  // A name with a higher rank is assumed to be spelt correctly. The order: names in imports, assets and the domain;
  // then names that are used more often; then names that come earlier in the text.
  const auto rank = [&](uint32_t material) {
    const auto place = first.find(material);
    return place == first.end() ? std::pair(SIZE_MAX, int64_t{0})
                                : std::pair(uses[material], -int64_t{place->second.begin});
  };
  for (const auto& [material, span] : first) {
    if (material == 0) continue;  // the empty name, which stands for no material
    for (uint32_t other = 1; other < program.materials.size(); ++other) {
      const std::string_view name(program.materials[material]), theirs(program.materials[other]);
      if (!misspelt(name, theirs) || rank(material) > rank(other)) continue;
      sink.warning(span, codes::kNearName,
                   join({"the material `", name, "` is spelt almost like `", theirs, "`, which is used as well"}),
                   join({"did you mean `", theirs, "`?"}));
      break;
    }
  }
}

void warnOfOverlaps(const Program& program, DiagnosticSink& sink) {
  WholeNumbers whole(program);
  for (const Rule& rule : program.rules) {
    if (rule.module != 0) continue;
    std::vector<std::pair<const Alternative*, GuardRange>> before;
    for (const Alternative& head : rule.alternatives) {
      if (head.guard != Guard::when || head.weight != kNoId || head.lod != kNoId) continue;
      std::optional<GuardRange> range = rangeOf(program, head.when);
      if (!range) continue;
      if (whole.holds(range->asked)) range = wholeOf(*range);
      for (const auto& [other, theirs] : before) {
        if (!sameValue(program, range->asked, theirs.asked) || !overlap(*range, theirs)) continue;
        sink.warning(program.expr(head.when).span, codes::kGuards,
                     join({"this guard of `", program.text(rule.name), "` and an earlier one can both hold"}),
                     "one of their heads is drawn then: let one exclude the other, or give both a `weight` if that is "
                     "meant")
            .notes.push_back(join({"the earlier one is at ", sink.place(program.expr(other->when).span)}));
        break;
      }
      before.emplace_back(&head, *range);
    }
  }
}

}  // namespace sgm
