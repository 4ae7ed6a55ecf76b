#include <algorithm>
#include <limits>
#include <vector>

#include "api/anchors.h"
#include "api/barrier.h"
#include "api/field.h"
#include "api/mesh.h"
#include "stream/mesh_chunks.h"

using namespace sgm::api;

namespace {

constexpr size_t kMostChunks = size_t{1} << 20;

sgm_result checkRequest(const sgm_field& field, const sgm_chunk_request& request, sgm_error* error) {
  if (sgm_result r = checkLevel(field, request.key.level, error); r != SGM_OK) return r;
  if (request.seams >> SGM_FACE_COUNT != 0)
    return fail(error, SGM_ERR_INVALID_ARGUMENT, "a chunk's seams have bits beyond the six faces");
  const int64_t edge = int64_t{SGM_CHUNK_CELLS} * field.world.cellAt(request.key.level);
  for (const int32_t at : {request.key.x, request.key.y, request.key.z}) {
    const int64_t low = at * edge;
    if (low < std::numeric_limits<int32_t>::min() || low + edge > std::numeric_limits<int32_t>::max())
      return fail(error, SGM_ERR_RANGE, "a chunk does not lie wholly inside the world of +-2^31 units");
  }
  return SGM_OK;
}

MeshSource sourceOf(const sgm_chunk_key& key, const sgm::PlacedChunk& chunk, std::span<const sgm_anchor> anchors) {
  MeshSource source;
  source.key = key;
  source.grid = chunk.grid;
  source.parts[0] = &chunk.mesh.body;
  for (size_t face = 0; face < chunk.mesh.seams.size(); ++face) source.parts[1 + face] = &chunk.mesh.seams[face];
  source.anchors = anchors;
  return source;
}

/// Meshes made so far; ends them unless they are handed over.
class MadeMeshes {
 public:
  explicit MadeMeshes(size_t count) : meshes_(count, nullptr) {}
  MadeMeshes(const MadeMeshes&) = delete;
  MadeMeshes& operator=(const MadeMeshes&) = delete;
  ~MadeMeshes() {
    for (sgm_mesh* mesh : meshes_) sgm_mesh_release(mesh);
  }
  sgm_mesh*& operator[](size_t i) { return meshes_[i]; }
  void handOver(sgm_mesh** to) {
    std::copy(meshes_.begin(), meshes_.end(), to);
    std::fill(meshes_.begin(), meshes_.end(), nullptr);
  }

 private:
  std::vector<sgm_mesh*> meshes_;
};

}  // namespace

sgm_result sgm_mesh_chunks(sgm_field* field, const sgm_chunks_desc* desc, sgm_mesh** meshes, sgm_error* error) {
  return guarded(error, [&]() -> sgm_result {
    if (field == nullptr) return nullArgument(error, "field");
    if (sgm_result r = checkDesc(error, desc, "desc"); r != SGM_OK) return r;
    if (meshes == nullptr) return nullArgument(error, "meshes");
    if (desc->requests == nullptr) return nullArgument(error, "desc.requests");
    if (desc->count == 0) return fail(error, SGM_ERR_INVALID_ARGUMENT, "desc.count is 0");
    if (desc->count > kMostChunks) return fail(error, SGM_ERR_LIMIT, "desc.count is above 2^20");
    std::fill_n(meshes, desc->count, nullptr);

    std::vector<sgm::ChunkRequest> requests;
    requests.reserve(desc->count);
    for (const sgm_chunk_request& request : std::span(desc->requests, desc->count)) {
      if (sgm_result r = checkRequest(*field, request, error); r != SGM_OK) return r;
      requests.push_back({{request.key.level, {request.key.x, request.key.y, request.key.z}},
                          static_cast<uint8_t>(request.seams),
                          sgm::Neighbourhood{}});
    }
    sgm::Progress progress;
    if (desc->progress != nullptr)
      progress = [desc](uint64_t done, uint64_t total) {
        return desc->progress(desc->progress_user, done, total) == 0;
      };
    sgm::Result<std::vector<sgm::PlacedChunk>> chunks =
        sgm::meshChunks(field->world, *field->backend, *field->runtime.jobs, requests, progress);
    if (!chunks) return fail(error, chunks.error());

    MadeMeshes made(desc->count);
    for (size_t i = 0; i < desc->count; ++i) {
      sgm::PlacedChunk& chunk = (*chunks)[i];
      sgm::IntBox box{chunk.grid.origin, chunk.grid.origin};
      for (int axis = 0; axis < 3; ++axis) box.hi[axis] += SGM_CHUNK_CELLS * chunk.grid.cell;
      const sgm::Result<std::vector<sgm_anchor>> anchors = anchorsIn(field->world, box);
      if (!anchors) return fail(error, anchors.error());
      made[i] = makeHandle<sgm_mesh>(field->runtime, sourceOf(desc->requests[i].key, chunk, *anchors));
      // Give back what has been copied: a batch may be large.
      chunk.mesh = sgm::ChunkMesh(&field->runtime.memory);
    }
    made.handOver(meshes);
    return SGM_OK;
  });
}
