#include "files.h"

#include <cstdio>
#include <filesystem>

#include "godot/variant.h"

namespace sgm_godot {
namespace {

// The engine needs the hash of a static method's signature in addition to its name. These hashes (extension_api.json)
// have not changed since Godot 4.0.
struct StaticMethod {
  const char* name;
  int64_t signature;
};
constexpr StaticMethod kOpen{"open", 1247358404}, kReadBytes{"get_file_as_bytes", 659035735},
    kExists{"file_exists", 2323990056}, kModifiedTime{"get_modified_time", 1597066294};

template <class... Arguments>
Variant callFileAccess(const StaticMethod& method, const Arguments&... arguments) {
  const Name owner("FileAccess"), name(method.name);
  const GDExtensionMethodBindPtr bind = engine().classdb_get_method_bind(owner.get(), name.get(), method.signature);
  if (bind == nullptr) return {};
  const std::array<Variant, sizeof...(Arguments)> values{Variant(arguments)...};
  std::array<const void*, sizeof...(Arguments)> pointers;
  for (size_t i = 0; i < values.size(); ++i) pointers[i] = values[i].raw();
  Variant result;
  GDExtensionCallError error{};
  engine().object_method_bind_call(bind, nullptr, pointers.data(), static_cast<int64_t>(pointers.size()), result.raw(),
                                   &error);
  return result;
}

}  // namespace

bool fileExists(const std::string& path) { return callFileAccess(kExists, path).truth(); }

std::optional<std::string> readFile(const std::string& path) {
  if (!fileExists(path)) return std::nullopt;
  const std::vector<uint8_t> bytes = elements<uint8_t>(callFileAccess(kReadBytes, path));
  return std::string(bytes.begin(), bytes.end());
}

bool writeFile(const std::string& path, const std::string& contents) {
  constexpr int64_t kWrite = 2;
  const std::string unfinished = path + ".tmp";
  {
    const Variant file = callFileAccess(kOpen, unfinished, kWrite);
    if (file.object() == nullptr) return false;
    Packed<uint8_t> bytes(contents.size());
    if (!contents.empty()) std::memcpy(bytes.data(), contents.data(), contents.size());
    file.call("store_buffer", bytes.take());
    const bool written = file.call("get_error").to<int64_t>() == 0;
    file.call("close");
    if (!written) return false;
  }
  return std::rename(systemPath(unfinished).c_str(), systemPath(path).c_str()) == 0;
}

int64_t modifiedTime(const std::string& path) {
  return fileExists(path) ? callFileAccess(kModifiedTime, path).to<int64_t>() : 0;
}

std::string systemPath(const std::string& path) {
  if (path.find("://") == std::string::npos) return path;
  const Name settings("ProjectSettings");
  return Variant(engine().global_get_singleton(settings.get())).call("globalize_path", path).to<std::string>();
}

void makeFolderOf(const std::string& path) {
  const std::filesystem::path folder = std::filesystem::path(systemPath(path)).parent_path();
  std::error_code ignored;
  if (!folder.empty()) std::filesystem::create_directories(folder, ignored);
}

}  // namespace sgm_godot
