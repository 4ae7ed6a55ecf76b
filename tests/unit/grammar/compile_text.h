#pragma once
// Functions with which a test compiles a text in a single call.

#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <string_view>

#include "grammar/compile.h"
#include "grammar/text/codes.h"

namespace sgm::test {

/// Resolves imports to files in memory.
class MapResolver : public ImportResolver {
 public:
  std::map<std::string, std::string, std::less<>> files;
  int reads = 0;

  Result<std::string> read(std::string_view path, size_t limit) override {
    ++reads;
    const auto found = files.find(path);
    if (found == files.end()) return Error{Code::io, "no such file"};
    if (found->second.size() > limit) return Error{Code::limit, "too long"};
    return found->second;
  }
};

inline CompileResult compileText(std::string_view text, ImportResolver* resolver = nullptr) {
  CompileOptions options;
  options.resolver = resolver;
  return compileGrammar(text, "test.sgm", options);
}

/// Resolves imports to files in a folder.
class FolderResolver : public ImportResolver {
 public:
  explicit FolderResolver(std::filesystem::path folder) : folder_(std::move(folder)) {}

  Result<std::string> read(std::string_view path, size_t) override {
    std::ifstream file(folder_ / path, std::ios::binary);
    if (!file) return Error{Code::io, "no such file"};
    std::stringstream bytes;
    bytes << file.rdbuf();
    return bytes.str();
  }

 private:
  std::filesystem::path folder_;
};

/// All diagnostics in short form, such as "3:17 unit-mismatch; 4:1 syntax". Unless `unused`, omits diagnostics about
/// unused names, which are frequent in texts with a common beginning.
inline std::string brief(const std::vector<Diagnostic>& diagnostics, bool unused = false) {
  std::string out;
  for (const Diagnostic& d : diagnostics) {
    if (d.code == codes::kUnusedValue && !unused) continue;
    if (!out.empty()) out += "; ";
    out += std::to_string(d.line);
    out += ':';
    out += std::to_string(d.column);
    out += ' ';
    out += d.code;
  }
  return out;
}

}  // namespace sgm::test
