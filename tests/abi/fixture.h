#pragma once
// RAII owners of the C interface's handles, and the small worlds that its tests use.

#include <sgm/sgm.h>

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "catch.h"

struct EndRuntime {
  // Destroying a runtime fails while any of its objects exists, so this check finds objects that a test has leaked.
  void operator()(sgm_runtime* runtime) const { CHECK(sgm_runtime_destroy(runtime) == SGM_OK); }
};
template <auto End>
struct EndWith {
  template <class T>
  void operator()(T* handle) const {
    if (const sgm_result result = End(handle); result != SGM_OK) FAIL_CHECK(sgm_result_name(result));
  }
};
using RuntimeOwner = std::unique_ptr<sgm_runtime, EndRuntime>;
using GrammarOwner = std::unique_ptr<sgm_grammar, EndWith<sgm_grammar_destroy>>;
using DiagnosticsOwner = std::unique_ptr<sgm_diagnostics, EndWith<sgm_diagnostics_destroy>>;
using ParametersOwner = std::unique_ptr<sgm_parameters, EndWith<sgm_parameters_destroy>>;
using FieldOwner = std::unique_ptr<sgm_field, EndWith<sgm_field_destroy>>;
using MeshOwner = std::unique_ptr<sgm_mesh, EndWith<sgm_mesh_release>>;
using WorldOwner = std::unique_ptr<sgm_world, EndWith<sgm_world_destroy>>;
using SurfaceOwner = std::unique_ptr<sgm_surface, EndWith<sgm_surface_destroy>>;

/// A grammar with one ball of radius 3 m around (4, 4, 4) m.
inline constexpr const char* kBall =
    "sgm 1;\nunits m;\nparam radius = 3m in 1m..3.5m animated \"radius\";\nparam count = 2 in 1..4;\nparam turn = "
    "30deg;\n"
    "start Ball;\nrule Ball { at(4m, 4m, 4m) sphere(radius); mat marble; tag \"toy.ball\"; anchor spawn \"top\"; }\n";

/// An infinite void with a ball in every cell of 32 m.
inline constexpr const char* kBalls =
    "sgm 1; units m; domain infinite;\nlayer l cell 32m reach 8m detail 2m { start Ball; }\n"
    "rule Ball { at(8m, 8m, 8m) sphere(7m); }\n";

inline RuntimeOwner makeRuntime(const sgm_runtime_desc* desc = nullptr) {
  sgm_runtime* runtime = nullptr;
  sgm_error error = SGM_ERROR_INIT;
  INFO(error.message);
  REQUIRE(sgm_runtime_create(desc, &runtime, &error) == SGM_OK);
  return RuntimeOwner(runtime);
}

inline GrammarOwner compile(sgm_runtime* runtime, const char* text) {
  sgm_grammar_desc desc = SGM_GRAMMAR_DESC_INIT;
  desc.text = text;
  sgm_grammar* grammar = nullptr;
  sgm_error error = SGM_ERROR_INIT;
  const sgm_result result = sgm_grammar_compile(runtime, &desc, &grammar, nullptr, &error);
  INFO(error.line << ":" << error.column << ": " << error.message);
  REQUIRE(result == SGM_OK);
  return GrammarOwner(grammar);
}

inline FieldOwner makeField(sgm_runtime* runtime, const sgm_grammar* grammar, int32_t cell_units = 256,
                            sgm_backend backend = SGM_BACKEND_AUTO) {
  sgm_field_desc desc = SGM_FIELD_DESC_INIT;
  desc.grammar = grammar;
  desc.seed = 7;
  desc.cell_units = cell_units;
  desc.backend = backend;
  sgm_field* field = nullptr;
  sgm_error error = SGM_ERROR_INIT;
  const sgm_result result = sgm_field_create(runtime, &desc, &field, &error);
  INFO(error.message);
  REQUIRE(result == SGM_OK);
  return FieldOwner(field);
}

inline sgm_chunk_request chunkAt(const sgm_chunk_key& key, uint32_t seams = 0) {
  sgm_chunk_request request = SGM_CHUNK_REQUEST_INIT;
  request.key = key;
  request.seams = seams;
  return request;
}

inline std::vector<MeshOwner> meshChunks(sgm_field* field, const std::vector<sgm_chunk_request>& requests,
                                         uint32_t flags = 0) {
  sgm_chunks_desc desc = SGM_CHUNKS_DESC_INIT;
  desc.flags = flags;
  desc.requests = requests.data();
  desc.count = requests.size();
  std::vector<sgm_mesh*> meshes(requests.size());
  sgm_error error = SGM_ERROR_INIT;
  const sgm_result result = sgm_mesh_chunks(field, &desc, meshes.data(), &error);
  INFO(error.message);
  REQUIRE(result == SGM_OK);
  std::vector<MeshOwner> owners;
  for (sgm_mesh* mesh : meshes) owners.emplace_back(mesh);
  return owners;
}

/// Describes a world with levels 0 to 3: the finest level reaches 10 m, the coarsest 60 m.
inline sgm_world_desc smallWorld(uint32_t flags = 0) {
  sgm_world_desc desc = SGM_WORLD_DESC_INIT;
  desc.top_level = 3;
  desc.flags = flags;
  desc.finest_distance = 10;
  desc.view_distance = 60;
  return desc;
}

inline WorldOwner makeWorld(sgm_field* field, const sgm_world_desc& desc = smallWorld()) {
  sgm_world* world = nullptr;
  sgm_error error = SGM_ERROR_INIT;
  const sgm_result result = sgm_world_create(field, &desc, &world, &error);
  INFO(error.message);
  REQUIRE(result == SGM_OK);
  return WorldOwner(world);
}

/// Sets a single viewer at rest, x and z metres from the origin.
inline void look(sgm_world* world, double x, double z = 0) {
  sgm_viewer viewer = SGM_VIEWER_INIT;
  viewer.position[0] = x;
  viewer.position[2] = z;
  REQUIRE(sgm_world_set_viewers(world, &viewer, 0, 1, nullptr) == SGM_OK);
}

inline void comeToRest(sgm_world* world) { REQUIRE(sgm_world_wait_idle(world, nullptr, nullptr, nullptr) == SGM_OK); }

/// Returns the chunks that a world draws; the caller owns their meshes.
inline std::vector<sgm_drawn_chunk> drawnChunks(sgm_world* world) {
  size_t count = 0;
  REQUIRE(sgm_world_get_drawn(world, nullptr, 0, &count, nullptr) == SGM_OK);
  std::vector<sgm_drawn_chunk> chunks(count);
  REQUIRE(sgm_world_get_drawn(world, chunks.data(), 0, &count, nullptr) == SGM_OK);
  return chunks;
}

inline std::vector<MeshOwner> drawnOf(sgm_world* world) {
  std::vector<MeshOwner> meshes;
  for (const sgm_drawn_chunk& chunk : drawnChunks(world)) meshes.emplace_back(chunk.mesh);
  return meshes;
}

inline SurfaceOwner surfaceOf(sgm_field* field, const sgm_region_desc& desc) {
  sgm_surface* surface = nullptr;
  sgm_error error = SGM_ERROR_INIT;
  const sgm_result result = sgm_surface_from_region(field, &desc, &surface, &error);
  INFO(error.message);
  REQUIRE(result == SGM_OK);
  return SurfaceOwner(surface);
}

inline sgm_mesh_view viewOf(const MeshOwner& mesh) {
  sgm_mesh_view view = SGM_MESH_VIEW_INIT;
  REQUIRE(sgm_mesh_get_view(mesh.get(), &view, nullptr) == SGM_OK);
  return view;
}

inline sgm_surface_view viewOf(const SurfaceOwner& surface) {
  sgm_surface_view view = SGM_SURFACE_VIEW_INIT;
  REQUIRE(sgm_surface_get_view(surface.get(), &view, nullptr) == SGM_OK);
  return view;
}

/// Checks that the view of a mesh or surface has wedges (copies of vertices with their own texture coordinates), that
/// its triangles use all of them, and that the wedges of a triangle have the same pair of materials.
template <class View>
void checkWedges(const View& view) {
  REQUIRE(view.wedges != nullptr);
  REQUIRE(view.wedge_indices != nullptr);
  CHECK(view.wedge_count >= view.vertex_count);
  CHECK(view.wedge_stride == sizeof(sgm_wedge));
  for (uint64_t i = 0; i < view.index_count; ++i) {
    REQUIRE(view.wedge_indices[i] < view.wedge_count);
    const sgm_wedge& wedge = view.wedges[view.wedge_indices[i]];
    const sgm_wedge& first = view.wedges[view.wedge_indices[i - i % 3]];
    REQUIRE(wedge.vertex == view.indices[i]);
    CHECK((wedge.materials[0] == first.materials[0] && wedge.materials[1] == first.materials[1]));
    CHECK(wedge.materials[0] <= wedge.materials[1]);
    const int planes = wedge.plane_shares[0] + wedge.plane_shares[1] + wedge.plane_shares[2];
    CHECK((planes == 0 || planes == 255));
  }
}
