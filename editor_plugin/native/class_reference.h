#pragma once
// The class reference that the editor's help shows. The files native/doc/*.xml are embedded in the library.

#include <span>
#include <string_view>

namespace sgm_godot {

/// The texts of the reference, one for each class, in the engine's XML format.
std::span<const std::string_view> classReference();

}  // namespace sgm_godot
