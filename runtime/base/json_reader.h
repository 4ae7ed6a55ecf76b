#pragma once
// Parses JSON from outside, such as the header of a GLB file. This is a small parser of our own, so that the core
// library depends on no JSON library. The parser is strict (RFC 8259), limits the nesting depth, and takes linear time
// and memory.

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
  double number = 0;  ///< value of a number; for a boolean, 0 or 1
  std::string text;
  std::vector<JsonValue> items;    ///< elements of an array; for an object, the values of its members
  std::vector<std::string> names;  ///< names of an object's members, parallel to `items`

  /// Returns the value of the named member of an object; null if it is missing. If several members have the name,
  /// returns the last one.
  const JsonValue* find(std::string_view name) const;
  /// Returns the elements of a member that is an array; empty if the member is missing or of another type.
  std::span<const JsonValue> list(std::string_view name) const;
  /// Returns a member that is a whole number from 0 to 2^53; nullopt if it is missing or any other value.
  std::optional<size_t> count(std::string_view name) const;
  /// Returns this value if it is a whole number from 0 to 2^53, otherwise nullopt.
  std::optional<size_t> whole() const;
};

/// Parses the text of one JSON value. A parsed value takes about 100 bytes of memory, though its text may be only two
/// bytes long; `max_values` therefore limits the number of values. Errors: bad_input, with the byte offset in the
/// message; limit if there are more than `max_values` values.
Result<JsonValue> readJson(std::string_view text, size_t max_values = SIZE_MAX);

}  // namespace sgm
