#pragma once
// Examines JSON from a process in place, since parsed values would need many times its memory.

#include <string>
#include <string_view>
#include <vector>

namespace sgm::service {

/// A member of an object: its name without quotation marks, and its value as raw text.
struct JsonMember {
  std::string_view name, value;
};

/// Whether this is a JSON object that nests at most 16 deep and has at most 64 members, whose names are unique and have
/// no escapes; names in nested objects are free.
bool isSoundObject(std::string_view text);

/// The members of an object, in order, as parts of the text. Empty for other text; for invalid JSON, the result is
/// arbitrary but within the text.
std::vector<JsonMember> membersOf(std::string_view object);

/// A JSON string in quotation marks; invalid UTF-8 is replaced. Objects are assembled as text around it: destructors of
/// the parser's values terminate the program if they run out of memory.
std::string jsonString(std::string_view text);

}  // namespace sgm::service
