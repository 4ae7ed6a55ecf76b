#pragma once
// Owners of the library's handles, and exceptions for the library's errors.

#include <sgm/sgm.h>

#include <memory>
#include <stdexcept>
#include <string>

template <auto End>
struct EndWith {
  template <class Handle>
  void operator()(Handle* handle) const {
    static_cast<void>(End(handle));
  }
};
using RuntimeOwner = std::unique_ptr<sgm_runtime, EndWith<sgm_runtime_destroy>>;
using GrammarOwner = std::unique_ptr<sgm_grammar, EndWith<sgm_grammar_destroy>>;
using FieldOwner = std::unique_ptr<sgm_field, EndWith<sgm_field_destroy>>;
using WorldOwner = std::unique_ptr<sgm_world, EndWith<sgm_world_destroy>>;
using MeshOwner = std::unique_ptr<sgm_mesh, EndWith<sgm_mesh_release>>;

/// Throws an exception if a call of the library has failed. Every call that can fail passes its result to this
/// function.
inline void must(sgm_result result, const sgm_error& error) {
  if (result >= SGM_OK) return;
  const std::string place = error.line > 0 ? " (line " + std::to_string(error.line) + ")" : "";
  throw std::runtime_error(std::string(sgm_result_name(result)) + ": " + error.message + place);
}
