#include "tools/paper/bundle.h"

#include <fmt/core.h>

#include <algorithm>
#include <iterator>

namespace sgm::cli {
namespace {

using namespace std::string_view_literals;

constexpr BundledFile kFiles[] = {
#include "tools/paper/bundled_files.inc"
};

class BundledImports final : public ImportResolver {
 public:
  explicit BundledImports(std::string_view of) : folder_(of.substr(0, of.rfind('/') + 1)) {}
  Result<std::string> read(std::string_view path, size_t limit) override {
    const BundledFile* file = bundled(folder_ + std::string(path));
    if (file == nullptr) return Error{Code::io, fmt::format("there is no bundled file {}{}", folder_, path)};
    if (file->bytes.size() > limit) return Error{Code::limit, fmt::format("{} is too large", file->path)};
    return std::string(file->bytes);
  }

 private:
  std::string folder_;  // folder of the grammar in the bundle: empty, or with a slash at the end
};

}  // namespace

std::span<const BundledFile> bundledFiles() { return kFiles; }

const BundledFile* bundled(std::string_view path) {
  const auto found = std::ranges::find(kFiles, path, &BundledFile::path);
  return found == std::end(kFiles) ? nullptr : found;
}

CompileResult compileBundled(std::string_view path) {
  BundledImports imports(path);
  CompileOptions options;
  options.resolver = &imports;
  return compileGrammar(bundled(path)->bytes, path, options);
}

}  // namespace sgm::cli
