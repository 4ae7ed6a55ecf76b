#include <algorithm>
#include <cstring>
#include <optional>
#include <vector>

#include "api/barrier.h"
#include "api/field.h"
#include "api/mesh.h"
#include "chunk/chunk_surface.h"
#include "chunk/surface_shapes.h"

using namespace sgm::api;

namespace {

constexpr size_t kMaxChunks = size_t{1} << 20;
constexpr sgm::Neighbourhood kBlocksAround = (1u << 27) - 1 - sgm::neighbourBit(0, 0, 0);

sgm::ChunkKey keyOf(const sgm_chunk_key& key) { return {key.level, {key.x, key.y, key.z}}; }

sgm_result checkRequests(const sgm_chunks_desc& desc, sgm_error* error) {
  if (desc.requests == nullptr) return nullArgument(error, "desc.requests");
  if (desc.count == 0) return fail(error, SGM_ERR_INVALID_ARGUMENT, "desc.count is 0");
  if (desc.count > kMaxChunks) return fail(error, SGM_ERR_LIMIT, "desc.count is above 2^20");
  if ((desc.flags & ~static_cast<uint32_t>(SGM_MESHING_TEXTURE | SGM_MESHING_SHARP)) != 0)
    return fail(error, SGM_ERR_INVALID_ARGUMENT, "desc.flags has unknown bits: pass 0 or values of sgm_meshing_flag");
  if (desc.reserved != 0) return fail(error, SGM_ERR_INVALID_ARGUMENT, "desc.reserved must be 0");
  return SGM_OK;
}

sgm_chunk_request requestAt(const sgm_chunks_desc& desc, size_t stride, size_t i) {
  sgm_chunk_request request;
  std::memcpy(&request, reinterpret_cast<const char*>(desc.requests) + i * stride, sizeof request);
  return request;
}

sgm_result checkRequest(const sgm_field& field, const sgm_chunk_request& request, sgm_error* error) {
  if (sgm_result r = checkLevel(field.content->world.settings().finest_cell, request.key.level, error); r != SGM_OK)
    return r;
  if (request.seams >> SGM_FACE_COUNT != 0)
    return fail(error, SGM_ERR_INVALID_ARGUMENT, "a chunk's seams have bits beyond the six faces");
  if ((request.coarser & ~kBlocksAround) != 0)
    return fail(error, SGM_ERR_INVALID_ARGUMENT, "a chunk's coarser has bits beyond the 26 blocks around it");
  if (request.reserved[0] != 0 || request.reserved[1] != 0)
    return fail(error, SGM_ERR_INVALID_ARGUMENT, "a chunk request's reserved words must be 0");
  const sgm::Result<sgm::ChunkGrid> grid = sgm::chunkGrid(field.content->world, keyOf(request.key));
  return grid ? SGM_OK : fail(error, grid.error());
}

/// Owns the finished meshes until they are passed to the caller; destroys them if an error occurs first.
class MadeMeshes {
 public:
  MadeMeshes(size_t count, std::pmr::memory_resource* memory) : meshes_(count, nullptr, memory) {}
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
  std::pmr::vector<sgm_mesh*> meshes_;
};

}  // namespace

sgm_result sgm_mesh_chunks(sgm_field* field, const sgm_chunks_desc* desc, sgm_mesh** meshes, sgm_error* error) {
  return guarded(error, [&]() -> sgm_result {
    if (sgm_result r = checkDesc(error, desc, "desc"); r != SGM_OK) return r;
    if (meshes == nullptr) return nullArgument(error, "meshes");
    std::fill_n(meshes, desc->count, nullptr);
    if (field == nullptr) return nullArgument(error, "field");
    if (sgm_result r = checkRequests(*desc, error); r != SGM_OK) return r;
    size_t stride = desc->request_stride;
    if (sgm_result r = checkStride<sgm_chunk_request>(error, stride, "desc.request_stride"); r != SGM_OK) return r;

    std::pmr::memory_resource* memory = &field->runtime.memory;
    std::pmr::vector<sgm::ChunkRequest> requests(memory);
    requests.reserve(desc->count);
    for (size_t i = 0; i < desc->count; ++i) {
      const sgm_chunk_request request = requestAt(*desc, stride, i);
      if (sgm_result r = checkRequest(*field, request, error); r != SGM_OK) return r;
      const auto seams = static_cast<uint8_t>(request.seams);
      const sgm::Neighbourhood coarser = request.coarser != 0 ? request.coarser : sgm::neighboursAcross(seams);
      sgm::ChunkRequest& own = requests.emplace_back();
      own.key = keyOf(request.key);
      own.seams = seams;
      own.coarser = coarser;
      own.keys = false;
      own.anchors = true;
      own.sharp = (desc->flags & SGM_MESHING_SHARP) != 0;
    }
    sgm::Progress progress;
    if (desc->progress != nullptr)
      progress = [desc](uint64_t done, uint64_t total) {
        return desc->progress(desc->progress_user, done, total) == 0;
      };
    sgm::Result<std::pmr::vector<sgm::PlacedChunk>> chunks =
        sgm::meshChunks(field->content->world, *field->content->backend, *field->runtime.jobs, requests, progress);
    if (!chunks) return fail(error, chunks.error());

    MadeMeshes made(desc->count, memory);
    std::pmr::vector<std::optional<sgm::Error>> errors(desc->count, memory);
    const auto finish = [&](size_t i) {
      // Move the chunk out of the array, so that its memory is freed as soon as it has been copied: a batch may contain
      // many chunks.
      sgm::PlacedChunk chunk = std::move((*chunks)[i]);
      const sgm::ProfileScope scope(field->runtime.profiler, sgm::zone::kPack);
      auto surface = std::allocate_shared<sgm::ChunkSurface>(std::pmr::polymorphic_allocator<>(memory),
                                                             surfaceOf(requests[i], std::move(chunk), nullptr, memory));
      if ((desc->flags & SGM_MESHING_TEXTURE) != 0 && !surface->mesh.indices.empty()) {
        sgm::Result<sgm::Unwrapped> texture =
            unwrapChunk(field->content->world, surface->mesh, surface->grid, nullptr, sgm::kTile, memory);
        if (!texture) {
          errors[i] = texture.error();
          return;
        }
        surface->texture = std::move(*texture);
      }
      made[i] = makeHandle<sgm_mesh>(field->runtime, std::move(surface));
    };
    // If there are many chunks, a job finishes up to 8 of them: most chunks are empty, and finishing an empty chunk
    // takes less time than scheduling a job.
    const size_t in_a_row = std::clamp<size_t>(desc->count / (4 * field->runtime.jobs->concurrency()), 1, 8);
    sgm::parallelFor(*field->runtime.jobs, (desc->count + in_a_row - 1) / in_a_row, [&](size_t row) {
      for (size_t i = row * in_a_row; i < std::min<size_t>((row + 1) * in_a_row, desc->count); ++i) finish(i);
    });
    for (const std::optional<sgm::Error>& one : errors) {
      if (one) return fail(error, *one);
    }
    made.handOver(meshes);
    return SGM_OK;
  });
}
