#pragma once
// The handles for the SG+M language: a compiled grammar, its diagnostics, and values for its parameters.

#include <memory>
#include <vector>

#include "api/note_log.h"
#include "api/runtime.h"
#include "derive/parameters.h"
#include "grammar/compile.h"

struct sgm_grammar {
  sgm_grammar(sgm_runtime& runtime_in, std::shared_ptr<const sgm::Program> program_in)
      : runtime(runtime_in), program(std::move(program_in)), notes(std::make_shared<sgm::api::NoteLog>(runtime)) {}

  sgm_runtime& runtime;
  std::shared_ptr<const sgm::Program> program;
  /// the log of derivation warnings, shared by all fields of the grammar: a new field may be created many times a
  /// second, and must not repeat the warnings
  std::shared_ptr<sgm::api::NoteLog> notes;
};

struct sgm_diagnostics {
  sgm_diagnostics(sgm_runtime& runtime_in, sgm::CompileResult&& compiled);

  struct Entry {
    sgm::Diagnostic diagnostic;
    std::string source_line;
  };
  sgm_runtime& runtime;
  std::vector<Entry> entries;
};

struct sgm_parameters {
  sgm_parameters(sgm_runtime& runtime_in, std::shared_ptr<const sgm::Program> program_in);

  sgm_runtime& runtime;
  std::shared_ptr<const sgm::Program> program;
  sgm::ParameterValues values;
};
