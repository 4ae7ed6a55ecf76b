#include "asset/read/text_reader.h"

#include <charconv>
#include <limits>

#include "base/utf8.h"

namespace sgm::asset {

std::string_view TextReader::rest() {
  skipBlanks();
  const char* const from = at_;
  while (at_ < end_ && !isLineEnd(*at_)) ++at_;
  const char* to = at_;
  while (to > from && isBlank(to[-1])) --to;
  return {from, static_cast<size_t>(to - from)};
}

bool TextReader::nextLine(bool plain) {
  for (bool goes_on = true; goes_on;) {
    while (at_ < end_ && !isLineEnd(*at_)) ++at_;
    if (at_ == end_) return false;
    goes_on = continued_ && !plain && at_ > first_ && at_[-1] == '\\';
    passLineEnd();
  }
  return true;
}

std::optional<double> numberIn(std::string_view word) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  double value = 0;
  const char* const end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, value);
  if (stop != end || error == std::errc::invalid_argument) return std::nullopt;
  if (error != std::errc::result_out_of_range) return value;
  // std::from_chars reports overflow and underflow by the same error code; the exponent's sign distinguishes them.
  const bool tiny = word.find("e-") != std::string_view::npos || word.find("E-") != std::string_view::npos;
  return tiny ? 0 : std::numeric_limits<double>::infinity();
}

std::string shown(std::string_view word) {
  constexpr size_t kLongest = 40;
  std::string out = "`";
  for (const char c : word.substr(0, kLongest)) out += c > 0x20 && c < 0x7F && c != '`' ? c : '?';
  return out + (word.size() > kLongest ? "...`" : "`");
}

std::string cleanName(std::string_view name) {
  std::string out;
  while (!name.empty()) {
    const size_t size = utf8Size(name);
    const bool control = static_cast<unsigned char>(name[0]) < 0x20 || name[0] == 0x7F;
    if (size == 0 || control)
      out += '?';
    else
      out.append(name, 0, size);
    name.remove_prefix(size == 0 ? 1 : size);
  }
  return out;
}

}  // namespace sgm::asset
