#pragma once
// SgmGrammar: a resource with the text of a grammar and its compiled form.

#include "godot/conversion.h"
#include "handles.h"

namespace sgm_godot {

struct ClassRecord;

class Grammar : public Instance {
 public:
  using Instance::Instance;
  static void registerClass(ClassRecord& record);

  /// The compiled form of the last valid text; null before there is one. Worlds share its ownership.
  const GrammarOwner& compiled() const { return compiled_; }

  /// Reads a file and compiles it under its name. Returns false if the file cannot be read; errors in the text are not
  /// a failure.
  bool load(const std::string& path);
  std::string text() const { return text_; }
  /// Reads the file again if it has changed since it was last read. Returns whether it had changed.
  bool followFile();

 private:
  void setText(const std::string& text);
  bool isValid() const { return valid_; }
  std::string errorText() const;
  Array diagnostics() const;
  Array check(const std::string& text) const;
  Array parameters() const;
  Strings materials() const;
  Strings tags() const;
  Strings anchorNames() const;
  Dictionary domain() const;
  int64_t meaningHash() const { return static_cast<int64_t>(sgm_grammar_hash(compiled_.get())); }
  int64_t reload();
  void setFilesAreText(bool on);
  std::string libraryVersion() const { return sgm_version_string(); }
  std::string buildInfo() const { return sgm_build_info(); }

  struct Diagnostic {
    bool error;
    int32_t line, column, length;
    std::string file, message, hint, source_line;
  };
  struct Compilation {
    GrammarOwner grammar;  // null if the text has errors
    std::vector<Diagnostic> diagnostics;
  };
  Compilation compile(const std::string& text) const;
  void adopt(const std::string& text);
  std::string path() const;
  static Array listed(const std::vector<Diagnostic>& diagnostics);

  std::string text_, file_;
  int64_t file_time_ = 0;
  GrammarOwner compiled_;
  std::vector<Diagnostic> diagnostics_;
  bool valid_ = false;
  uint64_t version_ = 0;
};

/// The names of a grammar's materials, as the inspector lists them; empty for null.
std::vector<std::string> materialNames(const sgm_grammar* grammar);

}  // namespace sgm_godot
