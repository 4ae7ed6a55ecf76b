#pragma once
// JSON that a process has said, looked at where it stands: what is read into memory as values takes many times its
// size.

#include <string>
#include <string_view>
#include <vector>

namespace sgm::service {

/// Of an object: its name without quotation marks, and the text of its value as it came.
struct JsonMember {
  std::string_view name, value;
};

/// Whether this is a JSON object that nests at most 16 deep and has at most 64 members, each name written without
/// escapes and once; deeper in the text names are free.
bool isSoundObject(std::string_view text);

/// The members of an object, in their order, as parts of the text. Empty for what is no object; of text that is not
/// sound otherwise, anything within it.
std::vector<JsonMember> membersOf(std::string_view object);

/// A string of JSON, in quotation marks; what is no UTF-8 is replaced. Objects are put together as text around it:
/// values of the parser's library end the program where their destructor finds no memory.
std::string jsonString(std::string_view text);

}  // namespace sgm::service
