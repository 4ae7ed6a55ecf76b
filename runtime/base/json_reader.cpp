#include "base/json_reader.h"

#include <charconv>
#include <cmath>
#include <cstdint>

#include "base/utf8.h"

namespace sgm {

namespace {

constexpr int kDeepest = 64;
constexpr double kLargestWhole = 9007199254740992.0;

class JsonParser {
 public:
  JsonParser(std::string_view text, size_t max_values) : text_(text), max_values_(max_values) {}

  Result<JsonValue> run() {
    JsonValue value = parse(0);
    skip();
    if (!failed_ && at_ < text_.size()) fail("text after the value");
    if (values_ > max_values_)
      return Error{Code::limit, "it has more than " + std::to_string(max_values_) + " JSON values", 0, 0};
    if (failed_) return Error{Code::bad_input, message_, 0, 0};
    return value;
  }

 private:
  void fail(std::string_view what) {
    if (failed_) return;
    failed_ = true;
    message_ = std::string(what).append(" at byte ").append(std::to_string(at_)).append(" of its JSON");
  }

  void skip() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t' || text_[at_] == '\n' || text_[at_] == '\r'))
      ++at_;
  }

  bool accept(char c) {
    skip();
    if (failed_ || at_ >= text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }

  bool acceptWord(std::string_view word) {
    if (text_.substr(at_, word.size()) != word) return false;
    at_ += word.size();
    return true;
  }

  JsonValue parse(int depth) {
    JsonValue value;
    skip();
    if (++values_ > max_values_) {
      failed_ = true;  // sets no message: run() itself creates the error `limit`
    } else if (depth > kDeepest) {
      fail("values nested too deeply");
    } else if (at_ >= text_.size()) {
      fail("a value is missing");
    } else if (text_[at_] == '{') {
      object(value, depth);
    } else if (text_[at_] == '[') {
      array(value, depth);
    } else if (text_[at_] == '"') {
      value.kind = JsonValue::Kind::text;
      value.text = string();
    } else if (acceptWord("true")) {
      value.kind = JsonValue::Kind::boolean;
      value.number = 1;
    } else if (acceptWord("false")) {
      value.kind = JsonValue::Kind::boolean;
    } else if (!acceptWord("null")) {
      number(value);
    }
    return value;
  }

  void object(JsonValue& value, int depth) {
    value.kind = JsonValue::Kind::object;
    ++at_;
    if (accept('}')) return;
    do {
      skip();
      if (at_ >= text_.size() || text_[at_] != '"') return fail("a quoted name is missing");
      value.names.push_back(string());
      if (!accept(':')) return fail("`:` is missing");
      value.items.push_back(parse(depth + 1));
    } while (accept(','));
    if (!accept('}')) fail("`}` is missing");
  }

  void array(JsonValue& value, int depth) {
    value.kind = JsonValue::Kind::array;
    ++at_;
    if (accept(']')) return;
    do {
      value.items.push_back(parse(depth + 1));
    } while (accept(','));
    if (!accept(']')) fail("`]` is missing");
  }

  void number(JsonValue& value) {
    size_t end = at_;
    const auto digits = [&] {
      const size_t from = end;
      while (end < text_.size() && text_[end] >= '0' && text_[end] <= '9') ++end;
      return end - from;
    };
    const auto sign = [&](std::string_view signs) {
      if (end < text_.size() && signs.find(text_[end]) != std::string_view::npos) ++end;
    };
    sign("-");
    const size_t first = end, whole = digits();
    if (whole == 0 || (whole > 1 && text_[first] == '0')) return fail("a value is missing");
    if (end < text_.size() && text_[end] == '.') {
      ++end;
      if (digits() == 0) return fail("a number without digits");
    }
    if (end < text_.size() && (text_[end] == 'e' || text_[end] == 'E')) {
      ++end;
      sign("+-");
      if (digits() == 0) return fail("a number without digits");
    }
    value.kind = JsonValue::Kind::number;
    const auto [stop, error] = std::from_chars(text_.data() + at_, text_.data() + end, value.number);
    if (error != std::errc() || stop != text_.data() + end) return fail("a number out of range");
    at_ = end;
  }

  std::optional<uint32_t> hexadecimal() {
    if (at_ + 4 > text_.size()) return std::nullopt;
    uint32_t code = 0;
    const auto [stop, error] = std::from_chars(text_.data() + at_, text_.data() + at_ + 4, code, 16);
    if (error != std::errc() || stop != text_.data() + at_ + 4) return std::nullopt;
    at_ += 4;
    return code;
  }

  void escaped(std::string& out) {
    const char c = at_ < text_.size() ? text_[at_++] : '\0';
    constexpr std::string_view kNamed = "\"\\/bfnrt", kMeant = "\"\\/\b\f\n\r\t";
    if (const size_t named = kNamed.find(c); c != '\0' && named != std::string_view::npos) {
      out += kMeant[named];
      return;
    }
    std::optional<uint32_t> code;
    if (c == 'u') code = hexadecimal();
    if (code && *code >= 0xD800 && *code < 0xDC00 && acceptWord("\\u")) {
      const std::optional<uint32_t> low = hexadecimal();
      const bool pair = low && *low >= 0xDC00 && *low < 0xE000;
      code = pair ? std::optional(0x10000 + ((*code - 0xD800) << 10) + (*low - 0xDC00)) : std::nullopt;
    }
    if (!code || (*code >= 0xD800 && *code < 0xE000)) return fail("an invalid escape sequence");
    appendUtf8(out, *code);
  }

  std::string string() {
    std::string out;
    ++at_;
    while (!failed_) {
      if (at_ >= text_.size()) {
        fail("an unterminated string");
      } else if (text_[at_] == '"') {
        ++at_;
        return out;
      } else if (text_[at_] == '\\') {
        ++at_;
        escaped(out);
      } else {
        const size_t size = utf8Size(text_.substr(at_));
        if (size == 0 || static_cast<unsigned char>(text_[at_]) < 0x20) {
          fail("an invalid character");
          break;
        }
        out.append(text_, at_, size);
        at_ += size;
      }
    }
    return out;
  }

  std::string_view text_;
  size_t at_ = 0, values_ = 0, max_values_;
  bool failed_ = false;
  std::string message_;
};

}  // namespace

const JsonValue* JsonValue::find(std::string_view name) const {
  if (kind != Kind::object) return nullptr;
  for (size_t i = names.size(); i-- > 0;)
    if (names[i] == name) return &items[i];
  return nullptr;
}

std::span<const JsonValue> JsonValue::list(std::string_view name) const {
  const JsonValue* member = find(name);
  if (member == nullptr || member->kind != Kind::array) return {};
  return member->items;
}

std::optional<size_t> JsonValue::count(std::string_view name) const {
  const JsonValue* member = find(name);
  return member == nullptr ? std::nullopt : member->whole();
}

std::optional<size_t> JsonValue::whole() const {
  if (kind != Kind::number || !(number >= 0 && number <= kLargestWhole) || number != std::floor(number))
    return std::nullopt;
  return static_cast<size_t>(number);
}

Result<JsonValue> readJson(std::string_view text, size_t max_values) { return JsonParser(text, max_values).run(); }

}  // namespace sgm
