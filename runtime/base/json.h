#pragma once
// Writes JSON for the command's option --json. This is a small writer of our own, because the command only writes JSON,
// and a large library would take longer to compile than the rest of the command.

#include <concepts>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "base/fixed.h"

namespace sgm {

/// A JSON value. A brace list makes an object if it contains only pairs that begin with a string, as {{"a", 1}, {"b",
/// 2}} does, and an array otherwise. Objects keep the order in which members were added.
class Json {
  using Array = std::vector<Json>;
  using Object = std::vector<std::pair<std::string, Json>>;

 public:
  Json() = default;
  Json(std::nullptr_t) {}
  Json(bool value) : value_(value) {}
  template <std::signed_integral T>
  Json(T value) : value_(static_cast<int64_t>(value)) {}
  template <std::unsigned_integral T>
  requires(!std::same_as<T, bool>) Json(T value) : value_(static_cast<uint64_t>(value)) {}
  template <std::floating_point T>
  Json(T value) : value_(static_cast<double>(value)) {}
  template <class T>
  requires std::convertible_to<const T&, std::string_view> Json(const T& text)
      : value_(std::string(std::string_view(text))) {}
  template <class T>
  Json(const std::vector<T>& values) : value_(Array(values.begin(), values.end())) {}
  Json(std::initializer_list<Json> values);

  static Json array();
  static Json object();

  /// Returns the named member of an object, and adds it if it is missing. A null value becomes an object first.
  Json& operator[](std::string_view key);
  /// Appends a value to this array. A null value becomes an array first.
  void push_back(Json value);
  /// Copies all members of `object` into this object; members of the same name are replaced.
  void update(Json object);

  /// Serialises the value on several lines, indented by two spaces. The text is always valid UTF-8: U+FFFD replaces
  /// invalid bytes. NaN and infinity become null.
  std::string text() const;
  /// Serialises the value on one line, without spaces; otherwise same as text().
  std::string line() const;

 private:
  /// Appends the serialised value. indent: current indentation in spaces; nullopt writes everything on one line.
  void write(std::string& out, std::optional<size_t> indent) const;

  std::variant<std::nullptr_t, bool, int64_t, uint64_t, double, std::string, Array, Object> value_;
};

/// [x, y, z] in metres.
Json metresJson(Int3 units);

}  // namespace sgm
