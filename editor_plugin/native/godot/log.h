#pragma once
// Writes to the engine's error log.

#include <string>

namespace sgm_godot {

/// Thread-safe. If a file ("res://cave.sgm") and a line are given, the editor can show that line.
void logError(const std::string& message, const std::string& file = {}, int line = 0);
/// Logs that memory ran out, without allocating memory.
void logOutOfMemory(const char* what);
void logWarning(const std::string& message, const std::string& file = {}, int line = 0);

}  // namespace sgm_godot
