#include "asset/read/ply_header.h"

#include <charconv>
#include <utility>

#include "asset/read/mesh_limits.h"
#include "asset/read/text_reader.h"

namespace sgm::asset {

namespace {

std::optional<PlyType> typeOf(std::string_view word) {
  constexpr std::pair<std::string_view, PlyType> kNames[] = {
      {"char", PlyType::int8},      {"int8", PlyType::int8},       {"uchar", PlyType::uint8},
      {"uint8", PlyType::uint8},    {"short", PlyType::int16},     {"int16", PlyType::int16},
      {"ushort", PlyType::uint16},  {"uint16", PlyType::uint16},   {"int", PlyType::int32},
      {"int32", PlyType::int32},    {"uint", PlyType::uint32},     {"uint32", PlyType::uint32},
      {"float", PlyType::float32},  {"float32", PlyType::float32}, {"double", PlyType::float64},
      {"float64", PlyType::float64}};
  for (const auto& [name, type] : kNames)
    if (name == word) return type;
  return std::nullopt;
}

class PlyHeaderReader {
 public:
  explicit PlyHeaderReader(std::string_view file) : file_(file), text_(file) {}

  Result<PlyHeader> run() {
    if (text_.rest() != "ply") return wrongAtLine("it is not a PLY file: it does not begin with `ply`", 1);
    bool formatted = false;
    for (;;) {
      if (!text_.nextLine()) return wrong("it ends within its header");
      const std::string_view keyword = text_.word();
      if (keyword == "end_header") break;
      if (keyword == "comment" || keyword == "obj_info" || keyword.empty()) continue;
      Result<void> read = keyword == "format"     ? format()
                          : keyword == "element"  ? element()
                          : keyword == "property" ? property()
                                                  : wrong(shown(keyword) + " is not a keyword of a PLY header");
      if (!read) return read.error();
      formatted = formatted || keyword == "format";
    }
    if (!formatted) return wrong("its header has no `format`");
    header_.lines = text_.line();
    text_.rest();
    header_.bytes = numbersBegin(text_.byte());
    return std::move(header_);
  }

 private:
  Error wrong(std::string_view what) const { return wrongAtLine(what, text_.line()); }

  Result<void> format() {
    const std::string_view word = text_.word(), version = text_.word();
    constexpr std::string_view kNames[] = {"ascii", "binary_little_endian", "binary_big_endian"};
    for (size_t i = 0; i < 3; ++i) {
      if (word != kNames[i] || version != "1.0") continue;
      header_.format = static_cast<PlyFormat>(i);
      return {};
    }
    return wrong("it has the format " + shown(word) + " of version " + shown(version) +
                 "; the formats of version 1.0 are `ascii`, `binary_little_endian` and `binary_big_endian`");
  }

  Result<void> element() {
    PlyElement element;
    element.name = cleanName(text_.word());
    const std::string_view count = text_.word();
    const auto [stop, error] = std::from_chars(count.data(), count.data() + count.size(), element.count);
    if (error != std::errc() || stop != count.data() + count.size() || count.empty())
      return wrong(shown(count) + " is not a number of elements");
    const bool known = element.name == "vertex" || element.name == "face" || element.name == "tristrips";
    for (const PlyElement& other : header_.elements)
      if (known && other.name == element.name) return wrong("it has two elements " + shown(element.name));
    header_.elements.push_back(std::move(element));
    return {};
  }

  Result<void> property() {
    if (header_.elements.empty()) return wrong("a property stands before the first element");
    PlyProperty property;
    std::string_view word = text_.word();
    if (word == "list") {
      word = text_.word();
      property.count = typeOf(word);
      if (!property.count || *property.count >= PlyType::float32)
        return wrong(shown(word) + " is not a type of a list's length");
      word = text_.word();
    }
    const std::optional<PlyType> type = typeOf(word);
    if (!type) return wrong(shown(word) + " is not a type of a property");
    property.type = *type;
    property.name = cleanName(text_.word());
    if (property.name.empty()) return wrong("a property has no name");
    header_.elements.back().properties.push_back(std::move(property));
    return {};
  }

  /// Returns the offset after the header's last line. The end of the last line must have the same form as the end of
  /// the first line, because a following "\n" may already be a byte of a binary number.
  size_t numbersBegin(size_t at) const {
    const std::string_view end = file_.substr(at, 2);
    if (end == "\r\n" && file_.find('\n') == file_.find('\r') + 1) return at + 2;
    return at + (end.empty() ? 0 : 1);
  }

  std::string_view file_;
  TextReader text_;
  PlyHeader header_;
};

}  // namespace

size_t PlyElement::find(std::string_view property) const {
  size_t i = 0;
  while (i < properties.size() && properties[i].name != property) ++i;
  return i;
}

Result<PlyHeader> readPlyHeader(std::string_view file) { return PlyHeaderReader(file).run(); }

}  // namespace sgm::asset
