#pragma once
// Words of other languages: shaders, OpenSCAD, CGA, Blender, Houdini.

#include <string>
#include <string_view>

namespace sgm {

/// What to write here instead of a word of another language: "write `clamp(x, 0, 1)`"; empty if the word is unknown.
std::string hintFor(std::string_view foreign);

}  // namespace sgm
