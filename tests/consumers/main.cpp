// A consumer in C++: includes the header as C++, and checks an error that a call returns.
#include <sgm/sgm.h>

#include <cstdio>
#include <memory>

int main() {
  sgm_error error = SGM_ERROR_INIT;
  sgm_runtime* created = nullptr;
  if (sgm_runtime_create(nullptr, &created, &error) != SGM_OK) {
    std::fprintf(stderr, "%s\n", error.message);
    return 1;
  }
  const std::unique_ptr<sgm_runtime, sgm_result (*)(sgm_runtime*)> runtime(created, sgm_runtime_destroy);

  sgm_grammar_desc text = SGM_GRAMMAR_DESC_INIT;
  text.text = "sgm 1;\nstart Nothing;\n";
  sgm_grammar* grammar = nullptr;
  const sgm_result result = sgm_grammar_compile(runtime.get(), &text, &grammar, nullptr, &error);
  std::printf("%s at %d:%d: %s\n", sgm_result_name(result), error.line, error.column, error.message);
  return result == SGM_ERR_GRAMMAR && grammar == nullptr && error.line == 2 ? 0 : 1;
}
