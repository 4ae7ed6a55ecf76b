#include "tools/service/judge/inspector_json.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace sgm::service {
namespace {

using Json = nlohmann::json;

/// Limits of nesting and of members. Valid answers stay below them; deeper nesting could overflow the parser's stack.
constexpr size_t kDeepest = 16;
constexpr size_t kMaxMembers = 64;

/// Checks the structure of a JSON text without storing its values.
class Structure final : public nlohmann::json_sax<Json> {
 public:
  bool null() override { return depth_ > 0; }
  bool boolean(bool) override { return depth_ > 0; }
  bool number_integer(number_integer_t) override { return depth_ > 0; }
  bool number_unsigned(number_unsigned_t) override { return depth_ > 0; }
  bool number_float(number_float_t, const string_t&) override { return depth_ > 0; }
  bool string(string_t&) override { return depth_ > 0; }
  bool binary(binary_t&) override { return false; }
  bool start_object(size_t) override { return ++depth_ <= kDeepest; }
  bool key(string_t&) override { return depth_ > 1 || ++members_ <= kMaxMembers; }
  bool end_object() override { return depth_-- > 0; }
  bool start_array(size_t) override { return depth_ > 0 && ++depth_ <= kDeepest; }
  bool end_array() override { return depth_-- > 0; }
  bool parse_error(size_t, const std::string&, const nlohmann::detail::exception&) override { return false; }

 private:
  size_t depth_ = 0, members_ = 0;
};

constexpr std::string_view kSpace = " \t\r\n";

/// The offset behind the string that begins at `at` (behind its closing quotation mark), or the end of the text.
size_t behindString(std::string_view text, size_t at) {
  for (++at; at < text.size() && text[at] != '"'; ++at)
    if (text[at] == '\\') ++at;
  return std::min(at + 1, text.size());
}

/// The offset behind the value that begins at `at`: the offset of the comma or closing bracket that follows the value.
size_t behindValue(std::string_view text, size_t at) {
  for (size_t depth = 0; at < text.size();) {
    const char c = text[at];
    if (depth == 0 && (c == ',' || c == '}' || c == ']')) return at;
    if (c == '"') {
      at = behindString(text, at);
      continue;
    }
    if (c == '{' || c == '[') ++depth;
    if (c == '}' || c == ']') --depth;
    ++at;
  }
  return text.size();
}

std::string_view withoutSpace(std::string_view text) {
  const size_t first = text.find_first_not_of(kSpace);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kSpace) + 1 - first);
}

}  // namespace

bool isSoundObject(std::string_view text) {
  Structure structure;
  if (!Json::sax_parse(text.begin(), text.end(), &structure)) return false;
  std::vector<std::string_view> names;
  for (const JsonMember& member : membersOf(text)) names.push_back(member.name);
  const auto escaped = [](std::string_view name) { return name.find('\\') != std::string_view::npos; };
  if (std::ranges::any_of(names, escaped)) return false;
  std::ranges::sort(names);
  return std::ranges::adjacent_find(names) == names.end();
}

std::vector<JsonMember> membersOf(std::string_view object) {
  std::vector<JsonMember> members;
  size_t at = object.find_first_not_of(kSpace);
  if (at == std::string_view::npos || object[at] != '{') return members;
  while ((at = object.find_first_not_of(kSpace, at + 1)) < object.size() && object[at] == '"') {
    const size_t behind_name = behindString(object, at), colon = object.find(':', behind_name);
    if (colon == std::string_view::npos) break;
    const size_t end = behindValue(object, colon + 1);
    members.push_back(
        {object.substr(at + 1, behind_name - at - 2), withoutSpace(object.substr(colon + 1, end - colon - 1))});
    if (end == object.size() || object[end] != ',') break;
    at = end;
  }
  return members;
}

std::string jsonString(std::string_view text) {
  return Json(text).dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace sgm::service
