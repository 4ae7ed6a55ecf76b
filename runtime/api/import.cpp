#include "api/import.h"

#include <algorithm>
#include <system_error>

#include "base/file_reader.h"
#include "base/plain_text.h"

namespace sgm::api {
namespace fs = std::filesystem;
namespace {

Error ioError(const fs::path& path, const std::string& why) {
  return {Code::io, "cannot read " + path.string() + ": " + why, 0, 0};
}

bool liesIn(const fs::path& folder, const fs::path& file) {
  const auto [end, rest] = std::mismatch(folder.begin(), folder.end(), file.begin(), file.end());
  return end == folder.end() && rest != file.end();
}

}  // namespace

Result<std::string> FolderImports::read(std::string_view path, size_t limit) {
  std::error_code why;
  const fs::path folder = fs::canonical(folder_, why);
  if (why) return ioError(folder_, systemMessage(why));
  const fs::path file = fs::canonical(folder / path, why);
  if (why) return ioError(folder / path, systemMessage(why));
  if (!liesIn(folder, file)) return ioError(folder / path, "the link leaves the grammar's folder");
  if (!fs::is_regular_file(file, why)) return ioError(file, "not a regular file");
  return readFile(file, limit);
}

CallerImports::CallerImports(sgm_import_function function, void* user, const char* folder)
    : function_(function), user_(user) {
  if (folder != nullptr) folder_.emplace(folder);
}

Result<std::string> CallerImports::read(std::string_view path, size_t limit) {
  if (function_ != nullptr) {
    const char* text = nullptr;
    size_t size = 0;
    if (function_(user_, std::string(path).c_str(), &text, &size) != 0) {
      if (text == nullptr && size > 0) return Error{Code::io, "the import callback returned no text", 0, 0};
      if (size > limit) return Error{Code::limit, "larger than " + std::to_string(limit) + " bytes", 0, 0};
      return size == 0 ? std::string() : std::string(text, size);
    }
  }
  if (folder_) return folder_->read(path, limit);
  return Error{Code::io, "no such file", 0, 0};
}

std::string sourceLine(const std::vector<SourceFile>& files, std::string_view file, int line) {
  for (const SourceFile& source : files) {
    if (source.path != file) continue;
    size_t begin = 0;
    for (int i = 1; i < line; ++i) {
      const size_t end = source.text.find('\n', begin);
      if (end == std::string::npos) return "";
      begin = end + 1;
    }
    std::string text = source.text.substr(begin, source.text.find('\n', begin) - begin);
    if (!text.empty() && text.back() == '\r') text.pop_back();
    return text;
  }
  return "";
}

}  // namespace sgm::api
