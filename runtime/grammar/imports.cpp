#include "grammar/imports.h"

#include <algorithm>
#include <map>

#include "grammar/codes.h"
#include "grammar/std_library.h"

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
    // A list that grows while it is walked: no recursion, whatever the text says.
    for (uint32_t m = 0; m < syntax_.size() && !sink_.full(); ++m)
      for (size_t i = 0; i < syntax_[m].imports.size(); ++i) {
        const ImportDecl import = syntax_[m].imports[i];
        const uint32_t module = load(m, import);
        syntax_[m].imports[i].module = module;
      }
    findCycles();
    return std::move(syntax_);
  }

 private:
  void parse(uint32_t module) { syntax_.push_back(Parser(program_, names_, module, options_.limits, sink_).run()); }

  uint32_t load(uint32_t from, const ImportDecl& import) {
    const CompileLimits& limits = options_.limits;
    const std::string written(program_.text(import.path));
    const std::string complaint = importPathComplaint(written);
    if (!complaint.empty()) {
      sink_.error(import.path_span, codes::kImportPath, complaint,
                  "imports are relative: \"std/rock.sgm\", \"parts/arch.sgm\"");
      return kNoId;
    }
    const bool inside_std = program_.modules[from].path.starts_with("std/") && from != 0;
    const bool standard = written.starts_with("std/") || inside_std;
    const std::string path =
        standard ? (written.starts_with("std/") ? written : "std/" + written)
                 : importedPath(from == 0 ? "" : std::string_view(program_.modules[from].path), written);
    const auto known = modules_.find(path);
    if (known != modules_.end()) return known->second;
    if (program_.modules.size() >= limits.files) {
      sink_.error(import.path_span, codes::kImportLimit, join({"more than ", std::to_string(limits.files), " files"}),
                  "put some of them together");
      return kNoId;
    }
    if (depth_[from] + 1 > limits.import_depth) {
      sink_.error(import.path_span, codes::kImportLimit,
                  join({"imports go more than ", std::to_string(limits.import_depth), " deep"}),
                  "put some of the files together");
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
      if (options_.resolver == nullptr) {
        sink_.error(import.path_span, codes::kImportMissing,
                    join({"cannot import `", path, "`: no folder to read from"}),
                    "only the standard library can be imported here: \"std/rock.sgm\"");
        return kNoId;
      }
      const size_t left = std::min(limits.text_bytes, limits.total_bytes - std::min(limits.total_bytes, total_));
      Result<std::string> read = options_.resolver->read(path, left);
      const bool too_long = read ? read->size() > left : read.error().code == Code::limit;
      if (too_long) {
        sink_.error(import.path_span, codes::kImportLimit, join({"`", path, "` is too long"}),
                    join({"a file has at most ", std::to_string(limits.text_bytes), " bytes, all together ",
                          std::to_string(limits.total_bytes)}));
        return kNoId;
      }
      if (!read) {
        sink_.error(import.path_span, codes::kImportMissing,
                    join({"cannot import `", path, "`: ", read.error().message}),
                    "a path starts at the folder of the file that imports");
        return kNoId;
      }
      text = std::move(*read);
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

  /// Depth first without recursion; the import that closes a cycle is reported.
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
};

}  // namespace

std::string importPathComplaint(std::string_view path) {
  if (path.empty()) return "an import without a path";
  if (path.size() > kLongestPath) return "the path is too long";
  if (path.front() == '/' || path.find('\\') != std::string_view::npos || path.find(':') != std::string_view::npos)
    return "an import is a relative path with forward slashes";
  if (!std::all_of(path.begin(), path.end(), pathChar)) return "a character that a path may not have";
  std::string_view rest = path;
  while (true) {
    const size_t slash = rest.find('/');
    const std::string_view part = rest.substr(0, slash);
    if (part == "..") return "an import may not leave the folder of the root file";
    if (part.empty() || part == "." || part.back() == '.' || part.back() == ' ')
      return "a part of the path that is no name";
    if (slash == std::string_view::npos) break;
    rest.remove_prefix(slash + 1);
  }
  if (!path.ends_with(".sgm") || rest == ".sgm") return "an import ends in .sgm";
  return {};
}

std::string importedPath(std::string_view from, std::string_view import) {
  const size_t slash = from.rfind('/');
  return slash == std::string_view::npos ? std::string(import) : join({from.substr(0, slash + 1), import});
}

std::string_view standardModule(std::string_view path) {
  for (const StdFile& file : stdLibrary())
    if (file.path == path) return file.text;
  return {};
}

std::vector<ModuleSyntax> loadModules(Program& program, NameTable& names, const CompileOptions& options,
                                      DiagnosticSink& sink, std::vector<SourceFile>& files) {
  return Loader(program, names, options, sink, files).run();
}

}  // namespace sgm
