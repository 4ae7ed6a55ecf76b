#pragma once
// Examines the JSON text from a process without parsing it into values, which would need many times the memory.

#include <string>
#include <string_view>
#include <vector>

namespace sgm::service {

/// A member of a JSON object: its name without quotation marks, and the text of its value.
struct JsonMember {
  std::string_view name, value;
};

/// Whether the text is a JSON object nested at most 16 deep, with at most 64 members of unique names without escapes.
/// Names in nested objects are not checked.
bool isSoundObject(std::string_view text);

/// The members of a JSON object in order, as parts of its text; empty if the text is not an object. For invalid JSON
/// the result is arbitrary, but its parts lie within the text.
std::vector<JsonMember> membersOf(std::string_view object);

/// The text as a JSON string in quotation marks; invalid UTF-8 is replaced. JSON objects are assembled from such
/// strings, because the destructor of nlohmann::json terminates the program if memory runs out.
std::string jsonString(std::string_view text);

}  // namespace sgm::service
