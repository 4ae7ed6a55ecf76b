#pragma once
// Files by the engine's own paths: res://, also inside an exported game's package, and user://.

#include <optional>
#include <string>

namespace sgm_godot {

std::optional<std::string> readFile(const std::string& path);
/// Replaces the file as a whole or leaves it as it was. Returns whether it did.
bool writeFile(const std::string& path, const std::string& contents);
bool fileExists(const std::string& path);
/// Seconds since 1970; 0 where there is no file.
int64_t modifiedTime(const std::string& path);
/// The path for the operating system; as it is where it already is one.
std::string systemPath(const std::string& path);
/// Makes the folder that a file is to lie in. Where it cannot, who makes the file will say so.
void makeFolderOf(const std::string& path);

}  // namespace sgm_godot
