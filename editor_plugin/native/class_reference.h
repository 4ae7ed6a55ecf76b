#pragma once
// The class reference that the editor's help shows: native/doc/*.xml, part of the library.

#include <span>
#include <string_view>

namespace sgm_godot {

/// A text for each class, in the engine's XML format.
std::span<const std::string_view> classReference();

}  // namespace sgm_godot
