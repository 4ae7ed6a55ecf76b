#include "ours.h"

#include <sgm/sgm.h>

#include <algorithm>
#include <stdexcept>

namespace bench {
namespace {

void check(sgm_result result, const sgm_error& error) {
  if (result != SGM_OK) throw std::runtime_error(std::string(sgm_result_name(result)) + ": " + error.message);
}

using Surface = std::unique_ptr<sgm_surface, decltype(&sgm_surface_destroy)>;

Surface fromGrid(sgm_runtime* runtime, const sgm_grid_desc& desc) {
  sgm_surface* surface = nullptr;
  sgm_error error = SGM_ERROR_INIT;
  check(sgm_surface_from_grid(runtime, &desc, &surface, &error), error);
  return {surface, sgm_surface_destroy};
}

Surface fromGrid(sgm_runtime* runtime, const Grid& grid, bool normals) {
  sgm_grid_desc desc = SGM_GRID_DESC_INIT;
  desc.values = grid.values.data();
  for (int axis = 0; axis < 3; ++axis) desc.size[axis] = static_cast<uint32_t>(grid.size[axis]);
  desc.normals = normals ? 1 : 0;
  return fromGrid(runtime, desc);
}

sgm_surface_view viewOf(const Surface& surface) {
  sgm_surface_view view = SGM_SURFACE_VIEW_INIT;
  sgm_error error = SGM_ERROR_INIT;
  check(sgm_surface_get_view(surface.get(), &view, &error), error);
  return view;
}

Mesh copied(const sgm_surface_view& view, double scale) {
  Mesh mesh;
  mesh.positions.reserve(view.vertex_count * 3);
  for (uint64_t i = 0; i < view.vertex_count; ++i) {
    const char* at = reinterpret_cast<const char*>(view.positions) + i * view.position_stride;
    for (int axis = 0; axis < 3; ++axis)
      mesh.positions.push_back(static_cast<float>(double{reinterpret_cast<const float*>(at)[axis]} * scale));
  }
  mesh.indices.assign(view.indices, view.indices + view.index_count);
  return mesh;
}

}  // namespace

Ours::Ours(int threads) {
  sgm_error error = SGM_ERROR_INIT;
  sgm_runtime_desc runtime = SGM_RUNTIME_DESC_INIT;
  runtime.threads = static_cast<uint32_t>(threads);
  check(sgm_runtime_create(&runtime, &runtime_, &error), error);
}

Ours::Ours(const Scene& scene, int cells, int threads) : Ours(threads) {
  scene_ = scene;
  cells_ = cells;
  sgm_error error = SGM_ERROR_INIT;
  sgm_grammar_desc text = SGM_GRAMMAR_DESC_INIT;
  text.text = scene_.text.c_str();
  text.text_size = scene_.text.size();
  text.name = scene_.name.c_str();
  sgm_grammar* grammar = nullptr;
  check(sgm_grammar_compile(runtime_, &text, &grammar, nullptr, &error), error);

  sgm_field_desc field = SGM_FIELD_DESC_INIT;
  field.grammar = grammar;
  field.cell_units = scene_.cell_units;
  field.backend = SGM_BACKEND_CPU;
  const sgm_result result = sgm_field_create(runtime_, &field, &field_, &error);
  sgm_grammar_destroy(grammar);
  check(result, error);
}

Ours::~Ours() {
  sgm_field_destroy(field_);
  sgm_runtime_destroy(runtime_);
}

std::string Ours::device() const {
  sgm_error error = SGM_ERROR_INIT;
  sgm_backend_info info = SGM_BACKEND_INFO_INIT;
  check(sgm_backend_query(runtime_, SGM_BACKEND_CPU, &info, &error), error);
  return info.device;
}

size_t Ours::meshChunks() {
  const std::vector<sgm_chunk_request> requests = allRequests(0);
  std::vector<sgm_mesh*> meshes(requests.size());
  mesh(requests.data(), requests.size(), meshes.data());
  size_t triangles = 0;
  for (sgm_mesh* made : meshes) triangles += release(made);
  return triangles;
}

std::vector<double> Ours::surfaceChunks(int level) {
  std::vector<double> times;
  for (const sgm_chunk_request& request : allRequests(level)) {
    sgm_mesh* made = nullptr;
    const double start = now();
    mesh(&request, 1, &made);
    const double took = now() - start;
    if (release(made) > 0) times.push_back(took);
  }
  return times;
}

std::vector<sgm_chunk_request> Ours::allRequests(int level) const {
  const int32_t edge = SGM_CHUNK_CELLS * scene_.cell_units;
  std::vector<sgm_chunk_request> requests;
  const int32_t count = cells_ / SGM_CHUNK_CELLS;
  for (int32_t z = 0; z < count; ++z)
    for (int32_t y = 0; y < count; ++y)
      for (int32_t x = 0; x < count; ++x) {
        sgm_chunk_request request = SGM_CHUNK_REQUEST_INIT;
        request.key = {level, (scene_.origin[0] / edge >> level) + x, (scene_.origin[1] / edge >> level) + y,
                       (scene_.origin[2] / edge >> level) + z};
        requests.push_back(request);
      }
  return requests;
}

void Ours::mesh(const sgm_chunk_request* requests, size_t count, sgm_mesh** meshes) {
  sgm_chunks_desc desc = SGM_CHUNKS_DESC_INIT;
  desc.requests = requests;
  desc.count = count;
  sgm_error error = SGM_ERROR_INIT;
  check(sgm_mesh_chunks(field_, &desc, meshes, &error), error);
}

size_t Ours::release(sgm_mesh* mesh) {
  sgm_mesh_view view = SGM_MESH_VIEW_INIT;
  sgm_error error = SGM_ERROR_INIT;
  check(sgm_mesh_get_view(mesh, &view, &error), error);
  sgm_mesh_release(mesh);
  return view.index_count / 3;
}

sgm_surface* Ours::makeRegion() {
  sgm_region_desc region = SGM_REGION_DESC_INIT;
  for (int axis = 0; axis < 3; ++axis) {
    region.minimum[axis] = scene_.origin[axis];
    region.maximum[axis] = scene_.origin[axis] + cells_ * scene_.cell_units;
  }
  sgm_surface* made = nullptr;
  sgm_error error = SGM_ERROR_INIT;
  check(sgm_surface_from_region(field_, &region, &made, &error), error);
  return made;
}

size_t Ours::meshRegion() { return viewOf({makeRegion(), sgm_surface_destroy}).index_count / 3; }

Mesh Ours::welded() {
  const Surface surface(makeRegion(), sgm_surface_destroy);
  const sgm_surface_view view = viewOf(surface);
  Mesh mesh = copied(view, double{SGM_UNITS_PER_METRE} / scene_.cell_units);
  for (size_t i = 0; i < mesh.positions.size(); ++i) {
    const int32_t from = view.origin[i % 3] - scene_.origin[i % 3];
    mesh.positions[i] += static_cast<float>(from / static_cast<double>(scene_.cell_units));
  }
  return mesh;
}

Grid Ours::sample() {
  const int32_t n = cells_ + 1;
  Grid grid{{n, n, n}, std::vector<float>(static_cast<size_t>(n) * static_cast<size_t>(n) * static_cast<size_t>(n))};
  std::vector<int32_t> points(static_cast<size_t>(n) * static_cast<size_t>(n) * 3);
  std::vector<float> values(static_cast<size_t>(n) * static_cast<size_t>(n));
  const float scale = float{SGM_UNITS_PER_METRE} / static_cast<float>(scene_.cell_units);
  for (int32_t z = 0; z < n; ++z) {
    size_t at = 0;
    for (int32_t y = 0; y < n; ++y) {
      for (int32_t x = 0; x < n; ++x) {
        const int32_t cell[3] = {x, y, z};
        for (int axis = 0; axis < 3; ++axis) points[at++] = scene_.origin[axis] + cell[axis] * scene_.cell_units;
      }
    }
    sgm_sample_desc desc = SGM_SAMPLE_DESC_INIT;
    desc.points = points.data();
    desc.count = values.size();
    desc.values = values.data();
    sgm_error error = SGM_ERROR_INIT;
    check(sgm_field_sample(field_, &desc, &error), error);
    std::transform(values.begin(), values.end(), grid.values.begin() + static_cast<std::ptrdiff_t>(values.size()) * z,
                   [scale](float v) { return v * scale; });
  }
  return grid;
}

size_t Ours::meshGrid(const Grid& grid, bool normals) {
  return viewOf(fromGrid(runtime_, grid, normals)).index_count / 3;
}

std::vector<double> Ours::gridChunks(const Grid& grid) {
  std::vector<double> times;
  std::vector<float> block;
  const auto width = static_cast<size_t>(grid.size[0]), height = static_cast<size_t>(grid.size[1]);
  const int32_t count = (grid.size[0] - 1) / SGM_CHUNK_CELLS;
  for (int32_t i = 0; i < count * count * count; ++i) {
    const int32_t at[3] = {i % count, i / count % count, i / count / count};
    // Copy the block's samples, so that they are in the cache, as freshly evaluated samples are.
    block.clear();
    for (int32_t z = 0; z <= SGM_CHUNK_CELLS; ++z) {
      for (int32_t y = 0; y <= SGM_CHUNK_CELLS; ++y) {
        const auto plane = static_cast<size_t>(at[2] * SGM_CHUNK_CELLS + z),
                   row = static_cast<size_t>(at[1] * SGM_CHUNK_CELLS + y);
        const float* first =
            &grid.values[(plane * height + row) * width + static_cast<size_t>(at[0]) * SGM_CHUNK_CELLS];
        block.insert(block.end(), first, first + SGM_CHUNK_CELLS + 1);
      }
    }
    sgm_grid_desc desc = SGM_GRID_DESC_INIT;
    for (uint32_t& size : desc.size) size = SGM_CHUNK_CELLS + 1;
    desc.values = block.data();
    desc.normals = 0;
    const double start = now();
    const Surface surface = fromGrid(runtime_, desc);
    const double took = now() - start;
    if (viewOf(surface).index_count > 0) times.push_back(took);
  }
  return times;
}

Mesh Ours::gridMesh(const Grid& grid) {
  const Surface surface = fromGrid(runtime_, grid, true);
  return copied(viewOf(surface), 1.0);
}

}  // namespace bench
