#pragma once
// Reads JSON from outside, such as the header of a GLB file. This is a small reader of our own, so that the core
// library depends on no JSON library. It is strict (RFC 8259), limits the depth, and is linear in time and memory.

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
  double number = 0;  ///< the value of a number; 0 or 1 for a boolean
  std::string text;
  std::vector<JsonValue> items;    ///< elements of an array, or values of an object
  std::vector<std::string> names;  ///< names of the values of an object

  /// The value of the named member of an object; null if it is missing. If several members have the name, the last one
  /// counts.
  const JsonValue* find(std::string_view name) const;
  /// The elements of a member that is an array; empty if it is missing or of another type.
  std::span<const JsonValue> list(std::string_view name) const;
  /// A member that is a whole number from 0 to 2^53; nullopt if it is missing or another value.
  std::optional<size_t> count(std::string_view name) const;
  /// This value as a whole number from 0 to 2^53; nullopt if it is another value.
  std::optional<size_t> whole() const;
};

/// Parses the text of one JSON value. A value takes about 100 bytes of memory, but may take only two bytes of text;
/// `max_values` therefore limits the number of values.
/// Errors: bad_input, with the byte offset in the message; limit for more than `max_values`.
Result<JsonValue> readJson(std::string_view text, size_t max_values = SIZE_MAX);

}  // namespace sgm
