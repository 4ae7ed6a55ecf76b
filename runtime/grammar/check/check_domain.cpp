#include <algorithm>
#include <cmath>

#include "base/hash.h"
#include "grammar/check/check.h"
#include "grammar/text/codes.h"

namespace sgm {

namespace {

constexpr size_t kMostLayers = 256;
constexpr int64_t kWidestEdge = int64_t{16} * 1000 * kUnitsPerMetre;

}  // namespace

/// Folds numbers, arithmetic and lets without parameters; each let once, however often it is used.
std::optional<double> Checker::fold(ExprId id, int depth) {
  if (id == kNoId || depth > 400) return std::nullopt;
  const ExprNode& n = node(id);
  auto operand = [&](uint32_t i) { return fold(child(n, i), depth + 1); };
  switch (n.kind) {
    case ExprKind::number:
      return n.value;
    case ExprKind::negate:
      if (const auto a = operand(0)) return -*a;
      return std::nullopt;
    case ExprKind::name: {
      if (n.ref != Ref::let || program_.lets[n.id].function) return std::nullopt;
      if (const auto known = folded_.find(n.id); known != folded_.end()) return known->second;
      const auto value = fold(program_.lets[n.id].body, depth + 20);
      if (value) folded_.emplace(n.id, *value);
      return value;
    }
    case ExprKind::binary: {
      const auto a = operand(0), b = a ? operand(1) : std::nullopt;
      if (!a || !b) return std::nullopt;
      switch (n.binary) {
        case BinaryOp::add:
          return *a + *b;
        case BinaryOp::subtract:
          return *a - *b;
        case BinaryOp::multiply:
          return *a * *b;
        case BinaryOp::divide:
          return *b == 0 ? std::nullopt : std::optional(*a / *b);
        default:
          return std::nullopt;
      }
    }
    default:
      return std::nullopt;
  }
}

std::optional<double> Checker::constant(ExprId id, Dim dim, std::string_view what) {
  const uint32_t before = sink_.errorCount();
  scope_ = {};
  const Type type = demand(id, ValueKind::number, dim, what);
  if (sink_.errorCount() > before || type.kind == ValueKind::unknown) return std::nullopt;
  const auto value = fold(id, 0);
  if (!value || !std::isfinite(*value)) {
    sink_.error(node(id).span, codes::kNotConstant, join({what, " must be a constant"}),
                "use numbers, arithmetic and lets without parameters");
    return std::nullopt;
  }
  return value;
}

std::optional<int64_t> Checker::wholeUnits(ExprId id, std::string_view what) {
  const auto metres = constant(id, kLength, what);
  if (!metres) return std::nullopt;
  const double units = *metres * kUnitsPerMetre, whole = std::floor(units + 0.5);
  if (std::fabs(units - whole) > 1e-6) {
    sink_.error(node(id).span, codes::kWholeUnits, join({what, " is a whole number of units of 1/1024 m"}),
                join({"the nearest is ", numberText(whole / kUnitsPerMetre), "m"}));
    return std::nullopt;
  }
  return static_cast<int64_t>(whole);
}

std::optional<Checker::Ends> Checker::rangeOf(ExprId low_expr, ExprId high_expr, Dim dim) {
  const auto low = constant(low_expr, dim, "the low end of a range");
  const auto high = constant(high_expr, dim, "the high end of a range");
  if (!low || !high) return std::nullopt;
  if (*low <= *high) return Ends{*low, *high};
  sink_.error(node(low_expr).span, codes::kParamRange, "the range is reversed", "write its low end first");
  return std::nullopt;
}

bool Checker::defaultLies(const Ends& range, ExprId value_expr, double value, Dim dim, NameId name) {
  if (value >= range.low && value <= range.high) return true;
  const bool percent = dim == kRatio && range.high <= 1 && value / 100 >= range.low && value / 100 <= range.high;
  sink_.error(node(value_expr).span, codes::kParamRange,
              join({"the default of `", text(name), "` lies outside of its range"}),
              percent ? join({"write ", numberText(value), "%"}) : "widen the range, or choose a default within it");
  return false;
}

/// Evaluates the ranges of the formals of rules, lets and fields.
void Checker::formalRanges() {
  for (size_t i = 0; i < program_.ast.formals.size(); ++i) {
    FormalNode& formal = program_.ast.formals[i];
    if (formal.low_expr == kNoId || formal.high_expr == kNoId) continue;
    scope_ = {};
    const Type low = expression(formal.low_expr), high = expression(formal.high_expr);
    formal.dim = low.any_dim ? high.dim : low.dim;
    const auto range = rangeOf(formal.low_expr, formal.high_expr, formal.dim);
    if (!range) continue;
    if (formal.fallback != kNoId) {
      const auto value = constant(formal.fallback, formal.dim, "the default of a parameter");
      if (!value || !defaultLies(*range, formal.fallback, *value, formal.dim, formal.name)) continue;
    }
    formal.ranged = true;
    formal.low = range->low;
    formal.high = range->high;
  }
}

void Checker::params() {
  for (Param& param : program_.params) {
    if (param.module != 0) continue;
    scope_ = {};
    const Type type = expression(param.value_expr);
    if (type.kind == ValueKind::unknown) continue;
    if (type.kind != ValueKind::number) {
      sink_.error(node(param.value_expr).span, codes::kTypeMismatch,
                  join({"a parameter is a number, and this is a ", typeName(type)}), "such as param a = 2m;");
      continue;
    }
    param.dim = type.dim;
    if (type.any_dim && param.has_range) {
      const Type low = expression(param.low_expr), high = expression(param.high_expr);
      param.dim = low.any_dim ? high.dim : low.dim;
    }
    const auto value = constant(param.value_expr, param.dim, "the default of a parameter");
    if (!value) continue;
    param.value = param.low = param.high = *value;
    if (param.animated && !param.has_range) {
      sink_.error(param.span, codes::kParamRange, join({"`", text(param.name), "` is animated and has no range"}),
                  join({"write its range: `param ", text(param.name), " = ... in LOW..HIGH animated`"}));
      continue;
    }
    if (param.has_range) {
      const auto range = rangeOf(param.low_expr, param.high_expr, param.dim);
      if (!range || !defaultLies(*range, param.value_expr, *value, param.dim, param.name)) continue;
      param.low = range->low;
      param.high = range->high;
    }
    auto written_whole = [&](ExprId id) {
      return id == kNoId || (node(id).kind == ExprKind::number && node(id).value == std::floor(node(id).value) &&
                             text(node(id).name).find_first_not_of("0123456789") == std::string_view::npos);
    };
    param.whole = param.dim == kRatio && written_whole(param.value_expr) && written_whole(param.low_expr) &&
                  written_whole(param.high_expr) && !(param.has_range && param.low == 0 && param.high == 1);
  }
}

void Checker::seedAndDomain() {
  ModuleSyntax& root = syntax_[0];
  if (root.seed != kNoId) {
    const ExprNode& seed = node(root.seed);
    if (seed.kind == ExprKind::text) {
      program_.seed = hashText(text(seed.name));
    } else if (const auto value = constant(root.seed, kRatio, "a seed")) {
      if (*value < 0 || *value != std::floor(*value) || *value > 1e9)
        sink_.error(seed.span, codes::kValueRange, "a seed is a whole number (0 or more) or a text",
                    "such as seed 7 or seed \"block-17\"");
      else
        program_.seed = static_cast<uint64_t>(*value);
    }
  }
  program_.unit = root.unit;
  const DomainDecl& decl = root.domain;
  Domain& domain = program_.domain;
  domain.written = decl.present;
  domain.infinite = decl.infinite;
  domain.axes = decl.axes;
  domain.solid = decl.solid;
  domain.density = decl.density;
  if (decl.density_edge != kNoId) {
    const auto edge = wholeUnits(decl.density_edge, "the edge of a density");
    if (edge && (*edge < 1 || *edge > kWidestEdge))
      sink_.error(node(decl.density_edge).span, codes::kValueRange,
                  "the edge of a density is from one unit to 16 km wide", "such as edge 20m");
    else if (edge)
      domain.density_edge = static_cast<int32_t>(*edge);
  }
  domain.span = decl.span;
  if (decl.material != kNoId) domain.material = tableIndex(program_.materials, decl.material, decl.span);
  if (!decl.box) return;
  ExprId edges[3] = {kNoId, kNoId, kNoId};
  const size_t required = decl.box_args.count == 1 ? 1 : 3;
  if (!bindWords(decl.box_args, decl.span, "box", {"x", "y", "z"}, required, edges)) return;
  for (int axis = 0; axis < 3; ++axis) {
    const ExprId edge = edges[required == 1 ? 0 : axis];
    const auto units = wholeUnits(edge, "an edge of the domain");
    if (!units) return;
    if (*units < 2 || *units > (int64_t{1} << 31) - 4096) {
      sink_.error(node(edge).span, codes::kValueRange, "an edge of the domain is from 2 units to 2097 km long",
                  "such as box(200m)");
      return;
    }
    domain.box.lo[axis] = static_cast<int32_t>(-*units / 2);
    domain.box.hi[axis] = static_cast<int32_t>(domain.box.lo[axis] + *units);
  }
}

void Checker::layers() {
  const uint32_t before = sink_.errorCount();
  layers_known_ = false;
  ModuleSyntax& root = syntax_[0];
  const DomainDecl& decl = root.domain;
  Domain& domain = program_.domain;
  std::pmr::memory_resource* memory = program_.layers.get_allocator().resource();
  if (root.start == kNoId && root.layers.empty()) {
    Span span;
    span.line = span.column = span.end_line = span.end_column = 1;
    const bool derives = std::any_of(root.items.begin(), root.items.end(), [](const Item& item) {
      return item.kind == ItemKind::alternative || item.kind == ItemKind::domain;
    });
    if (derives && !library_ && !lossy_)
      sink_.error(span, codes::kNoStart, "nothing says where derivation starts", "add `start Rule;` or a layer");
    return;
  }
  if (root.start != kNoId && !root.layers.empty())
    sink_.error(root.start_span, codes::kNoStart, "a grammar starts at the top or in its layers, not both",
                "remove this start, or the layers");
  if (root.start != kNoId && decl.infinite)
    sink_.error(root.start_span, codes::kDomain, "an infinite domain is derived by layers",
                "add `layer name cell 100m reach 50m { start Rule; }`");
  if (!root.layers.empty() && !decl.infinite && !decl.box && !lossy_)
    sink_.error(root.layers[0].span, codes::kDomain, "layers need an infinite domain or one with a box",
                "write `domain infinite;` or `domain finite box(...)`");
  if (root.layers.size() > kMostLayers)
    sink_.error(root.layers[kMostLayers].span, codes::kTooLarge,
                join({"the program has more than ", std::to_string(kMostLayers), " layers"}),
                "put rules of several layers into one");
  if (sink_.errorCount() > before) return;
  if (root.start != kNoId) {
    Layer main(memory);
    main.name = names_.intern("main");
    main.start = root.start;
    main.span = root.start_span;
    if (!domain.box.empty())
      for (int axis = 0; axis < 3; ++axis) main.cell[axis] = domain.box.hi[axis] - domain.box.lo[axis];
    program_.layers.push_back(std::move(main));
    layers_known_ = true;
    return;
  }
  constexpr int64_t kLargest = int64_t{1} << 30;
  for (const LayerDecl& l : root.layers) {
    Layer layer(memory);
    layer.name = l.name;
    layer.start = l.start;
    layer.span = l.span;
    layer.cell_expr = l.cell;
    layer.reach_expr = l.reach;
    const auto cell = wholeUnits(l.cell, "the cell of a layer"), reach = wholeUnits(l.reach, "the reach of a layer");
    if (cell && (*cell < 1 || *cell > kLargest))
      sink_.error(node(l.cell).span, codes::kValueRange, "a cell is from one unit to 1048 km long", "such as cell 32m");
    else if (reach && (*reach < 0 || *reach > kLargest))
      sink_.error(node(l.reach).span, codes::kValueRange, "a reach is from 0 to 1048 km long", "such as reach 8m");
    else if (cell && reach) {
      // Every chunk loads all cells within reach: the cost of a sample grows with the cube of this.
      if (*reach > *cell * limits_.neighbours)
        sink_.error(node(l.reach).span, codes::kReachTooLarge,
                    join({"the reach is more than ", std::to_string(limits_.neighbours), " cells"}),
                    join({"make the cell at least ",
                          metresText(static_cast<double>(*reach) / kUnitsPerMetre / limits_.neighbours), " long"}));
      layer.reach = static_cast<int32_t>(*reach);
      for (int axis = 0; axis < 3; ++axis)
        layer.cell[axis] = domain.axes[static_cast<size_t>(axis)] ? static_cast<int32_t>(*cell) : 0;
    }
    if (l.detail != kNoId) {
      // A threshold need not be a whole number of units, here as in statements.
      std::optional<double> detail = constant(l.detail, kLength, "the detail of a layer");
      if (detail) detail = std::floor(*detail * kUnitsPerMetre + 0.5);
      if (detail && (*detail < 1 || *detail > kLargest))
        sink_.error(node(l.detail).span, codes::kValueRange, "a detail is from one unit to 1048 km long",
                    "such as detail 4m");
      else if (detail)
        layer.coarsest_cell = static_cast<int32_t>(*detail);
    }
    for (const Layer& other : program_.layers)
      if (other.name == layer.name)
        sink_.error(l.span, codes::kDuplicate, join({"layer `", text(layer.name), "` is declared twice"}),
                    "give it another name");
    program_.layers.push_back(std::move(layer));
  }
  sortLayers();
}

void Checker::sortLayers() {
  const uint32_t before = sink_.errorCount();
  const std::vector<LayerDecl>& decls = syntax_[0].layers;
  const size_t count = decls.size();
  std::vector<std::vector<uint32_t>> uses(count);
  for (size_t l = 0; l < count; ++l)
    for (const NamedPlace& use : decls[l].uses) {
      Suggestion suggestion(text(use.name));
      uint32_t found = kNoId;
      for (uint32_t other = 0; other < count; ++other) {
        suggestion.offer(text(decls[other].name));
        if (decls[other].name == use.name) found = other;
      }
      if (found == kNoId && mayBeLost(0, use.name))
        continue;
      else if (found == kNoId)
        sink_.error(use.span, codes::kUnknownName, join({"unknown layer `", text(use.name), "`"}),
                    suggestion.hintOr("name a layer of this file"));
      else if (found == l)
        sink_.error(use.span, codes::kLayerCycle, join({"layer `", text(use.name), "` uses itself"}),
                    "a layer reads lower layers only");
      else if (std::find(uses[l].begin(), uses[l].end(), found) == uses[l].end())
        uses[l].push_back(found);
    }
  if (sink_.errorCount() > before) return;
  // Repeatedly take the first layer whose lower layers are all placed: so declaration order is kept if possible.
  std::vector<uint32_t> order, place(count, kNoId);
  while (order.size() < count) {
    uint32_t next = kNoId;
    for (uint32_t l = 0; l < count && next == kNoId; ++l)
      if (place[l] == kNoId &&
          std::all_of(uses[l].begin(), uses[l].end(), [&](uint32_t u) { return place[u] != kNoId; }))
        next = l;
    if (next == kNoId) {
      for (uint32_t l = 0; l < count && next == kNoId; ++l)
        if (place[l] == kNoId) next = l;
      for (const NamedPlace& use : decls[next].uses)
        for (uint32_t u : uses[next])
          if (decls[u].name == use.name && place[u] == kNoId) {
            sink_.error(
                use.span, codes::kLayerCycle,
                join({"layers `", text(decls[next].name), "` and `", text(use.name), "` use each other in a circle"}),
                "a layer reads lower layers only");
            return;
          }
      return;
    }
    place[next] = static_cast<uint32_t>(order.size());
    order.push_back(next);
  }
  std::pmr::vector<Layer> sorted(program_.layers.get_allocator());
  for (uint32_t l : order) {
    for (uint32_t u : uses[l]) program_.layers[l].uses.push_back(place[u]);
    std::sort(program_.layers[l].uses.begin(), program_.layers[l].uses.end());
    sorted.push_back(std::move(program_.layers[l]));
  }
  program_.layers = std::move(sorted);
  layers_known_ = true;
}

/// Stores which rule may derive which, for searches of the uses of a rule.
void Checker::keepCalls() {
  for (const RuleCall& call : calls_) program_.rules[call.from].calls.push_back(call.to);
  for (Rule& rule : program_.rules) {
    std::sort(rule.calls.begin(), rule.calls.end());
    rule.calls.erase(std::unique(rule.calls.begin(), rule.calls.end()), rule.calls.end());
  }
}

void Checker::expectations() {
  for (Expectation& e : program_.expectations) {
    const Dim dim = e.measure == Measure::volume ? kVolume : e.measure == Measure::area ? kArea : kRatio;
    const bool counts = e.measure != Measure::watertight;
    if (!counts && (e.compared || e.low != kNoId))
      sink_.error(e.span, codes::kWrongUse, "`watertight` holds or not; it is not compared",
                  "write `watertight;` alone");
    if (counts && e.expect && !e.compared && e.low == kNoId)
      sink_.error(e.span, codes::kSyntax, "an `expect` of a number needs something to compare with",
                  "such as == 1 or in 1..10");
    if (e.of != kNoId && e.measure != Measure::components)
      sink_.error(e.span, codes::kWrongUse, "only `components` takes `air` or `solid`", "leave the parentheses out");
    if (const auto above = e.above == kNoId ? std::nullopt : constant(e.above, kVolume, "the size of a piece")) {
      e.above_number = *above;
      if (*above < 0)
        sink_.error(node(e.above).span, codes::kValueRange, "the size of a piece is 0m3 or more",
                    "such as components(solid above 2m3)");
    }
    if (const auto value = e.value == kNoId ? std::nullopt : constant(e.value, dim, "the value to compare with"))
      e.value_number = *value;
    if (const auto low = e.low == kNoId ? std::nullopt : constant(e.low, dim, "the low end of a range"))
      e.low_number = *low;
    if (const auto high = e.high == kNoId ? std::nullopt : constant(e.high, dim, "the high end of a range"))
      e.high_number = *high;
    if (e.per_name == kNoId) continue;
    const auto found = symbols_[0].find(e.per_name);
    if (found == symbols_[0].end() && mayBeLost(0, e.per_name)) continue;
    if (found == symbols_[0].end() || found->second.ref != Ref::rule) {
      Suggestion suggestion(text(e.per_name));
      for (const Rule& rule : program_.rules) suggestion.offer(text(rule.name));
      sink_.error(e.span, codes::kUnknownName, join({"unknown rule `", text(e.per_name), "`"}),
                  suggestion.hintOr("name a rule of this file"));
    } else {
      e.per = found->second.id;
    }
  }
}

}  // namespace sgm
