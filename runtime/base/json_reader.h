#pragma once
// Reads JSON from outside: what a GLB file says of itself. A small reader of our own, so that the core library needs no
// other; strict (RFC 8259), bounded in depth, linear in time and memory.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/result.h"

namespace sgm {

class JsonValue {
 public:
  enum class Kind : unsigned char { null, boolean, number, text, array, object };

  Kind kind = Kind::null;
  double number = 0;  ///< of a boolean 0 or 1
  std::string text;
  std::vector<JsonValue> items;    ///< of an array, or the values of an object
  std::vector<std::string> names;  ///< of an object, as many

  /// A member of an object; null where there is none. Of several with one name, the last.
  const JsonValue* find(std::string_view name) const;
  /// The elements of a member that is an array; none where it is missing or something else.
  std::span<const JsonValue> list(std::string_view name) const;
  /// A member that is a whole number from 0 to 2^53; nothing where it is missing or something else.
  std::optional<size_t> count(std::string_view name) const;
  /// Itself as a whole number from 0 to 2^53; nullopt if it is something else.
  std::optional<size_t> whole() const;
};

/// A value takes some hundred bytes of memory, and may take two of text. Errors: bad_input, with the byte in the
/// message; limit, for more than `most_values`.
Result<JsonValue> readJson(std::string_view text, size_t most_values = SIZE_MAX);

}  // namespace sgm
