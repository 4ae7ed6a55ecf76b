#include "grammar.h"

#include <deque>

#include "files.h"
#include "godot/class_binder.h"
#include "godot/error.h"
#include "plugin.h"

namespace sgm_godot {
namespace {

/// Reads imported files through the engine, so that they are also found in an exported package.
struct Imports {
  std::string folder;
  // The compiler keeps pointers to the texts, so they must not move until the grammar is compiled.
  std::deque<std::string> texts;
};

int32_t readImport(void* user, const char* path, const char** text, size_t* size) {
  auto& imports = *static_cast<Imports*>(user);
  std::optional<std::string> contents = readFile(imports.folder + "/" + path);
  if (!contents) return 0;
  imports.texts.push_back(std::move(*contents));
  *text = imports.texts.back().data();
  *size = imports.texts.back().size();
  return 1;
}

std::string folderOf(const std::string& path) {
  const size_t slash = path.rfind('/');
  if (slash == std::string::npos) return "res://";
  // For "res://cave.sgm" the folder is "res:/". This is correct, because a "/" and a name are appended later.
  return path.substr(0, slash);
}

Strings named(uint32_t count, const sgm_grammar* grammar, const char* (*name)(const sgm_grammar*, uint32_t)) {
  std::vector<std::string> names;
  for (uint32_t i = 0; i < count; ++i) names.emplace_back(name(grammar, i));
  return {strings(names)};
}

const char* nameOf(sgm_quantity quantity) {
  switch (quantity) {
    case SGM_QUANTITY_LENGTH:
      return "length";
    case SGM_QUANTITY_ANGLE:
      return "angle";
    case SGM_QUANTITY_NUMBER:
      return "number";
    default:
      return "other";
  }
}

}  // namespace

Grammar::Compilation Grammar::compile(const std::string& text) const {
  const std::string place = path();
  Imports imports{folderOf(place), {}};
  const std::string name = place.empty() ? "grammar" : place;
  sgm_grammar_desc desc = SGM_GRAMMAR_DESC_INIT;
  desc.text = text.data();
  desc.text_size = text.size();
  desc.name = name.c_str();
  desc.import_text = readImport;
  desc.import_user = &imports;
  sgm_grammar* grammar = nullptr;
  sgm_diagnostics* raw = nullptr;
  sgm_error error = SGM_ERROR_INIT;
  const sgm_result result = sgm_grammar_compile(plugin().runtime, &desc, &grammar, &raw, &error);
  const DiagnosticsOwner list(raw);
  Compilation made;
  if (grammar != nullptr) made.grammar = GrammarOwner(grammar, EndWith<sgm_grammar_destroy>());
  for (uint32_t i = 0; i < sgm_diagnostics_count(list.get()); ++i) {
    sgm_diagnostic d = SGM_DIAGNOSTIC_INIT;
    if (sgm_diagnostics_get(list.get(), i, &d) != SGM_OK) continue;
    made.diagnostics.push_back(
        {d.severity == SGM_LOG_ERROR, d.line, d.column, d.length, d.file, d.message, d.hint, d.source_line});
  }
  if (result < SGM_OK && made.diagnostics.empty()) {
    made.diagnostics.push_back({true, error.line, error.column, 1, name, error.message, "", ""});
  }
  return made;
}

void Grammar::adopt(const std::string& text) {
  text_ = text;
  Compilation made = compile(text);
  diagnostics_ = std::move(made.diagnostics);
  valid_ = made.grammar != nullptr;
  if (valid_) {
    compiled_ = std::move(made.grammar);
    ++version_;
  }
  for (const Diagnostic& d : diagnostics_) {
    const std::string message = d.file + ":" + std::to_string(d.line) + ":" + std::to_string(d.column) + ": " +
                                d.message + (d.hint.empty() ? "" : " (" + d.hint + ")");
    d.error ? logError(message, d.file, d.line) : logWarning(message, d.file, d.line);
  }
  own("emit_changed");
}

void Grammar::setText(const std::string& text) {
  if (text != text_ || version_ == 0) adopt(text);
}

bool Grammar::load(const std::string& path) {
  const int64_t time = modifiedTime(path);
  const std::optional<std::string> text = readFile(path);
  if (!text) return false;
  file_ = path;
  file_time_ = time;
  adopt(*text);
  return true;
}

bool Grammar::followFile() {
  const std::string file = path();
  if (file.find("://") == std::string::npos || file.find("::") != std::string::npos) return false;
  const int64_t time = modifiedTime(file);
  if (time == 0 || time == file_time_) return false;
  return reload() != kErrorFileCannotOpen;
}

int64_t Grammar::reload() {
  const std::string file = path();
  const std::string before = text_;
  const int64_t time = modifiedTime(file);
  const std::optional<std::string> text = file.empty() ? std::nullopt : readFile(file);
  if (!text) {
    logError("the grammar's file '" + file + "' cannot be read; it goes on as it was");
    return kErrorFileCannotOpen;
  }
  file_time_ = time;
  // keeps this object alive: a listener of the signal may release the last other reference to it
  const Variant kept(self());
  adopt(*text);  // compile even an unchanged text again, because the files that it imports may have changed
  return valid_ ? kOk : kErrorParse;
}

std::string Grammar::path() const {
  const std::string set = own("get_path").to<std::string>();
  return set.empty() ? file_ : set;
}

std::string Grammar::errorText() const {
  for (const Diagnostic& d : diagnostics_) {
    if (d.error) return d.file + ":" + std::to_string(d.line) + ":" + std::to_string(d.column) + ": " + d.message;
  }
  return {};
}

Array Grammar::listed(const std::vector<Diagnostic>& diagnostics) {
  Array list;
  for (const Diagnostic& d : diagnostics) {
    Variant entry = Variant::dictionary();
    entry.set("severity", d.error ? "error" : "warning");
    entry.set("file", d.file);
    entry.set("line", d.line);
    entry.set("column", d.column);
    entry.set("length", d.length);
    entry.set("message", d.message);
    entry.set("hint", d.hint);
    entry.set("source_line", d.source_line);
    list.value.append(entry);
  }
  return list;
}

Array Grammar::diagnostics() const { return listed(diagnostics_); }
Array Grammar::check(const std::string& text) const { return listed(compile(text).diagnostics); }

Array Grammar::parameters() const {
  Array list;
  for (uint32_t i = 0; i < sgm_grammar_parameter_count(compiled_.get()); ++i) {
    sgm_parameter_info info = SGM_PARAMETER_INFO_INIT;
    if (sgm_grammar_parameter(compiled_.get(), i, &info) != SGM_OK) continue;
    Variant entry = Variant::dictionary();
    entry.set("name", info.name);
    entry.set("doc", info.doc);
    entry.set("quantity", nameOf(info.quantity));
    entry.set("whole", info.whole != 0);
    entry.set("default", info.default_value);
    entry.set("minimum", info.minimum);
    entry.set("maximum", info.maximum);
    entry.set("animated", info.animated != 0);
    list.value.append(entry);
  }
  return list;
}

Strings Grammar::materials() const {
  return named(sgm_grammar_material_count(compiled_.get()), compiled_.get(), sgm_grammar_material);
}
Strings Grammar::tags() const {
  return named(sgm_grammar_tag_count(compiled_.get()), compiled_.get(), sgm_grammar_tag);
}
Strings Grammar::anchorNames() const {
  return named(sgm_grammar_name_count(compiled_.get()), compiled_.get(), sgm_grammar_name);
}

Dictionary Grammar::domain() const {
  Dictionary result;
  sgm_domain_info info = SGM_DOMAIN_INFO_INIT;
  if (sgm_grammar_domain(compiled_.get(), &info) != SGM_OK) return result;
  const auto metres = [](const int32_t units[3]) {
    constexpr float kMetre = 1.0f / SGM_UNITS_PER_METRE;
    return Vector3{static_cast<float>(units[0]) * kMetre, static_cast<float>(units[1]) * kMetre,
                   static_cast<float>(units[2]) * kMetre};
  };
  result.value.set("infinite", info.infinite != 0);
  result.value.set("solid", info.solid != 0);
  result.value.set("density", info.density != 0);
  result.value.set("minimum", metres(info.minimum));
  result.value.set("maximum", metres(info.maximum));
  return result;
}

void Grammar::setFilesAreText(bool on) { plugin().files_are_text = on; }

std::vector<std::string> materialNames(const sgm_grammar* grammar) {
  std::vector<std::string> names;
  for (uint32_t i = 0; i < sgm_grammar_material_count(grammar); ++i) {
    const std::string name = sgm_grammar_material(grammar, i);
    names.push_back(name.empty() ? "default" : name);
  }
  return names;
}

void Grammar::registerClass(ClassRecord& record) {
  record.name = "SgmGrammar";
  record.parent = "Resource";
  ClassBinder::add<Grammar>(record)
      .property<&Grammar::setText, &Grammar::text>("text", {18})
      .method_<&Grammar::isValid>("is_valid")
      .method_<&Grammar::errorText>("get_error_text")
      .method_<&Grammar::diagnostics>("get_diagnostics")
      .method_<&Grammar::check>("check", {"text"})
      .method_<&Grammar::parameters>("get_parameters")
      .method_<&Grammar::materials>("get_materials")
      .method_<&Grammar::tags>("get_tags")
      .method_<&Grammar::anchorNames>("get_anchor_names")
      .method_<&Grammar::domain>("get_domain")
      .method_<&Grammar::meaningHash>("get_meaning_hash")
      .method_<&Grammar::reload>("reload")
      .method_<&Grammar::setFilesAreText>("_set_files_are_text", {"on"})
      .method_<&Grammar::libraryVersion>("get_version")
      .method_<&Grammar::buildInfo>("get_build_info");
}

}  // namespace sgm_godot
