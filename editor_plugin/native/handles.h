#pragma once
// Owners of the runtime's handles, which destroy them automatically.

#include <sgm/sgm.h>

#include <memory>
#include <string>

namespace sgm_godot {

template <auto End>
struct EndWith {
  template <class Handle>
  void operator()(Handle* handle) const {
    static_cast<void>(End(handle));
  }
};
using DiagnosticsOwner = std::unique_ptr<sgm_diagnostics, EndWith<sgm_diagnostics_destroy>>;
using ParametersOwner = std::unique_ptr<sgm_parameters, EndWith<sgm_parameters_destroy>>;
using FieldOwner = std::unique_ptr<sgm_field, EndWith<sgm_field_destroy>>;
using WorldOwner = std::unique_ptr<sgm_world, EndWith<sgm_world_destroy>>;
using SurfaceOwner = std::unique_ptr<sgm_surface, EndWith<sgm_surface_destroy>>;
using MeshOwner = std::unique_ptr<sgm_mesh, EndWith<sgm_mesh_release>>;
using ColliderOwner = std::unique_ptr<sgm_collider, EndWith<sgm_collider_release>>;
using GrammarOwner = std::shared_ptr<sgm_grammar>;

inline MeshOwner acquired(sgm_mesh* mesh) {
  static_cast<void>(sgm_mesh_acquire(mesh));
  return MeshOwner(mesh);
}

inline std::string textOf(const sgm_error& error) {
  return error.line > 0
             ? "line " + std::to_string(error.line) + ", column " + std::to_string(error.column) + ": " + error.message
             : error.message;
}

}  // namespace sgm_godot
