#include "grammar_files.h"

#include "files.h"
#include "godot/class_binder.h"
#include "godot/error.h"
#include "grammar.h"
#include "plugin.h"

namespace sgm_godot {
namespace {

constexpr std::string_view kEnding = ".sgm";

bool isGrammar(const std::string& path) {
  return path.size() > kEnding.size() && path.compare(path.size() - kEnding.size(), kEnding.size(), kEnding) == 0;
}

/// Returns the paths of all files that the text imports by lines `import "path" as name;`. Files of the built-in
/// library are left out.
std::vector<std::string> importsOf(const std::string& text) {
  std::vector<std::string> found;
  for (size_t line = 0; line < text.size();) {
    const size_t end = std::min(text.find('\n', line), text.size());
    const size_t word = text.find_first_not_of(" \t", line);
    if (word < end && text.compare(word, 7, "import ") == 0) {
      const size_t open = text.find('"', word), close = open < end ? text.find('"', open + 1) : end;
      if (close < end && text.compare(open + 1, 4, "std/") != 0)
        found.push_back(text.substr(open + 1, close - open - 1));
    }
    line = end + 1;
  }
  return found;
}

}  // namespace

Strings GrammarLoader::extensions() const { return {strings({"sgm"})}; }
bool GrammarLoader::handles(const NameText& type) const { return type.text == "SgmGrammar" || type.text == "Resource"; }
std::string GrammarLoader::typeOf(const std::string& path) const { return isGrammar(path) ? "SgmGrammar" : ""; }

bool GrammarLoader::exists(const std::string& path) const { return !plugin().files_are_text && fileExists(path); }

// The files that a grammar imports, so that an export includes them.
Strings GrammarLoader::dependencies(const std::string& path, bool) const {
  const std::optional<std::string> text = readFile(path);
  std::vector<std::string> paths;
  if (text) {
    for (const std::string& import : importsOf(*text)) paths.push_back(path.substr(0, path.rfind('/') + 1) + import);
  }
  return {strings(paths)};
}

Variant GrammarLoader::load(const std::string& path, const std::string&, bool, int64_t) const {
  const Name name("SgmGrammar");
  Variant made(engine().classdb_construct_object(name.get()));
  auto* grammar = instanceOf<Grammar>(made);
  if (grammar == nullptr || !grammar->load(path)) {
    logError("the grammar '" + path + "' cannot be read");
    return kErrorFileCannotOpen;
  }
  return made;  // a grammar with errors is returned too: it reports the errors, and the user can correct it
}

void GrammarLoader::registerClass(ClassRecord& record) {
  record.name = "SgmGrammarLoader";
  record.parent = "ResourceFormatLoader";
  ClassBinder::override_<&GrammarLoader::extensions>(record, "_get_recognized_extensions");
  ClassBinder::override_<&GrammarLoader::handles>(record, "_handles_type");
  ClassBinder::override_<&GrammarLoader::typeOf>(record, "_get_resource_type");
  ClassBinder::override_<&GrammarLoader::exists>(record, "_exists");
  ClassBinder::override_<&GrammarLoader::dependencies>(record, "_get_dependencies");
  ClassBinder::override_<&GrammarLoader::load>(record, "_load");
  ClassBinder::add<GrammarLoader>(record, false);
}

bool GrammarSaver::recognises(Object resource) const { return instanceOf<Grammar>(resource) != nullptr; }
Strings GrammarSaver::extensions(Object resource) const {
  return {recognises(resource) ? strings({"sgm"}) : strings({})};
}

int64_t GrammarSaver::save(Object resource, const std::string& path, int64_t) const {
  const auto* grammar = instanceOf<Grammar>(resource);
  if (grammar == nullptr) return kErrorInvalidParameter;
  if (writeFile(path, grammar->text())) return 0;
  logError("the grammar cannot be written to '" + path + "'; the file is as it was");
  return kErrorFileCannotWrite;
}

void GrammarSaver::registerClass(ClassRecord& record) {
  record.name = "SgmGrammarSaver";
  record.parent = "ResourceFormatSaver";
  ClassBinder::override_<&GrammarSaver::recognises>(record, "_recognize");
  ClassBinder::override_<&GrammarSaver::extensions>(record, "_get_recognized_extensions");
  ClassBinder::override_<&GrammarSaver::save>(record, "_save");
  ClassBinder::add<GrammarSaver>(record, false);
}

}  // namespace sgm_godot
