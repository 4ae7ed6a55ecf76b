#pragma once
// SgmGrammar: a text of the language as a resource, compiled.

#include "godot/conversion.h"
#include "handles.h"

namespace sgm_godot {

struct ClassRecord;

class Grammar : public Instance {
 public:
  using Instance::Instance;
  static void registerClass(ClassRecord& record);

  /// What the last text that compiled became: null before there is one. Shared by worlds, which may keep it.
  const GrammarOwner& compiled() const { return compiled_; }
  /// Rises with every compilation that succeeded.

  /// Reads a file and compiles it under its name. False where it cannot be read; a wrong text is no such failure.
  bool load(const std::string& path);
  std::string text() const { return text_; }
  /// Reads the file again if it has changed since. Returns whether it had.
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
    GrammarOwner grammar;  // null where the text is wrong
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

}  // namespace sgm_godot
