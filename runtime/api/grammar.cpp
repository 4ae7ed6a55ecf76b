#include "api/grammar.h"

#include <cstdint>
#include <cstring>

#include "api/barrier.h"
#include "api/import.h"
#include "base/math.h"

using namespace sgm::api;

sgm_diagnostics::sgm_diagnostics(sgm_runtime& runtime_in, sgm::CompileResult&& compiled) : runtime(runtime_in) {
  entries.reserve(compiled.diagnostics.size());
  for (sgm::Diagnostic& diagnostic : compiled.diagnostics) {
    std::string line = sourceLine(compiled.files, diagnostic.file, diagnostic.line);
    entries.push_back({std::move(diagnostic), std::move(line)});
  }
}

namespace {

const sgm::Diagnostic* firstError(const std::vector<sgm::Diagnostic>& diagnostics) {
  for (const sgm::Diagnostic& d : diagnostics) {
    if (d.severity == sgm::Severity::error) return &d;
  }
  return nullptr;
}

/// Reports the first compile error as one line. If it is in an imported file, the message names that file; line and
/// column are positions in it.
sgm_result failToCompile(sgm_error* error, const sgm::Diagnostic& d, std::string_view root) {
  std::string message = d.message;
  if (d.file != root) message = "in " + d.file + ": " + message;
  if (!d.hint.empty()) message += " (" + d.hint + ")";
  return fail(error, SGM_ERR_GRAMMAR, message, d.line, d.column);
}

/// Returns a name of the compiled grammar as a C string, which is valid as long as the grammar.
const char* nameAt(const std::pmr::vector<std::pmr::string>& names, uint32_t index) {
  return index < names.size() ? names[index].c_str() : nullptr;
}

sgm_quantity quantityOf(sgm::Dim dim) {
  if (dim == sgm::kRatio) return SGM_QUANTITY_NUMBER;
  if (dim == sgm::kLength) return SGM_QUANTITY_LENGTH;
  if (dim == sgm::kAngle) return SGM_QUANTITY_ANGLE;
  return SGM_QUANTITY_OTHER;
}

}  // namespace

sgm_result sgm_grammar_compile(sgm_runtime* runtime, const sgm_grammar_desc* desc, sgm_grammar** out,
                               sgm_diagnostics** diagnostics, sgm_error* error) {
  return guarded(error, [&]() -> sgm_result {
    if (out != nullptr) *out = nullptr;
    if (diagnostics != nullptr) *diagnostics = nullptr;
    if (out == nullptr) return nullArgument(error, "out");
    if (runtime == nullptr) return nullArgument(error, "runtime");
    if (sgm_result r = checkDesc(error, desc, "desc"); r != SGM_OK) return r;
    if (desc->text == nullptr) return nullArgument(error, "desc.text");

    CallerImports imports(desc->import_text, desc->import_user, desc->import_folder);
    sgm::CompileOptions options;
    options.resolver = &imports;
    options.memory = &runtime->memory;
    const std::string_view name = desc->name != nullptr ? desc->name : "grammar";
    const size_t size = desc->text_size == SIZE_MAX ? std::strlen(desc->text) : desc->text_size;
    sgm::CompileResult compiled = sgm::compileGrammar({desc->text, size}, name, options);

    const std::shared_ptr<const sgm::Program> program = compiled.program;
    sgm_result result = SGM_OK;
    if (program == nullptr) {
      const sgm::Diagnostic* first = firstError(compiled.diagnostics);
      if (first == nullptr)
        return fail(error, SGM_ERR_INTERNAL, "the compiler returned neither a program nor an error");
      result = failToCompile(error, *first, name);
    }
    sgm_diagnostics* list = nullptr;
    if (diagnostics != nullptr) list = makeHandle<sgm_diagnostics>(*runtime, std::move(compiled));
    if (program != nullptr) {
      try {
        *out = makeHandle<sgm_grammar>(*runtime, program);
      } catch (...) {
        sgm_diagnostics_destroy(list);
        throw;
      }
    }
    if (diagnostics != nullptr) *diagnostics = list;
    return result;
  });
}

sgm_result sgm_grammar_destroy(sgm_grammar* grammar) { return releaseHandle(grammar, __func__); }

uint64_t sgm_grammar_hash(const sgm_grammar* grammar) { return grammar == nullptr ? 0 : grammar->program->hash; }

sgm_result sgm_diagnostics_destroy(sgm_diagnostics* diagnostics) { return releaseHandle(diagnostics, __func__); }

uint32_t sgm_diagnostics_count(const sgm_diagnostics* diagnostics) {
  return diagnostics == nullptr ? 0 : static_cast<uint32_t>(diagnostics->entries.size());
}

sgm_result sgm_diagnostics_get(const sgm_diagnostics* diagnostics, uint32_t index, sgm_diagnostic* out) {
  return guarded(nullptr, [&]() -> sgm_result {
    if (diagnostics == nullptr) return SGM_ERR_INVALID_ARGUMENT;
    if (sgm_result r = checkDesc(nullptr, out, "out"); r != SGM_OK) return r;
    if (index >= diagnostics->entries.size()) return SGM_ERR_NOT_FOUND;
    const sgm_diagnostics::Entry& entry = diagnostics->entries[index];
    const sgm::Diagnostic& d = entry.diagnostic;
    out->severity = d.severity == sgm::Severity::error ? SGM_LOG_ERROR : SGM_LOG_WARNING;
    out->line = d.line;
    out->column = d.column;
    out->length = d.end_column > d.column ? d.end_column - d.column : 1;
    out->file = d.file.c_str();
    out->message = d.message.c_str();
    out->hint = d.hint.c_str();
    out->source_line = entry.source_line.c_str();
    return SGM_OK;
  });
}

uint32_t sgm_grammar_material_count(const sgm_grammar* grammar) {
  return grammar == nullptr ? 0 : static_cast<uint32_t>(grammar->program->materials.size());
}
const char* sgm_grammar_material(const sgm_grammar* grammar, uint32_t index) {
  return grammar == nullptr ? nullptr : nameAt(grammar->program->materials, index);
}
uint32_t sgm_grammar_tag_count(const sgm_grammar* grammar) {
  return grammar == nullptr ? 0 : static_cast<uint32_t>(grammar->program->tags.size());
}
const char* sgm_grammar_tag(const sgm_grammar* grammar, uint32_t index) {
  return grammar == nullptr ? nullptr : nameAt(grammar->program->tags, index);
}
uint32_t sgm_grammar_name_count(const sgm_grammar* grammar) {
  return grammar == nullptr ? 0 : static_cast<uint32_t>(grammar->program->names.size());
}
const char* sgm_grammar_name(const sgm_grammar* grammar, uint32_t index) {
  return grammar == nullptr ? nullptr : nameAt(grammar->program->names, index);
}

sgm_result sgm_grammar_domain(const sgm_grammar* grammar, sgm_domain_info* out) {
  return guarded(nullptr, [&]() -> sgm_result {
    if (grammar == nullptr) return SGM_ERR_INVALID_ARGUMENT;
    if (sgm_result r = checkDesc(nullptr, out, "out"); r != SGM_OK) return r;
    const sgm::Domain& domain = grammar->program->domain;
    out->infinite = domain.infinite ? 1 : 0;
    out->solid = domain.solid ? 1 : 0;
    out->density = domain.density ? 1 : 0;
    out->material = domain.material;
    for (int axis = 0; axis < 3; ++axis) {
      out->cut[axis] = domain.infinite && domain.axes[static_cast<size_t>(axis)] ? 1 : 0;
      out->minimum[axis] = domain.infinite ? 0 : domain.box.lo[axis];
      out->maximum[axis] = domain.infinite ? 0 : domain.box.hi[axis];
    }
    out->density_edge = domain.density ? static_cast<float>(sgm::metres(domain.density_edge)) : 0.0f;
    return SGM_OK;
  });
}

uint32_t sgm_grammar_layer_count(const sgm_grammar* grammar) {
  return grammar == nullptr ? 0 : static_cast<uint32_t>(grammar->program->layers.size());
}

sgm_result sgm_grammar_layer(const sgm_grammar* grammar, uint32_t index, sgm_layer_info* out) {
  return guarded(nullptr, [&]() -> sgm_result {
    if (grammar == nullptr) return SGM_ERR_INVALID_ARGUMENT;
    if (sgm_result r = checkDesc(nullptr, out, "out"); r != SGM_OK) return r;
    const sgm::Program& program = *grammar->program;
    if (index >= program.layers.size()) return SGM_ERR_NOT_FOUND;
    const sgm::Layer& layer = program.layers[index];
    out->name = program.ast.names[layer.name].c_str();
    for (int axis = 0; axis < 3; ++axis) out->cell_units[axis] = layer.cell[axis];
    out->reach_units = layer.reach;
    return SGM_OK;
  });
}

uint32_t sgm_grammar_parameter_count(const sgm_grammar* grammar) {
  return grammar == nullptr ? 0 : static_cast<uint32_t>(grammar->program->params.size());
}

sgm_result sgm_grammar_parameter(const sgm_grammar* grammar, uint32_t index, sgm_parameter_info* out) {
  return guarded(nullptr, [&]() -> sgm_result {
    if (grammar == nullptr) return SGM_ERR_INVALID_ARGUMENT;
    if (sgm_result r = checkDesc(nullptr, out, "out"); r != SGM_OK) return r;
    const sgm::Program& program = *grammar->program;
    if (index >= program.params.size()) return SGM_ERR_NOT_FOUND;
    const sgm::Param& param = program.params[index];
    out->name = program.ast.names[param.name].c_str();
    out->doc = param.doc == sgm::kNoId ? "" : program.ast.names[param.doc].c_str();
    out->quantity = quantityOf(param.dim);
    out->whole = param.whole ? 1 : 0;
    out->default_value = param.value;
    out->minimum = param.has_range ? param.low : -sgm::kInfinity;
    out->maximum = param.has_range ? param.high : sgm::kInfinity;
    out->animated = param.animated ? 1 : 0;
    out->reserved = 0;
    return SGM_OK;
  });
}
