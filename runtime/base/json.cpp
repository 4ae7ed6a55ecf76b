#include "base/json.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/utf8.h"

namespace sgm {
namespace {

void writeText(std::string& out, std::string_view text) {
  constexpr char kHex[] = "0123456789abcdef";
  out += '"';
  while (!text.empty()) {
    const size_t size = utf8Size(text);
    const auto byte = static_cast<unsigned char>(text[0]);
    if (size == 0) {
      out += "\xEF\xBF\xBD";
    } else if (byte == '"' || byte == '\\') {
      out += '\\';
      out += text[0];
    } else if (byte == '\n') {
      out += "\\n";
    } else if (byte < 0x20 || byte == 0x7F) {
      out += "\\u00";
      out += kHex[byte / 16];
      out += kHex[byte % 16];
    } else {
      out += text.substr(0, size);
    }
    text.remove_prefix(std::max(size, size_t{1}));
  }
  out += '"';
}

template <class T>
void writeNumber(std::string& out, T value) {
  char text[32];
  out.append(text, std::to_chars(text, text + sizeof text, value).ptr);
}

/// Starts a new line. indent: number of spaces at its beginning; nullopt writes nothing, for output on a single line.
void newLine(std::string& out, std::optional<size_t> indent) {
  if (!indent) return;
  out += '\n';
  out.append(*indent, ' ');
}

}  // namespace

Json::Json(std::initializer_list<Json> values) {
  const auto isMember = [](const Json& value) {
    const Array* pair = std::get_if<Array>(&value.value_);
    return pair != nullptr && pair->size() == 2 && std::holds_alternative<std::string>((*pair)[0].value_);
  };
  if (values.size() == 0 || !std::all_of(values.begin(), values.end(), isMember)) {
    value_ = Array(values);
    return;
  }
  Object& object = value_.emplace<Object>();
  for (const Json& value : values) {
    const Array& pair = std::get<Array>(value.value_);
    object.emplace_back(std::get<std::string>(pair[0].value_), pair[1]);
  }
}

Json Json::array() {
  Json json;
  json.value_ = Array();
  return json;
}

Json Json::object() {
  Json json;
  json.value_ = Object();
  return json;
}

Json& Json::operator[](std::string_view key) {
  if (std::holds_alternative<std::nullptr_t>(value_)) value_ = Object();
  Object& object = std::get<Object>(value_);
  for (auto& [name, value] : object)
    if (name == key) return value;
  return object.emplace_back(key, Json()).second;
}

void Json::push_back(Json value) {
  if (std::holds_alternative<std::nullptr_t>(value_)) value_ = Array();
  std::get<Array>(value_).push_back(std::move(value));
}

void Json::update(Json object) {
  for (auto& [name, value] : std::get<Object>(object.value_)) (*this)[name] = std::move(value);
}

std::string Json::text() const {
  std::string out;
  write(out, size_t{0});
  return out;
}

std::string Json::line() const {
  std::string out;
  write(out, std::nullopt);
  return out;
}

void Json::write(std::string& out, std::optional<size_t> indent) const {
  const std::optional<size_t> inner = indent ? std::optional(*indent + 2) : std::nullopt;
  if (const bool* truth = std::get_if<bool>(&value_)) {
    out += *truth ? "true" : "false";
  } else if (const int64_t* whole = std::get_if<int64_t>(&value_)) {
    writeNumber(out, *whole);
  } else if (const uint64_t* natural = std::get_if<uint64_t>(&value_)) {
    writeNumber(out, *natural);
  } else if (const double* real = std::get_if<double>(&value_); real != nullptr && std::isfinite(*real)) {
    writeNumber(out, *real);
  } else if (const std::string* text = std::get_if<std::string>(&value_)) {
    writeText(out, *text);
  } else if (const Array* array = std::get_if<Array>(&value_)) {
    out += '[';
    for (size_t i = 0; i < array->size(); ++i) {
      if (i > 0) out += ',';
      newLine(out, inner);
      (*array)[i].write(out, inner);
    }
    if (!array->empty()) newLine(out, indent);
    out += ']';
  } else if (const Object* object = std::get_if<Object>(&value_)) {
    out += '{';
    for (size_t i = 0; i < object->size(); ++i) {
      if (i > 0) out += ',';
      newLine(out, inner);
      writeText(out, (*object)[i].first);
      out += indent ? ": " : ":";
      (*object)[i].second.write(out, inner);
    }
    if (!object->empty()) newLine(out, indent);
    out += '}';
  } else {
    out += "null";
  }
}

Json metresJson(Int3 units) { return {metres(units.x), metres(units.y), metres(units.z)}; }

}  // namespace sgm
