#pragma once
// Recognizes words of other languages: shaders, OpenSCAD, CGA, Blender, Houdini.

#include <string>
#include <string_view>

namespace sgm {

/// Returns a hint what to write instead of a word of another language: "write `clamp(x, 0, 1)`"; empty if the word is
/// unknown.
std::string hintFor(std::string_view foreign);

}  // namespace sgm
