#pragma once
// Examines JSON from a process in place, since parsed values would need many times the memory of the text.

#include <string>
#include <string_view>
#include <vector>

namespace sgm::service {

/// A member of an object: its name without quotation marks, and the JSON text of its value.
struct JsonMember {
  std::string_view name, value;
};

/// Whether the text is a JSON object that nests at most 16 deep and has at most 64 members, whose names are unique and
/// have no escapes. Names in nested objects are not checked.
bool isSoundObject(std::string_view text);

/// The members of an object, in order, as parts of the text. Empty if the text is not an object. For invalid JSON the
/// result is arbitrary, but its parts lie within the text.
std::vector<JsonMember> membersOf(std::string_view object);

/// Encodes a text as a JSON string with quotation marks; invalid UTF-8 is replaced. Objects are assembled as text from
/// such strings, because the destructors of the JSON library's values terminate the program if memory runs out.
std::string jsonString(std::string_view text);

}  // namespace sgm::service
