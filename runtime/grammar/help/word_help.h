#pragma once
// One-line help for each word of the language, for editors. The manual has details.

#include <string>
#include <string_view>

namespace sgm {

/// Describes a keyword, a clause word, a shape, a function or a value in one line; empty for an unknown word.
std::string_view wordHelp(std::string_view word);

/// Returns the call syntax of a shape or a function: "tube(a, b, r, bend = 0)"; empty for other words. A function with
/// a keyed form, such as rand(key, a, b), has that form on a second line.
std::string callForms(std::string_view word);

}  // namespace sgm
