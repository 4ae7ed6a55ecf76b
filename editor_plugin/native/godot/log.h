#pragma once
// The engine's error list.

#include <string>

namespace sgm_godot {

/// Any thread. With a file ("res://cave.sgm") and a line the editor can show the place.
void logError(const std::string& message, const std::string& file = {}, int line = 0);
/// Where there is no memory for a text.
void logOutOfMemory(const char* what);
void logWarning(const std::string& message, const std::string& file = {}, int line = 0);

}  // namespace sgm_godot
