#pragma once
// Accesses files by the engine's paths: res://, also within the package of an exported game, and user://.

#include <optional>
#include <string>

namespace sgm_godot {

std::optional<std::string> readFile(const std::string& path);
/// Replaces the whole file. On failure, leaves the file unchanged and returns false.
bool writeFile(const std::string& path, const std::string& contents);
bool fileExists(const std::string& path);
/// Time of the last change in seconds since 1970; 0 if the file does not exist.
int64_t modifiedTime(const std::string& path);
/// Converts an engine path to a path of the operating system. A path of the operating system is returned unchanged.
std::string systemPath(const std::string& path);
/// Makes the folder of a file. Failures are not reported, since creating the file will then fail and report them.
void makeFolderOf(const std::string& path);

}  // namespace sgm_godot
