#include "api/barrier.h"
#include "api/grammar.h"
#include "api/parameter_values.h"

using namespace sgm::api;

sgm_parameters::sgm_parameters(sgm_runtime& runtime_in, std::shared_ptr<const sgm::Program> program_in)
    : runtime(runtime_in), program(std::move(program_in)), values(sgm::ParameterValues::defaults(*program)) {}

namespace {

sgm_result failToFind(sgm_error* error, const sgm::Error& e) { return fail(error, SGM_ERR_NOT_FOUND, e.message); }

}  // namespace

sgm_result sgm_parameters_create(const sgm_grammar* grammar, sgm_parameters** out, sgm_error* error) {
  return guarded(error, [&]() -> sgm_result {
    if (out == nullptr) return nullArgument(error, "out");
    *out = nullptr;
    if (grammar == nullptr) return nullArgument(error, "grammar");
    *out = makeHandle<sgm_parameters>(grammar->runtime, grammar->program);
    return SGM_OK;
  });
}

sgm_result sgm_parameters_destroy(sgm_parameters* parameters) { return releaseHandle(parameters, __func__); }

sgm_result sgm_parameters_set(sgm_parameters* parameters, const char* name, double value, sgm_error* error) {
  return guarded(error, [&]() -> sgm_result {
    if (parameters == nullptr) return nullArgument(error, "parameters");
    if (name == nullptr) return nullArgument(error, "name");
    const sgm::Result<uint32_t> index = findParameter(*parameters->program, name);
    if (!index) return failToFind(error, index.error());
    if (sgm::Result<void> ok = parameters->values.set(*parameters->program, name, value); !ok)
      return fail(error, ok.error());
    return SGM_OK;
  });
}

sgm_result sgm_parameters_set_text(sgm_parameters* parameters, const char* name, const char* text, sgm_error* error) {
  return guarded(error, [&]() -> sgm_result {
    if (parameters == nullptr) return nullArgument(error, "parameters");
    if (name == nullptr) return nullArgument(error, "name");
    if (text == nullptr) return nullArgument(error, "text");
    const sgm::Result<uint32_t> index = findParameter(*parameters->program, name);
    if (!index) return failToFind(error, index.error());
    if (sgm::Result<void> ok = setFromText(*parameters->program, name, text, parameters->values); !ok)
      return fail(error, ok.error());
    return SGM_OK;
  });
}

sgm_result sgm_parameters_get(const sgm_parameters* parameters, const char* name, double* value, sgm_error* error) {
  return guarded(error, [&]() -> sgm_result {
    if (parameters == nullptr) return nullArgument(error, "parameters");
    if (name == nullptr) return nullArgument(error, "name");
    if (value == nullptr) return nullArgument(error, "value");
    const sgm::Result<uint32_t> index = findParameter(*parameters->program, name);
    if (!index) return failToFind(error, index.error());
    *value = parameters->values.values[*index];
    return SGM_OK;
  });
}
