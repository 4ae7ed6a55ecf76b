#pragma once
// One line for each word of the language, for editors. The manual says more.

#include <string>
#include <string_view>

namespace sgm {

/// What a keyword, a clause word, a shape, a function or a value is, in a line; empty for other words.
std::string_view wordHelp(std::string_view word);

/// How a shape or a function is called: "tube(a, b, r, bend = 0)"; empty for other words. Of two forms of a function
/// the one with a key is on a second line.
std::string callForms(std::string_view word);

}  // namespace sgm
