#include "tools/service/ports/field_values.h"

#include <algorithm>

namespace sgm::service {
namespace {

std::string_view trimmed(std::string_view text) {
  while (text.starts_with(' ') || text.starts_with('\t')) text.remove_prefix(1);
  while (text.ends_with(' ') || text.ends_with('\t')) text.remove_suffix(1);
  return text;
}

}  // namespace

std::string inSmallLetters(std::string_view text) {
  std::string small(text);
  for (char& c : small)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return small;
}

std::string mediaType(std::string_view content_type) {
  return inSmallLetters(trimmed(content_type.substr(0, content_type.find(';'))));
}

std::vector<std::string_view> listed(std::string_view value) {
  std::vector<std::string_view> members;
  size_t begin = 0;
  bool quoted = false;
  for (size_t i = 0; i <= value.size(); ++i) {
    if (i < value.size() && value[i] == '"') quoted = !quoted;
    if (i < value.size() && (quoted || value[i] != ',')) continue;
    const std::string_view member = trimmed(value.substr(begin, i - begin));
    if (!member.empty()) members.push_back(member);
    begin = i + 1;
  }
  return members;
}

bool namesTag(std::string_view if_none_match, std::string_view tag) {
  const std::vector<std::string_view> tags = listed(if_none_match);
  return std::any_of(tags.begin(), tags.end(), [&](std::string_view one) {
    if (one.starts_with("W/")) one.remove_prefix(2);
    return one == "*" || one == tag;
  });
}

}  // namespace sgm::service
