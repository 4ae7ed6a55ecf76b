#include "grammar/parse/imports.h"

#include <algorithm>
#include <map>
#include <optional>

#include "grammar/parse/assets.h"
#include "grammar/parse/parse_module.h"
#include "grammar/std/std_library.h"
#include "grammar/text/codes.h"

namespace sgm {

namespace {

constexpr size_t kLongestPath = 255;

bool pathChar(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' ||
         c == '.' || c == '/' || c == ' ' || (static_cast<unsigned char>(c) & 0x80) != 0;
}

class Loader {
 public:
  Loader(Program& program, NameTable& names, const CompileOptions& options, DiagnosticSink& sink,
         std::vector<SourceFile>& files)
      : program_(program), names_(names), options_(options), sink_(sink), files_(files) {}

  std::vector<ModuleSyntax> run() {
    modules_.emplace(std::string(), 0);
    total_ = program_.modules[0].text.size();
    parse(0);
    // syntax_ grows during this loop. A loop instead of recursion keeps the stack bounded for untrusted text.
    for (uint32_t m = 0; m < syntax_.size() && !sink_.full(); ++m)
      for (size_t i = 0; i < syntax_[m].imports.size(); ++i) {
        const ImportDecl import = syntax_[m].imports[i];
        if (isAssetPath(program_.text(import.path))) {
          const uint32_t asset = loadAsset(m, import);
          syntax_[m].imports[i].asset = asset;
          continue;
        }
        const uint32_t module = load(m, import);
        syntax_[m].imports[i].module = module;
      }
    findCycles();
    return std::move(syntax_);
  }

 private:
  void parse(uint32_t module) { syntax_.push_back(parseModule(program_, names_, module, options_.limits, sink_)); }

  bool pathIsGood(const ImportDecl& import) {
    const std::string complaint = importPathProblem(program_.text(import.path));
    if (!complaint.empty())
      sink_.error(import.path_span, codes::kImportPath, complaint,
                  "imports are relative: \"std/rock.sgm\", \"parts/arch.sgm\"");
    return complaint.empty();
  }

  /// Reads a file that is not in the standard library. left: how many bytes may still be read. most, most_of_all: the
  /// limits for one file, and for all files of its kind, for messages. nullopt after reporting an error.
  std::optional<std::string> read(const std::string& path, const ImportDecl& import, size_t left, size_t most,
                                  size_t most_of_all) {
    if (options_.resolver == nullptr) {
      sink_.error(import.path_span, codes::kImportMissing,
                  join({"cannot import `", path, "`: there is no folder to read from"}),
                  "only the standard library can be imported here: \"std/rock.sgm\"");
      return std::nullopt;
    }
    Result<std::string> bytes = options_.resolver->read(path, left);
    if (bytes ? bytes->size() > left : bytes.error().code == Code::limit) {
      sink_.error(import.path_span, codes::kImportLimit, join({"`", path, "` is too long"}),
                  join({"a file has at most ", std::to_string(most), " bytes, and all files together at most ",
                        std::to_string(most_of_all)}));
      return std::nullopt;
    }
    if (!bytes) {
      sink_.error(import.path_span, codes::kImportMissing,
                  join({"cannot import `", path, "`: ", bytes.error().message}),
                  "a path is relative to the folder of the file that imports it");
      return std::nullopt;
    }
    return std::move(*bytes);
  }

  /// The path to which a file's imports are relative.
  std::string_view pathOf(uint32_t module) const {
    return module == 0 ? std::string_view() : std::string_view(program_.modules[module].path);
  }

  uint32_t loadAsset(uint32_t from, const ImportDecl& import) {
    const CompileLimits& limits = options_.limits;
    if (!pathIsGood(import)) return kNoId;
    const std::string path = importedPath(pathOf(from), program_.text(import.path));
    const auto known = assets_.find(path);
    if (known != assets_.end()) return known->second;
    if (program_.assets.size() >= limits.files) {
      sink_.error(import.path_span, codes::kImportLimit,
                  join({"the program imports more than ", std::to_string(limits.files), " assets"}),
                  "combine some of them");
      return kNoId;
    }
    const size_t left = std::min(limits.asset_bytes, limits.total_asset_bytes - asset_bytes_);
    const auto bytes = read(path, import, left, limits.asset_bytes, limits.total_asset_bytes);
    if (!bytes) return kNoId;
    asset_bytes_ += bytes->size();
    const std::optional<uint32_t> asset = addAsset(program_, path, *bytes, import.path_span, sink_);
    if (!asset) return kNoId;
    assets_.emplace(path, *asset);
    return *asset;
  }

  uint32_t load(uint32_t from, const ImportDecl& import) {
    const CompileLimits& limits = options_.limits;
    if (!pathIsGood(import)) return kNoId;
    const std::string written(program_.text(import.path));
    const bool inside_std = program_.modules[from].path.starts_with("std/") && from != 0;
    const bool standard = written.starts_with("std/") || inside_std;
    const std::string path =
        standard ? (written.starts_with("std/") ? written : "std/" + written) : importedPath(pathOf(from), written);
    const auto known = modules_.find(path);
    if (known != modules_.end()) return known->second;
    if (program_.modules.size() >= limits.files) {
      sink_.error(import.path_span, codes::kImportLimit,
                  join({"the program imports more than ", std::to_string(limits.files), " files"}),
                  "combine some of them");
      return kNoId;
    }
    if (depth_[from] + 1 > limits.import_depth) {
      sink_.error(import.path_span, codes::kImportLimit,
                  join({"imports are nested more than ", std::to_string(limits.import_depth), " deep"}),
                  "combine some of the files");
      return kNoId;
    }
    std::string text;
    if (standard) {
      text = standardModule(path);
      if (text.empty()) {
        Suggestion suggestion(path);
        std::string all;
        for (const StdFile& file : stdLibrary()) {
          suggestion.offer(file.path);
          all += join({all.empty() ? "it has " : ", ", file.path});
        }
        sink_.error(import.path_span, codes::kImportMissing, join({"the standard library has no `", path, "`"}),
                    suggestion.hintOr(all));
        return kNoId;
      }
    } else {
      const size_t left = std::min(limits.text_bytes, limits.total_bytes - std::min(limits.total_bytes, total_));
      std::optional<std::string> bytes = read(path, import, left, limits.text_bytes, limits.total_bytes);
      if (!bytes) return kNoId;
      text = std::move(*bytes);
    }
    total_ += text.size();
    const uint32_t module = static_cast<uint32_t>(program_.modules.size());
    program_.modules.emplace_back(program_.modules.get_allocator().resource());
    program_.modules.back().path = path;
    program_.modules.back().text = text;
    sink_.addFile(path);
    files_.push_back({path, std::move(text)});
    modules_.emplace(path, module);
    depth_.push_back(depth_[from] + 1);
    parse(module);
    return module;
  }

  /// Depth-first search without recursion; reports the import that closes a cycle.
  void findCycles() {
    enum class Mark : uint8_t { fresh, open, done };
    std::vector<Mark> marks(syntax_.size(), Mark::fresh);
    std::vector<std::pair<uint32_t, size_t>> stack;
    if (syntax_.empty()) return;
    stack.emplace_back(0, 0);
    marks[0] = Mark::open;
    while (!stack.empty()) {
      auto& [module, next] = stack.back();
      if (next == syntax_[module].imports.size()) {
        marks[module] = Mark::done;
        stack.pop_back();
        continue;
      }
      const ImportDecl& import = syntax_[module].imports[next++];
      if (import.module == kNoId || import.module >= marks.size()) continue;
      if (marks[import.module] == Mark::open)
        sink_.error(import.path_span, codes::kImportCycle,
                    join({"`", program_.text(import.path), "` imports itself in a circle"}),
                    "move what both files need into a third");
      else if (marks[import.module] == Mark::fresh) {
        marks[import.module] = Mark::open;
        stack.emplace_back(import.module, 0);
      }
    }
  }

  Program& program_;
  NameTable& names_;
  const CompileOptions& options_;
  DiagnosticSink& sink_;
  std::vector<SourceFile>& files_;
  std::vector<ModuleSyntax> syntax_;
  std::map<std::string, uint32_t, std::less<>> modules_;
  std::vector<uint32_t> depth_{0};
  size_t total_ = 0;
  std::map<std::string, uint32_t, std::less<>> assets_;
  size_t asset_bytes_ = 0;
};

}  // namespace

std::string importPathProblem(std::string_view path) {
  if (path.empty()) return "the import has no path";
  if (path.size() > kLongestPath) return "the path is too long";
  if (path.front() == '/' || path.find('\\') != std::string_view::npos || path.find(':') != std::string_view::npos)
    return "an import is a relative path with forward slashes";
  if (!std::all_of(path.begin(), path.end(), pathChar)) return "the path has a character that is not allowed";
  std::string_view rest = path;
  while (true) {
    const size_t slash = rest.find('/');
    const std::string_view part = rest.substr(0, slash);
    if (part == "..") return "an import may not leave the folder of the root file";
    if (part.empty() || part == "." || part.back() == '.' || part.back() == ' ')
      return "a part of the path is not a name";
    if (slash == std::string_view::npos) break;
    rest.remove_prefix(slash + 1);
  }
  if (!(path.ends_with(".sgm") || isAssetPath(path)) || rest == ".sgm" || rest == ".glb")
    return "an import ends in .sgm, or an asset in .glb";
  return {};
}

bool isAssetPath(std::string_view path) { return path.ends_with(".glb"); }

std::string importedPath(std::string_view from, std::string_view import) {
  const size_t slash = from.rfind('/');
  return slash == std::string_view::npos ? std::string(import) : join({from.substr(0, slash + 1), import});
}

std::vector<ModuleSyntax> loadModules(Program& program, NameTable& names, const CompileOptions& options,
                                      DiagnosticSink& sink, std::vector<SourceFile>& files) {
  return Loader(program, names, options, sink, files).run();
}

}  // namespace sgm
