#include "grammar/syntax/lexer.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "base/math.h"
#include "base/utf8.h"
#include "grammar/syntax/keywords.h"
#include "grammar/text/codes.h"
#include "grammar/text/text_encoding.h"

namespace sgm {

namespace {

constexpr size_t kLongestName = 64;
constexpr size_t kLongestText = 1024;
constexpr size_t kLongestNumber = 40;
constexpr double kLargestNumber = 1e9;
constexpr double kLargestLength = 2097151;  // metres: world coordinates end at 2^31 units of 1/1024 m

struct Unit {
  std::string_view name;
  Dim dim;
  /// size of the unit in metres, radians or ratios; if `divide` is set: number of units in one metre, radian or ratio
  double factor;
  /// the value is divided by the factor, which is more exact than a product: 3cm is the double 0.03
  bool divide;
};

constexpr std::array<Unit, 13> kUnits = {{{"m", kLength, 1, false},
                                          {"cm", kLength, 100, true},
                                          {"mm", kLength, 1000, true},
                                          {"km", kLength, 1000, false},
                                          {"m2", kArea, 1, false},
                                          {"cm2", kArea, 1e4, true},
                                          {"km2", kArea, 1e6, false},
                                          {"m3", kVolume, 1, false},
                                          {"cm3", kVolume, 1e6, true},
                                          {"km3", kVolume, 1e9, false},
                                          {"deg", kAngle, kPi / 180, false},
                                          {"rad", kAngle, 1, false},
                                          {"%", kRatio, 100, true}}};

bool isDigit(char c) { return c >= '0' && c <= '9'; }
bool isLetter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool isWordChar(char c) { return isLetter(c) || isDigit(c); }

class Lexer {
 public:
  Lexer(std::string_view text, uint32_t file, uint32_t max_tokens, DiagnosticSink& sink,
        std::pmr::memory_resource* memory)
      : text_(text),
        file_(file),
        max_tokens_(max_tokens),
        sink_(sink),
        out_{std::pmr::vector<Token>(memory), std::pmr::vector<Comment>(memory), true, {}, SIZE_MAX} {}

  LexResult run() {
    if (const auto fault = encodingFault(text_)) return unreadable(*fault);
    if (text_.starts_with("\xEF\xBB\xBF")) at_ = line_start_ = 3;
    while (skipBlank() && !sink_.full()) {
      if (out_.tokens.size() >= max_tokens_) {
        const Span here = spanFrom(at_, line_, at_ - line_start_);
        error(here, codes::kTooLarge,
              join({"the text has more than ", std::to_string(max_tokens_), " words and signs"}),
              "use loops and rules to say the same in fewer");
        out_.readable = false;
        break;
      }
      token();
    }
    sayForeignBytes();
    Token end;
    end.span = spanFrom(at_, line_, at_ - line_start_);
    out_.tokens.push_back(end);
    return std::move(out_);
  }

 private:
  void error(const Span& span, std::string_view code, std::string message, std::string hint) {
    out_.broken_lines.push_back(span.line);
    sink_.error(span, code, std::move(message), std::move(hint));
  }

  /// Reports a single error for the whole file: it is not UTF-8, so the characters read from it are not those that the
  /// author wrote.
  LexResult unreadable(const EncodingFault& fault) {
    for (size_t i = 0; i < fault.at; ++i, ++at_)
      if (text_[i] == '\n') ++line_, line_start_ = i + 1;
    const size_t begin = at_;
    if (at_ < text_.size()) ++at_;
    const Span span = spanFrom(begin, line_, begin - line_start_);
    error(span, codes::kBadCharacter, std::string(fault.message), std::string(fault.hint));
    Token end;
    end.span = span;
    out_.tokens.push_back(end);
    out_.readable = false;
    return std::move(out_);
  }

  /// Records a byte that is not UTF-8. All such bytes have the same cause, so only one error is reported.
  void foreignByte(const Span& span) {
    out_.broken_lines.push_back(span.line);
    if (foreign_bytes_++ == 0) first_foreign_ = span;
  }

  void sayForeignBytes() {
    if (foreign_bytes_ == 0) return;
    Diagnostic& d =
        sink_.error(first_foreign_, codes::kBadCharacter, "this byte is not UTF-8", "save the file as UTF-8");
    if (foreign_bytes_ > 1)
      d.notes.push_back(
          join({std::to_string(foreign_bytes_ - 1),
                foreign_bytes_ == 2 ? " more byte of this file is" : " more bytes of this file are", " not UTF-8"}));
  }

  char peek(size_t ahead = 0) const { return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0'; }
  bool done() const { return at_ >= text_.size(); }

  Span spanFrom(size_t begin, int line, size_t column) const {
    Span span;
    span.file = file_;
    span.begin = static_cast<uint32_t>(begin);
    span.end = static_cast<uint32_t>(at_);
    span.line = line;
    span.column = static_cast<int>(column) + 1;
    span.end_line = line_;
    span.end_column = static_cast<int>(at_ - line_start_) + 1;
    return span;
  }

  void newLine() {
    ++at_;
    ++line_;
    line_start_ = at_;
    fresh_line_ = true;
  }

  /// Skips white space and comments. Returns false at the end of the text.
  bool skipBlank() {
    blank_ = at_ == 0;
    while (!done()) {
      const char c = peek();
      if (c == '\n') {
        newLine();
      } else if (c == ' ' || c == '\t' || c == '\r') {
        ++at_;
      } else if (c == '/' && peek(1) == '/') {
        Comment comment;
        comment.begin = static_cast<uint32_t>(at_);
        comment.line = line_;
        comment.own_line = fresh_line_;
        while (!done() && peek() != '\n') character();
        size_t end = at_;
        while (end > comment.begin && (text_[end - 1] == ' ' || text_[end - 1] == '\t' || text_[end - 1] == '\r'))
          --end;
        comment.end = static_cast<uint32_t>(end);
        out_.comments.push_back(comment);
      } else {
        return true;
      }
      blank_ = true;
    }
    return false;
  }

  /// Skips one character of a comment or a text constant.
  void character() {
    const size_t size = utf8Size(text_.substr(at_));
    const size_t begin = at_;
    at_ += std::max(size, size_t{1});
    if (size == 0) foreignByte(spanFrom(begin, line_, begin - line_start_));
  }

  void push(Tok kind, size_t begin, size_t column) {
    Token token;
    token.kind = kind;
    token.space_before = blank_;
    token.span = spanFrom(begin, line_, column);
    out_.tokens.push_back(token);
  }

  void token() {
    fresh_line_ = false;
    const size_t begin = at_, column = at_ - line_start_;
    const char c = peek();
    if (isLetter(c)) {
      word(begin, column);
    } else if (isDigit(c) || (c == '.' && isDigit(peek(1)))) {
      number(begin, column);
    } else if (c == '"') {
      textConstant(begin, column);
    } else {
      sign(begin, column);
    }
  }

  void word(size_t begin, size_t column) {
    while (isWordChar(peek())) ++at_;
    push(Tok::word, begin, column);
    Token& token = out_.tokens.back();
    const std::string_view name = text_.substr(begin, at_ - begin);
    if (name.size() > kLongestName)
      error(token.span, codes::kTooLarge, join({"a name has at most ", std::to_string(kLongestName), " letters"}),
            "shorten it");
    token.keyword = isKeyword(name);
    token.unavailable = isUnavailable(name);
  }

  void brokenNumber(Token& token, std::string_view code, std::string message, std::string hint) {
    token.broken = true;
    error(token.span, code, std::move(message), std::move(hint));
  }

  void number(size_t begin, size_t column) {
    const bool leading_point = peek() == '.';
    while (isDigit(peek())) ++at_;
    if (peek() == '.' && isDigit(peek(1))) {
      ++at_;
      while (isDigit(peek())) ++at_;
    }
    if (peek() == 'e' || peek() == 'E') {
      const size_t sign = peek(1) == '+' || peek(1) == '-' ? 1 : 0;
      if (isDigit(peek(1 + sign))) {
        at_ += 1 + sign;
        while (isDigit(peek())) ++at_;
      }
    }
    const std::string_view digits = text_.substr(begin, at_ - begin);
    const size_t unit_begin = at_;
    if (peek() == '%')
      ++at_;
    else
      while (isWordChar(peek())) ++at_;
    const std::string_view unit = text_.substr(unit_begin, at_ - unit_begin);
    push(Tok::number, begin, column);
    Token& token = out_.tokens.back();
    if (leading_point) {
      brokenNumber(token, codes::kBadNumber, "a number starts with a digit", join({"write 0", digits, unit}));
      return;
    }
    double value = 0;
    if (digits.size() <= kLongestNumber) {
      const auto parsed = std::from_chars(digits.data(), digits.data() + digits.size(), value);
      if (parsed.ec != std::errc()) value = kLargestNumber * 1e30;
    } else {
      value = kLargestNumber * 1e30;
    }
    if (!unit.empty()) {
      const Unit* known = nullptr;
      Suggestion suggestion(unit);
      for (const Unit& u : kUnits) {
        if (u.name == unit) known = &u;
        suggestion.offer(u.name);
      }
      if (known == nullptr) {
        const std::string hint = suggestion.hint();
        brokenNumber(token, codes::kUnknownUnit, join({"unknown unit `", unit.substr(0, kLongestName), "`"}),
                     hint.empty() ? "units are m, cm, mm, km, m2, m3, deg, rad and %" : hint);
        return;
      }
      token.dim = known->dim;
      value = known->divide ? value / known->factor : value * known->factor;
    }
    const double largest = token.dim == kLength   ? kLargestLength
                           : token.dim.length > 1 ? kLargestNumber * kLargestNumber
                                                  : kLargestNumber;
    if (!(value <= largest)) {
      brokenNumber(token, codes::kNumberRange, "this number is too large",
                   token.dim == kLength   ? "the world ends at 2097 km"
                   : token.dim.length > 1 ? "write at most 1e18"
                                          : "write at most 1e9");
      return;
    }
    token.value = value;
  }

  void textConstant(size_t begin, size_t column) {
    ++at_;
    std::string_view complaint, hint;
    for (;;) {
      const char c = peek();
      if (done() || c == '\n') {
        push(Tok::text, begin, column);
        out_.torn_at = std::min(out_.torn_at, begin);
        error(out_.tokens.back().span, codes::kBadText, "this text has no closing quote", "close it with \"");
        return;
      }
      if (c == '\\') {
        if (peek(1) != '"' && peek(1) != '\\') {
          complaint = "a backslash stands before a quote or a backslash only";
          hint = "write `\\\\` for a backslash";
        }
        at_ += peek(1) == '"' || peek(1) == '\\' ? size_t{2} : size_t{1};
        continue;
      }
      if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) {
        complaint = "a text has no control characters";
        hint = "write a space";
      }
      character();
      if (c == '"') break;
    }
    if (at_ - begin > kLongestText + 2) {
      complaint = "a text has at most 1024 bytes";
      hint = "shorten it";
    }
    push(Tok::text, begin, column);
    if (!complaint.empty()) error(out_.tokens.back().span, codes::kBadText, std::string(complaint), std::string(hint));
  }

  /// Reports and skips a comment in the form /* */, so that its words are not parsed.
  void foreignComment(size_t begin, size_t column) {
    at_ += 2;
    error(spanFrom(begin, line_, column), codes::kBadCharacter, "`/*` does not begin a comment",
          "comments start with // and end with their line");
    while (!done() && !(peek() == '*' && peek(1) == '/')) {
      if (peek() == '\n')
        newLine();
      else
        ++at_;
    }
    at_ = std::min(at_ + 2, text_.size());
  }

  void sign(size_t begin, size_t column) {
    const char c = peek(), next = peek(1);
    auto one = [&](Tok kind) { ++at_, push(kind, begin, column); };
    auto two = [&](Tok kind) { at_ += 2, push(kind, begin, column); };
    switch (c) {
      case '(':
        return one(Tok::open_paren);
      case ')':
        return one(Tok::close_paren);
      case '{':
        return one(Tok::open_brace);
      case '}':
        return one(Tok::close_brace);
      case ',':
        return one(Tok::comma);
      case ';':
        return one(Tok::semicolon);
      case ':':
        return one(Tok::colon);
      case '.':
        return next == '.' ? two(Tok::dots) : one(Tok::dot);
      case '+':
        return one(Tok::plus);
      case '-':
        return next == '>' ? two(Tok::arrow) : one(Tok::minus);
      case '*':
        return one(Tok::star);
      case '/':
        return next == '*' ? foreignComment(begin, column) : one(Tok::slash);
      case '~':
        return one(Tok::tilde);
      case '<':
        return next == '=' ? two(Tok::less_equal) : one(Tok::less);
      case '>':
        return next == '=' ? two(Tok::greater_equal) : one(Tok::greater);
      case '=':
        return next == '=' ? two(Tok::equal) : one(Tok::assign);
      default:
        break;
    }
    if (c == '!' && next == '=') return two(Tok::not_equal);
    const size_t size = utf8Size(text_.substr(at_));
    at_ += std::max(size, size_t{1});
    push(Tok::broken, begin, column);
    const Span span = out_.tokens.back().span;
    if (size == 0) return foreignByte(span);
    std::string hint = "names consist of the letters a to z, digits and `_`";
    if (c == '&') hint = "write `and`";
    if (c == '|') hint = "write `or`";
    if (c == '!') hint = "write `not`";
    if (c == '#') hint = "comments start with //";
    if (c == '\'') hint = "texts stand in double quotes";
    if (c == '%') hint = "write `a - b*floor(a/b)` for the remainder of a division";
    if (c == '^') hint = "write `pow(a, b)`";
    if (c == '?') hint = "write `if a < b then c else d`";
    if (c == '[' || c == ']') hint = "write a vector as `(x, y, z)`";
    if (c == '&' || c == '|')
      while (peek() == c) ++at_;
    error(span, codes::kBadCharacter, "this character has no place here", std::move(hint));
  }

  std::string_view text_;
  uint32_t file_;
  uint32_t max_tokens_;
  DiagnosticSink& sink_;
  LexResult out_;
  size_t at_ = 0, line_start_ = 0;
  int line_ = 1;
  size_t foreign_bytes_ = 0;
  Span first_foreign_;
  bool fresh_line_ = true;
  bool blank_ = true;
};

}  // namespace

bool isUnit(std::string_view word) {
  return std::any_of(kUnits.begin(), kUnits.end(), [word](const Unit& unit) { return unit.name == word; });
}

bool isName(std::string_view text) {
  return !text.empty() && isLetter(text[0]) && std::all_of(text.begin(), text.end(), isWordChar);
}

LexResult lex(std::string_view text, uint32_t file, uint32_t max_tokens, DiagnosticSink& sink,
              std::pmr::memory_resource* memory) {
  return Lexer(text, file, max_tokens, sink, memory).run();
}

std::string textContent(std::string_view quoted) {
  std::string out;
  for (size_t i = 1; i + 1 < quoted.size(); ++i) {
    if (quoted[i] == '\\' && i + 2 < quoted.size()) ++i;
    out += quoted[i];
  }
  return out;
}

std::string quoteText(std::string_view content) {
  std::string out = "\"";
  for (char c : content) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + "\"";
}

}  // namespace sgm
