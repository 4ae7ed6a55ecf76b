// Tests an engine that provides its CUDA context through the C interface, and reads the meshes in device memory. With
// LD_LIBRARY_PATH set, libcuda.so.1 is a simulated driver, whose GPU memory is the host's.

#include <cstdlib>
#include <cstring>
#include <thread>

#include "cuda_lender.h"
#include "resident_worlds.h"
#include "rounds.h"

extern "C" int sgm_cuda_inits_c(void);
extern "C" int sgm_cuda_inits_cpp(void);

namespace {

void checkPart(const sgm_mesh_view& view, const sgm_mesh_range& range, const sgm_cuda_part& part) {
  REQUIRE((part.vertices != 0) == (range.index_count > 0));
  CHECK(part.vertex_count == range.vertex_count);
  CHECK(part.index_count == range.index_count);
  if (range.index_count == 0) return;
  CHECK(part.vertices % 256 + part.indices % 256 == 0);
  const auto* vertices = reinterpret_cast<const sgm_vertex*>(part.vertices);
  CHECK(std::memcmp(vertices, view.vertices + range.first_vertex, part.vertex_count * sizeof(sgm_vertex)) == 0);
  const auto* indices = reinterpret_cast<const uint32_t*>(part.indices);
  size_t different = 0;
  for (uint32_t i = 0; i < part.index_count; ++i) {
    different += indices[i] + range.first_vertex != view.indices[range.first_index + i] ? 1u : 0u;
  }
  CHECK(different == 0);
}

/// Checks that a mesh has the same bytes on the GPU and on the host. Returns the number of triangles.
size_t checkMesh(const MeshOwner& mesh) {
  const sgm_mesh_view view = viewOf(mesh);
  sgm_cuda_mesh_view place = SGM_CUDA_MESH_VIEW_INIT;
  sgm_error error = SGM_ERROR_INIT;
  const sgm_result result = sgm_mesh_get_cuda_view(mesh.get(), &place, &error);
  INFO(error.message);
  REQUIRE(result == SGM_OK);
  checkPart(view, view.body, place.body);
  for (size_t face = 0; face < 6; ++face) checkPart(view, view.seams[face], place.seams[face]);
  return view.index_count / 3;
}

}  // namespace

TEST_CASE("what the CUDA header's macros set is the same in C and in C++", "[cuda]") {
  CHECK(sgm_cuda_inits_c() == 1);
  CHECK(sgm_cuda_inits_cpp() == 1);
}

TEST_CASE("a mesh lies in the lent context with the bytes that the host sees, wherever the viewer goes", "[cuda]") {
  const bool with_stream = GENERATE(false, true);
  CAPTURE(with_stream);
  const CudaLender lender(with_stream);
  const RuntimeOwner runtime = lender.runtime();
  {
    const GrammarOwner grammar = compile(runtime.get(), kLumps);
    const FieldOwner field = makeField(runtime.get(), grammar.get(), 256, SGM_BACKEND_CUDA);
    wanderBeside(field.get(), kLumps, [&](const MeshOwner& mesh) {
      CHECK(infoOf(runtime, SGM_BACKEND_CUDA).resident > 0);
      return checkMesh(mesh);
    });
    CHECK(infoOf(runtime, SGM_BACKEND_CUDA).chunks_on_cpu == 0);
  }
  CHECK(infoOf(runtime, SGM_BACKEND_CUDA).resident == 0);
}

TEST_CASE("a dig lies in the lent context, and what has no room there says so", "[cuda]") {
  const CudaLender lender;
  for (const uint64_t bytes : {uint64_t{0}, uint64_t{60000}}) {
    CAPTURE(bytes);
    const RuntimeOwner runtime = makeRuntime();
    sgm_cuda_device_desc desc = lender.lend();
    desc.mesh_bytes = bytes;
    REQUIRE(sgm_runtime_lend_cuda(runtime.get(), &desc, nullptr) == SGM_OK);
    const GrammarOwner grammar = compile(runtime.get(), kBalls);
    const FieldOwner field = makeField(runtime.get(), grammar.get(), 256, SGM_BACKEND_AUTO);
    const WorldOwner world = makeWorld(field.get(), SGM_WORLD_RESIDENT);
    look(world.get(), 0, 0);
    waitIdle(world.get());
    sgm_brush brush = SGM_BRUSH_INIT;
    for (int32_t& place : brush.from) place = 12 * SGM_UNITS_PER_METRE;
    brush.radius = 3 * SGM_UNITS_PER_METRE;
    sgm_edit_id id{};
    REQUIRE(sgm_world_edit(world.get(), &brush, &id, nullptr) == SGM_OK);
    waitIdle(world.get());
    size_t there = 0, missing = 0;
    for (const MeshOwner& mesh : drawnOf(world.get())) {
      sgm_cuda_mesh_view view = SGM_CUDA_MESH_VIEW_INIT;
      sgm_error error = SGM_ERROR_INIT;
      const sgm_result result = sgm_mesh_get_cuda_view(mesh.get(), &view, &error);
      REQUIRE((result == SGM_OK || result == SGM_ERR_NOT_FOUND));
      ++(result == SGM_OK ? there : missing);
      if (result == SGM_OK) checkMesh(mesh);
      if (result != SGM_OK) CHECK_THAT(error.message, Catch::Contains("mesh_bytes"));
    }
    CHECK(there > 0);
    CHECK((missing > 0) == (bytes > 0));
  }
}

TEST_CASE("meshes outlive the world that they were streamed in, as CUDA's", "[cuda]") {
  const CudaLender lender;
  const RuntimeOwner runtime = lender.runtime();
  std::vector<MeshOwner> meshes;
  {
    const GrammarOwner grammar = compile(runtime.get(), kBalls);
    const FieldOwner field = makeField(runtime.get(), grammar.get(), 256, SGM_BACKEND_CUDA);
    const WorldOwner world = makeWorld(field.get(), SGM_WORLD_RESIDENT);
    look(world.get(), 0, 0);
    waitIdle(world.get());
    meshes = drawnOf(world.get());
  }
  size_t triangles = 0;
  for (const MeshOwner& mesh : meshes) triangles += checkMesh(mesh);
  CHECK(triangles > 0);
}

TEST_CASE("two threads mesh on one lent stream, each what it would alone", "[cuda]") {
  const CudaLender lender(true);
  const RuntimeOwner runtime = lender.runtime();
  const GrammarOwner grammar = compile(runtime.get(), kLumps);
  const FieldOwner field = makeField(runtime.get(), grammar.get(), 256, SGM_BACKEND_CUDA);
  const FieldOwner on_cpu = makeField(runtime.get(), grammar.get(), 256, SGM_BACKEND_CPU);
  const auto requestsOf = [](int32_t first) {
    std::vector<sgm_chunk_request> requests;
    for (int32_t x = 0; x < 6; ++x) {
      for (int32_t z = 0; z < 6; ++z) requests.push_back(chunkAt({0, first + x, 0, z}, 63));
    }
    return requests;
  };
  const auto hashesOf = [&](const FieldOwner& of, int32_t first) {
    std::vector<uint64_t> hashes;
    for (const MeshOwner& mesh : meshChunks(of.get(), requestsOf(first))) hashes.push_back(viewOf(mesh).hash);
    return hashes;
  };
  for (unsigned round = 0; round < sgm::rounds(4); ++round) {
    const auto first = static_cast<int32_t>(12 * round);
    std::vector<uint64_t> left, right;
    std::thread other([&] { right = hashesOf(field, first + 6); });
    left = hashesOf(field, first);
    other.join();
    CHECK(left == hashesOf(on_cpu, first));
    CHECK(right == hashesOf(on_cpu, first + 6));
  }
  CHECK(infoOf(runtime, SGM_BACKEND_CUDA).chunks_on_cpu == 0);
}

TEST_CASE("of a lent context that was lost nothing is shown, and the stream goes on", "[cuda]") {
  const CudaLender lender;
  const RuntimeOwner runtime = lender.runtime();
  const GrammarOwner grammar = compile(runtime.get(), kBalls);
  const FieldOwner field = makeField(runtime.get(), grammar.get(), 256, SGM_BACKEND_CUDA);
  const WorldOwner world = makeWorld(field.get(), SGM_WORLD_RESIDENT);
  look(world.get(), 0, 0);
  waitIdle(world.get());
  std::vector<MeshOwner> before = drawnOf(world.get());
  std::erase_if(before, [](const MeshOwner& mesh) { return viewOf(mesh).index_count == 0; });
  REQUIRE(!before.empty());
  sgm::cuda::FakeState& gpu = pretendedGpu();
  gpu.fail_call = "launchKernel";
  gpu.fail_nth = 1;
  gpu.fail_result = 700;
  gpu.lasts = true;
  look(world.get(), 300, 0);
  waitIdle(world.get());
  CHECK(infoOf(runtime, SGM_BACKEND_CUDA).losses == 1);
  CHECK(infoOf(runtime, SGM_BACKEND_CUDA).chunks_on_cpu > 0);
  sgm_error error = SGM_ERROR_INIT;
  sgm_cuda_mesh_view view = SGM_CUDA_MESH_VIEW_INIT;
  CHECK(sgm_mesh_get_cuda_view(before[0].get(), &view, &error) == SGM_ERR_DEVICE_LOST);
  CHECK_THAT(error.message, Catch::Contains("was lost"));
  size_t since = 0;
  for (const MeshOwner& mesh : drawnOf(world.get())) {
    if (viewOf(mesh).index_count == 0) continue;
    ++since;
    CHECK(sgm_mesh_get_cuda_view(mesh.get(), &view, &error) == SGM_ERR_NOT_FOUND);
  }
  CHECK(since > 0);
  gpu.fail_call.clear();
  gpu.fail_nth = 0;
  gpu.lasts = false;
}

TEST_CASE("a context that cannot be lent is refused, for a reason, and changes nothing", "[cuda]") {
  const CudaLender lender;
  const RuntimeOwner runtime = makeRuntime();
  const sgm_cuda_device_desc good = lender.lend();
  sgm_error error = SGM_ERROR_INIT;
  const auto refused = [&](sgm_result result, const char* word, const auto& change) {
    sgm_cuda_device_desc desc = good;
    change(desc);
    CHECK(sgm_runtime_lend_cuda(runtime.get(), &desc, &error) == result);
    CHECK_THAT(error.message, Catch::Contains(word));
  };
  CHECK(sgm_runtime_lend_cuda(nullptr, &good, nullptr) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(sgm_runtime_lend_cuda(runtime.get(), nullptr, nullptr) == SGM_ERR_INVALID_ARGUMENT);
  refused(SGM_ERR_STRUCT_SIZE, "struct_size", [](auto& d) { d.struct_size = 8; });
  refused(SGM_ERR_UNSUPPORTED, "next", [](auto& d) { d.next = &d; });
  refused(SGM_ERR_INVALID_ARGUMENT, "context", [](auto& d) { d.context = nullptr; });
  refused(SGM_ERR_INVALID_ARGUMENT, "CU_STREAM_PER_THREAD",
          [](auto& d) { d.stream = reinterpret_cast<CUstream_st*>(uintptr_t{2}); });
  // A query does not count as use of the backend: the engine may still provide its context. Then SGM_BACKEND_AUTO uses
  // this context, too.
  CHECK(infoOf(runtime, SGM_BACKEND_AUTO).backend == SGM_BACKEND_CUDA);
  REQUIRE(sgm_runtime_lend_cuda(runtime.get(), &good, nullptr) == SGM_OK);
  refused(SGM_ERR_BUSY, "already has a CUDA device", [](auto&) {});
  CHECK(infoOf(runtime, SGM_BACKEND_AUTO).backend == SGM_BACKEND_CUDA);
  const RuntimeOwner used = makeRuntime();
  const GrammarOwner grammar = compile(used.get(), kBalls);
  const FieldOwner field = makeField(used.get(), grammar.get(), 256, SGM_BACKEND_CUDA);
  CHECK(sgm_runtime_lend_cuda(used.get(), &good, &error) == SGM_ERR_BUSY);
}

TEST_CASE("auto says why it passes over a driver that is there", "[cuda]") {
  std::string said;
  const sgm_log_sink sink{
      [](void* user, sgm_log_level, const char* message) { *static_cast<std::string*>(user) += message; }, &said};
  sgm_runtime_desc desc = SGM_RUNTIME_DESC_INIT;
  desc.log = &sink;
  const RuntimeOwner runtime = makeRuntime(&desc);
  sgm::cuda::FakeState& gpu = pretendedGpu();
  gpu.memory_pools = 0;
  CHECK(infoOf(runtime, SGM_BACKEND_AUTO).backend != SGM_BACKEND_CUDA);
  gpu.memory_pools = 1;
  CHECK_THAT(said, Catch::Contains("backend auto skips CUDA: ") && Catch::Contains("memory pools"));
}

TEST_CASE("what is not in a lent context says so", "[cuda]") {
  const CudaLender lender;
  const RuntimeOwner runtime = lender.runtime();
  const GrammarOwner grammar = compile(runtime.get(), kBalls);
  const FieldOwner on_cpu = makeField(runtime.get(), grammar.get(), 256, SGM_BACKEND_CPU);
  checkNothingBorrowed(on_cpu.get(), "sgm_runtime_lend_cuda", sgm_cuda_mesh_view SGM_CUDA_MESH_VIEW_INIT,
                       sgm_mesh_get_cuda_view, [](const sgm_cuda_mesh_view& view) { return view.body.vertices == 0; });
}
