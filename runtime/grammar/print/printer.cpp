#include "grammar/print/printer.h"

#include <algorithm>

#include "grammar/print/print_expressions.h"
#include "grammar/syntax/keywords.h"
#include "grammar/syntax/lexer.h"
#include "grammar/syntax/precedence.h"
#include "grammar/text/sink.h"

namespace sgm {

namespace {

constexpr size_t kWidth = 110;
// length in bytes of the longest source text that the printer tries to print on one line; bounds the work
constexpr uint32_t kLongestInline = 400;

void measureText(std::string& out, const Program& program, const LinePrinter& line, const Expectation& e) {
  out += measureName(e.measure);
  if (e.of != kNoId) {
    out += join({"(", program.text(e.of)});
    if (e.above != kNoId) {
      out += " above ";
      line.expr(out, e.above);
    }
    out += ')';
  }
  if (e.compared) {
    out += binaryText(e.comparison);
    line.expr(out, e.value);
  }
  if (e.low != kNoId) {
    out += " in ";
    line.expr(out, e.low, kOr);
    out += "..";
    line.expr(out, e.high, kOr);
  }
  if (e.block > 0) out += join({" in block(", std::to_string(e.block), ")"});
  if (e.per_name != kNoId) out += join({" per ", program.text(e.per_name)});
}

/// Prints those parts of a `param` declaration that affect the world. The other parts concern only the host
/// application.
void paramMeaning(std::string& out, const Program& program, const LinePrinter& line, const Param& param) {
  out += join({"param ", program.text(param.name), " = "});
  line.expr(out, param.value_expr);
  if (!param.has_range) return;
  out += " in ";
  line.expr(out, param.low_expr, kOr);
  out += "..";
  line.expr(out, param.high_expr, kOr);
}

/// Prints any declaration on one line.
void declarationLine(std::string& out, const Program& program, const ModuleSyntax& syntax, const LinePrinter& line,
                     const Item& item) {
  switch (item.kind) {
    case ItemKind::version:
      out += "sgm 1;";
      break;
    case ItemKind::import: {
      const ImportDecl& import = syntax.imports[item.index];
      out += join({"import ", quoteText(program.text(import.path)), " as ", program.text(import.alias), ";"});
      break;
    }
    case ItemKind::units:
      out += join({"units ", program.text(syntax.unit), ";"});
      break;
    case ItemKind::param: {
      const Param& param = program.params[item.index];
      paramMeaning(out, program, line, param);
      if (param.animated) out += " animated";
      if (param.doc != kNoId) out += join({" ", quoteText(program.text(param.doc))});
      out += ';';
      break;
    }
    case ItemKind::seed:
      out += "seed ";
      line.expr(out, syntax.seed);
      out += ';';
      break;
    case ItemKind::let: {
      const Let& let = program.lets[item.index];
      out += join({"let ", program.text(let.name)});
      if (let.function && let.formals.count == 0) out += "()";
      line.formals(out, let.formals);
      out += " = ";
      line.expr(out, let.body);
      out += ';';
      break;
    }
    case ItemKind::field:
      line.field(out, program.fields[item.index]);
      break;
    case ItemKind::domain: {
      const DomainDecl& domain = syntax.domain;
      out += domain.infinite ? "domain infinite" : "domain finite";
      if (domain.axes_written) {
        out += " axes ";
        for (size_t axis = 0; axis < 3; ++axis)
          if (domain.axes[axis]) out += static_cast<char>('x' + axis);
      }
      if (domain.box) {
        out += " box";
        line.args(out, domain.box_args, "box");
      }
      if (domain.solid) out += " solid";
      if (domain.empty) out += " empty";
      if (domain.material != kNoId) out += join({" ", program.text(domain.material)});
      if (domain.density) out += " output density";
      if (domain.density_edge != kNoId) {
        out += " edge ";
        line.expr(out, domain.density_edge);
      }
      out += ';';
      break;
    }
    case ItemKind::layer: {
      const LayerDecl& layer = syntax.layers[item.index];
      out += join({"layer ", program.text(layer.name), " cell "});
      line.expr(out, layer.cell);
      out += " reach ";
      line.expr(out, layer.reach);
      if (layer.detail != kNoId) {
        out += " detail ";
        line.expr(out, layer.detail);
      }
      for (size_t i = 0; i < layer.uses.size(); ++i)
        out += join({i == 0 ? " uses " : ", ", program.text(layer.uses[i].name)});
      out += " { start ";
      line.expr(out, layer.start);
      out += "; }";
      break;
    }
    case ItemKind::start:
      out += "start ";
      line.expr(out, syntax.start);
      out += ';';
      break;
    case ItemKind::alternative: {
      const Rule& rule = program.rules[item.index];
      const Alternative& alternative = rule.alternatives[item.sub];
      if (rule.morphic) return line.morphic(out, rule, alternative);
      line.ruleHead(out, rule, alternative);
      out += ' ';
      line.statement(out, alternative.body);
      break;
    }
    case ItemKind::overriding: {
      const Override& edit = program.overrides[item.index];
      line.overrideHead(out, edit);
      out += ' ';
      line.statement(out, edit.body);
      break;
    }
    case ItemKind::expectation: {
      const Expectation& e = program.expectations[item.index];
      out += e.expect ? "expect " : "report ";
      measureText(out, program, line, e);
      out += ';';
      break;
    }
  }
}

class ModulePrinter {
 public:
  ModulePrinter(const Program& program, const ModuleSyntax& syntax)
      : program_(program),
        syntax_(syntax),
        line_(program, false),
        text_(program.modules[syntax.module].text),
        comments_(program.modules[syntax.module].comments) {}

  std::string run() {
    for (const Item& item : syntax_.items) {
      begin(item.span, 0);
      const StmtId block = blockOf(item);
      std::string text;
      if (block == kNoId || fitsOneLine(item.span)) declarationLine(text, program_, syntax_, line_, item);
      if (block != kNoId && (text.empty() || text.size() > kWidth))
        inLines(item, block);
      else
        out_ += text;
      end(item.span);
    }
    comments(static_cast<uint32_t>(text_.size()) + 1, 0);
    return std::move(out_);
  }

 private:
  void indent(size_t depth) { out_.append(2 * depth, ' '); }

  void blankLine(int source_line) {
    if (last_line_ > 0 && source_line > last_line_ + 1) out_ += '\n';
  }

  std::string_view commentText(const Comment& comment) const {
    return text_.substr(comment.begin, comment.end - comment.begin);
  }

  /// Prints all pending comments that begin before a byte offset, each on its own line.
  void comments(uint32_t before, size_t depth) {
    for (; next_ < comments_.size() && comments_[next_].begin < before; ++next_) {
      blankLine(comments_[next_].line);
      indent(depth);
      out_ += join({commentText(comments_[next_]), "\n"});
      last_line_ = comments_[next_].line;
    }
  }

  /// Prints a pending comment behind the printed text if the source has it at the end of this line.
  void trailing(int line) {
    if (next_ < comments_.size() && !comments_[next_].own_line && comments_[next_].line <= line) {
      out_ += join({"  ", commentText(comments_[next_])});
      ++next_;
    }
  }

  void begin(const Span& span, size_t depth) {
    comments(span.begin, depth);
    blankLine(span.line);
    indent(depth);
    last_line_ = span.line;
  }

  void end(const Span& span) {
    if (next_ < comments_.size() && comments_[next_].begin >= span.end && comments_[next_].line == span.end_line)
      trailing(span.end_line);
    out_ += '\n';
    last_line_ = std::max(last_line_, span.end_line);
  }

  bool fitsOneLine(const Span& span) const {
    if (span.line != span.end_line || span.end - span.begin > kLongestInline) return false;
    return next_ >= comments_.size() || comments_[next_].begin >= span.end;
  }

  bool hasComment(const Span& span) const { return next_ < comments_.size() && comments_[next_].begin < span.end; }

  /// Returns the block of a declaration if it may span several lines; otherwise kNoId.
  StmtId blockOf(const Item& item) const {
    if (item.kind == ItemKind::overriding) return program_.overrides[item.index].body;
    if (item.kind != ItemKind::alternative || program_.rules[item.index].morphic) return kNoId;
    return program_.rules[item.index].alternatives[item.sub].body;
  }

  void inLines(const Item& item, StmtId block) {
    if (item.kind == ItemKind::overriding) {
      line_.overrideHead(out_, program_.overrides[item.index]);
    } else {
      const Rule& rule = program_.rules[item.index];
      line_.ruleHead(out_, rule, rule.alternatives[item.sub]);
    }
    out_ += ' ';
    blockInLines(program_.stmt(block), 0);
  }

  void blockInLines(const StmtNode& block, size_t depth) {
    if (block.children.count == 0 && !hasComment(block.span)) {
      out_ += "{ }";
      return;
    }
    out_ += '{';
    trailing(block.span.line);
    out_ += '\n';
    last_line_ = 0;
    for (uint32_t i = 0; i < block.children.count; ++i) {
      const StmtNode& child = program_.stmt(program_.idAt(block.children, i));
      begin(child.span, depth + 1);
      statement(program_.idAt(block.children, i), depth + 1);
      end(child.span);
    }
    comments(block.span.end, depth + 1);
    indent(depth);
    out_ += '}';
    last_line_ = block.span.end_line;
  }

  /// Prints the parts of a split, comp, treemap or wfc, one per line; a repeated group is indented once more.
  void partsInLines(const StmtNode& node, size_t depth) {
    out_ += " {";
    trailing(node.span.line);
    out_ += '\n';
    last_line_ = 0;
    for (uint32_t i = 0; i < node.children.count; ++i) {
      const PartNode& part = program_.ast.parts[node.parts.first + i];
      if (line_.opensGroup(node, i)) {
        begin(part.group, depth + 1);
        out_ += '{';
        trailing(part.group.line);
        out_ += '\n';
        last_line_ = 0;
      }
      const size_t inside = depth + (part.repeated ? 2 : 1);
      begin(part.span, inside);
      line_.part(out_, node, i);
      statement(program_.idAt(node.children, i), inside);
      end(part.span);
      if (!line_.closesGroup(node, i)) continue;
      comments(part.group.end, depth + 2);
      indent(depth + 1);
      out_ += "}*";
      end(part.group);
    }
    comments(node.span.end, depth + 1);
    indent(depth);
    out_ += '}';
    last_line_ = node.span.end_line;
  }

  /// Prints a fit with one zone per line.
  void zonesInLines(const StmtNode& node, size_t depth) {
    const FitNode& fit = program_.ast.fits[node.extra];
    out_ += join({"fit ", program_.text(node.name)});
    for (uint32_t i = 0; i < fit.zones.count; ++i) {
      out_ += '\n';
      indent(depth + 1);
      line_.fitZone(out_, program_.ast.fit_zones[fit.zones.first + i]);
    }
    out_ += ';';
    last_line_ = node.span.end_line;
  }

  void statement(StmtId id, size_t depth) {
    const StmtNode& node = program_.stmt(id);
    if (fitsOneLine(node.span)) {
      std::string text;
      line_.statement(text, id);
      const size_t line_begin = out_.rfind('\n') + 1;
      if (out_.size() - line_begin + text.size() <= kWidth) {
        out_ += text;
        return;
      }
    }
    if (node.kind == StmtKind::block) return blockInLines(node, depth);
    if (node.kind == StmtKind::fit) return zonesInLines(node, depth);
    line_.head(out_, node);
    if (infoOf(node.kind).has_parts) return partsInLines(node, depth);
    if (node.body == kNoId) return;
    out_ += ' ';
    statement(node.body, depth);
  }

  const Program& program_;
  const ModuleSyntax& syntax_;
  LinePrinter line_;
  std::string_view text_;
  const std::pmr::vector<Comment>& comments_;
  std::string out_;
  size_t next_ = 0;    ///< index of the first comment that is not printed yet
  int last_line_ = 0;  ///< source line of the last printed text; 0 at the start of a block
};

}  // namespace

std::string printModule(const Program& program, const ModuleSyntax& syntax) {
  return ModulePrinter(program, syntax).run();
}

std::string printMeaning(const Program& program, const ModuleSyntax& syntax) {
  const LinePrinter line(program, true);
  std::string out;
  for (const Item& item : syntax.items) {
    if (item.kind == ItemKind::expectation || item.kind == ItemKind::units) continue;
    if (item.kind == ItemKind::param)
      paramMeaning(out, program, line, program.params[item.index]);
    else
      declarationLine(out, program, syntax, line, item);
  }
  return out;
}

std::string_view measureName(Measure measure) { return measureTable()[static_cast<size_t>(measure)]; }

std::string printMeasure(const Program& program, const Expectation& expectation) {
  std::string out;
  measureText(out, program, LinePrinter(program, false), expectation);
  return out;
}

}  // namespace sgm
