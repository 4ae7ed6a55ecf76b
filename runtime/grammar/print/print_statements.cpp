// Prints statements and the heads of rules.

#include "grammar/print/print_expressions.h"
#include "grammar/syntax/keywords.h"
#include "grammar/syntax/lexer.h"
#include "grammar/syntax/precedence.h"
#include "grammar/text/sink.h"

namespace sgm {

void LinePrinter::scatter(std::string& out, const ScatterNode& node) const {
  out += "scatter ";
  if (node.poisson) out += "poisson(";
  expr(out, node.count);
  if (node.poisson) out += ')';
  if (node.area != ScatterArea::cell) {
    const std::string_view word = node.area == ScatterArea::shell ? "shell"
                                  : node.area == ScatterArea::box ? "box"
                                                                  : "disc";
    out += join({" on ", word});
    args(out, node.args, word);
  }
  if (node.probe != 0) {
    out += node.probe > 0 ? " probe up " : " probe down ";
    expr(out, node.distance);
    out += join({" of ", program_.text(node.layer_name)});
  }
  if (node.gap != kNoId) {
    out += join({" gap ", program_.text(node.gap), " within "});
    expr(out, node.within);
  }
  if (node.when != kNoId) {
    out += " when ";
    expr(out, node.when);
  }
}

void LinePrinter::footprint(std::string& out, const FootprintNode& node) const {
  out += "footprint ";
  if (node.count != kNoId) {
    out += "merge ";
    expr(out, node.count);
    out += ' ';
  }
  const std::string_view word = node.outline == Outline::rect      ? "rect"
                                : node.outline == Outline::regular ? "regular"
                                                                   : "polygon";
  out += word;
  args(out, node.args, word);
}

void LinePrinter::roof(std::string& out, const StmtNode& node) const {
  const RoofNode& roof = program_.ast.roofs[node.extra];
  const std::string_view word = roof.form == RoofForm::flat ? "flat" : roof.form == RoofForm::gable ? "gable" : "hip";
  out += join({"roof ", word});
  args(out, roof.args, word);
  if (node.plan == kNoId) return;
  out += " of ";
  expr(out, node.plan);
}

void LinePrinter::fitZone(std::string& out, const FitZoneNode& zone) const {
  out += join({zone.repeats ? "repeat " : "stretch ", std::string_view("xyz").substr(zone.axis, 1), " "});
  expr(out, zone.from, kOr);
  out += "..";
  expr(out, zone.to, kOr);
}

void LinePrinter::fit(std::string& out, const StmtNode& node) const {
  const FitNode& fit = program_.ast.fits[node.extra];
  out += join({"fit ", program_.text(node.name)});
  for (uint32_t i = 0; i < fit.zones.count; ++i) {
    out += ' ';
    fitZone(out, program_.ast.fit_zones[fit.zones.first + i]);
  }
  out += ';';
}

void LinePrinter::sockets(std::string& out, const TileNode& tile, std::string_view before) const {
  for (uint32_t i = 0; i < tile.sockets.count; ++i) {
    const SocketNode& socket = program_.ast.sockets[tile.sockets.first + i];
    out += join({i == 0 ? before : ", ", boxPartTable()[static_cast<size_t>(socket.of)]});
    for (const auto& [labels, first] : {std::pair{socket.labels, " "}, std::pair{socket.meets, " meets "}})
      for (uint32_t l = 0; l < labels.count; ++l)
        out += join({l == 0 ? first : " or ", program_.text(program_.idAt(labels, l))});
  }
}

void LinePrinter::morphOperand(std::string& out, StmtId id) const {
  const StmtNode& node = program_.stmt(id);
  if (node.kind == StmtKind::block)
    statement(out, id);
  else
    expr(out, node.expr);
}

void LinePrinter::head(std::string& out, const StmtNode& node) const {
  auto smooth = [&](std::string_view word) {
    out += word;
    if (node.amount == kNoId) return;
    out += " smooth ";
    expr(out, node.amount);
  };
  auto amplitude = [&](std::string_view word) {
    out += word;
    expr(out, node.expr);
    if (node.amount == kNoId) return;
    out += " amp ";
    expr(out, node.amount);
  };
  switch (node.kind) {
    case StmtKind::block:
      break;
    case StmtKind::call:
      expr(out, node.expr);
      out += ';';
      break;
    case StmtKind::unite:
      smooth("union");
      break;
    case StmtKind::cut:
      smooth("cut");
      break;
    case StmtKind::meet:
      smooth("meet");
      break;
    case StmtKind::sum:
      out += "sum";
      break;
    case StmtKind::morph:
      out += "morph(";
      morphOperand(out, program_.idAt(node.children, 0));
      out += ", ";
      morphOperand(out, program_.idAt(node.children, 1));
      out += ", ";
      expr(out, node.expr);
      out += node.power ? ") power;" : ");";
      break;
    case StmtKind::displace:
      amplitude("displace ");
      break;
    case StmtKind::warp:
      amplitude("warp ");
      break;
    case StmtKind::transform:
      xforms(out, node.xforms);
      break;
    case StmtKind::repeat:
      out += "repeat ";
      expr(out, node.expr);
      if (node.xforms.count > 0) out += ' ';
      xforms(out, node.xforms);
      break;
    case StmtKind::for_each:
      out += join({"for ", program_.text(node.name), " in "});
      expr(out, node.expr);
      break;
    case StmtKind::scatter:
      scatter(out, program_.ast.scatters[node.extra]);
      break;
    case StmtKind::split:
      out += join({"split ", std::string_view("xyz").substr(node.extra, 1)});
      if (node.amount == kNoId) break;
      out += " snap ";
      expr(out, node.amount);
      break;
    case StmtKind::snap:
      out += join({"snap ", std::string_view("xyz").substr(node.extra, 1), " "});
      expr(out, node.expr);
      if (node.amount == kNoId) break;
      out += " from ";
      expr(out, node.amount);
      break;
    case StmtKind::comp:
      out += "comp";
      break;
    case StmtKind::treemap:
      out += "treemap";
      if (const IdRange given = program_.ast.treemaps[node.extra].args; given.count > 0) args(out, given, "treemap");
      break;
    case StmtKind::link:
      out += join({"link ", program_.text(node.name), " ", program_.text(node.name2), " by door"});
      if (const IdRange given = program_.ast.links[node.extra].args; given.count > 0) args(out, given, "door");
      out += ';';
      break;
    case StmtKind::wfc:
      out += "wfc ";
      expr(out, node.expr);
      break;
    case StmtKind::border:
      out += "border";
      sockets(out, program_.ast.tiles[node.extra], " ");
      out += ';';
      break;
    case StmtKind::let:
      out += join({"let ", program_.text(node.name), " = "});
      expr(out, node.expr);
      out += ';';
      break;
    case StmtKind::field:
      field(out, program_.fields[node.extra]);
      break;
    case StmtKind::mat:
      out += join({"mat ", program_.text(node.name), ";"});
      break;
    case StmtKind::tag:
      out += join({"tag ", quoteText(program_.text(node.name)), ";"});
      break;
    case StmtKind::anchor:
      out += join({"anchor ", program_.text(node.name)});
      if (node.name2 != kNoId) out += join({" ", quoteText(program_.text(node.name2))});
      out += ';';
      break;
    case StmtKind::detail:
      out += "detail ";
      expr(out, node.expr);
      break;
    case StmtKind::footprint:
      footprint(out, program_.ast.footprints[node.extra]);
      out += join({" as ", program_.text(node.name), ";"});
      break;
    case StmtKind::extrude:
      out += "extrude ";
      expr(out, node.expr);
      out += " of ";
      expr(out, node.plan);
      if (node.body == kNoId) out += ';';
      break;
    case StmtKind::roof:
      roof(out, node);
      out += ';';
      break;
    case StmtKind::fit:
      fit(out, node);
      break;
    case StmtKind::inner:
      out += "inner;";
      break;
  }
}

void LinePrinter::statement(std::string& out, StmtId id) const {
  const StmtNode& node = program_.stmt(id);
  if (node.kind == StmtKind::block) {
    out += "{ ";
    for (uint32_t i = 0; i < node.children.count; ++i) {
      statement(out, program_.idAt(node.children, i));
      out += ' ';
    }
    out += '}';
    return;
  }
  head(out, node);
  if (infoOf(node.kind).has_parts) {
    out += " { ";
    for (uint32_t i = 0; i < node.children.count; ++i) {
      if (opensGroup(node, i)) out += "{ ";
      part(out, node, i);
      statement(out, program_.idAt(node.children, i));
      out += closesGroup(node, i) ? " }* " : " ";
    }
    out += '}';
    return;
  }
  if (node.body == kNoId) return;
  out += ' ';
  statement(out, node.body);
}

bool LinePrinter::opensGroup(const StmtNode& node, uint32_t i) const {
  const PartNode* parts = program_.ast.parts.data() + node.parts.first;
  return parts[i].repeated && (i == 0 || !parts[i - 1].repeated);
}

bool LinePrinter::closesGroup(const StmtNode& node, uint32_t i) const {
  const PartNode* parts = program_.ast.parts.data() + node.parts.first;
  return parts[i].repeated && (i + 1 == node.parts.count || !parts[i + 1].repeated);
}

void LinePrinter::part(std::string& out, const StmtNode& node, uint32_t i) const {
  const PartNode& part = program_.ast.parts[node.parts.first + i];
  if (node.kind == StmtKind::comp) {
    out += boxPartTable()[static_cast<size_t>(part.of)];
  } else if (node.kind == StmtKind::treemap) {
    if (part.floor == FloorPart::link) return;
    if (part.floor == FloorPart::room) {
      out += join({program_.text(part.label), " "});
      expr(out, part.size);
    } else {
      out += part.floor == FloorPart::corridor ? "corridor" : "facade";
    }
  } else if (node.kind == StmtKind::wfc) {
    if (part.label == kNoId) return;
    out += join({program_.text(part.label), " "});
    expr(out, part.size);
    const TileNode& tile = program_.ast.tiles[part.tile];
    if (tile.turns) out += " turn";
    sockets(out, tile, ", ");
  } else {
    if (part.flexible) out += '~';
    expr(out, part.size);
  }
  out += ": ";
}

void LinePrinter::ruleHead(std::string& out, const Rule& rule, const Alternative& alternative) const {
  out += join({"rule ", program_.text(rule.name)});
  formals(out, alternative.formals);
  auto clause = [&](std::string_view word, ExprId value, ExprId call = kNoId) {
    if (value == kNoId) return;
    out += word;
    expr(out, value);
    if (call == kNoId) return;
    out += " -> ";
    expr(out, call);
  };
  if (alternative.guard == Guard::otherwise) out += " else";
  clause(" when ", alternative.when);
  clause(" weight ", alternative.weight);
  clause(" depth ", alternative.depth, alternative.depth_call);
  clause(" minsize ", alternative.minsize, alternative.minsize_call);
  clause(" lod ", alternative.lod);
}

void LinePrinter::overrideHead(std::string& out, const Override& edit) const {
  out += join({edit.by_tag ? "override tag " : "override ", quoteText(program_.text(edit.address))});
}

void LinePrinter::morphic(std::string& out, const Rule& rule, const Alternative& alternative) const {
  const StmtNode& morph = program_.stmt(program_.idAt(program_.stmt(alternative.body).children, 0));
  out += join({"morphic ", program_.text(rule.name)});
  formals(out, alternative.formals);
  out += " : ";
  morphOperand(out, program_.idAt(morph.children, 0));
  out += " -> ";
  morphOperand(out, program_.idAt(morph.children, 1));
  out += " by ";
  expr(out, morph.expr);
  out += morph.power ? " power;" : ";";
}

}  // namespace sgm
