// Tests sgm_runtime_desc.pipeline_folder with folders that cannot be used. Caching in a usable folder is tested where
// fewer shaders must be compiled (tests/unit/backend), and with the command (tests/cli/fly_test.sh).

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <mutex>

#include "fixture.h"
#include "temporary_folder.h"

namespace fs = std::filesystem;

namespace {

/// Returns true if there is a device to compile shaders for; otherwise prints a message.
bool haveDevice() {
  const RuntimeOwner runtime = makeRuntime();
  sgm_backend_info info = SGM_BACKEND_INFO_INIT;
  REQUIRE(sgm_backend_query(runtime.get(), SGM_BACKEND_VULKAN, &info, nullptr) == SGM_OK);
  if (info.usable != 0) return true;
  INFO(info.reason);
  REQUIRE(std::getenv("SGM_REQUIRE_VULKAN") == nullptr);
  std::fprintf(stderr, "SKIPPED: %s\n", info.reason);
  return false;
}

struct Warnings {
  std::mutex mutex;
  std::vector<std::string> texts;
};

/// Returns the warnings of a runtime with this pipeline folder while its device meshes a ball.
std::vector<std::string> warningsOfABall(const fs::path& folder) {
  Warnings warnings;
  const sgm_log_sink sink{[](void* user, sgm_log_level level, const char* message) {
                            if (level < SGM_LOG_WARNING) return;
                            auto& w = *static_cast<Warnings*>(user);
                            const std::lock_guard lock(w.mutex);
                            w.texts.emplace_back(message);
                          },
                          &warnings};
  {
    // This string is overwritten before meshing: the library must copy the path.
    std::string path = folder.string();
    sgm_runtime_desc desc = SGM_RUNTIME_DESC_INIT;
    desc.log = &sink;
    desc.pipeline_folder = path.c_str();
    const RuntimeOwner runtime = makeRuntime(&desc);
    path.assign(path.size(), 'x');
    const GrammarOwner grammar = compile(runtime.get(), kBall);
    sgm_field_desc field_desc = SGM_FIELD_DESC_INIT;
    field_desc.grammar = grammar.get();
    field_desc.cell_units = 256;
    field_desc.backend = SGM_BACKEND_VULKAN;
    sgm_field* made = nullptr;
    REQUIRE(sgm_field_create(runtime.get(), &field_desc, &made, nullptr) == SGM_OK);
    const FieldOwner field(made);
    const std::vector<MeshOwner> meshes = meshChunks(field.get(), {chunkAt({0, 0, 0, 0})});
    CHECK(viewOf(meshes[0]).index_count > 0);
    sgm_backend_info info = SGM_BACKEND_INFO_INIT;
    REQUIRE(sgm_backend_query(runtime.get(), SGM_BACKEND_VULKAN, &info, nullptr) == SGM_OK);
    CHECK(info.chunks == 1);
    CHECK(info.chunks_on_cpu == 0);
    CHECK(info.losses == 0);
  }
  return warnings.texts;
}

}  // namespace

TEST_CASE("a folder that cannot hold pipelines costs one line in the log", "[vulkan]") {
  if (!haveDevice()) return;
  const sgm::TemporaryFolder folder;
  std::ofstream(folder.path / "file") << "in the way";
  const std::vector<std::string> warnings = warningsOfABall(folder.path / "file" / "folder");
  REQUIRE(warnings.size() == 1);
  CHECK(warnings[0].find("compiled pipelines are not cached") != std::string::npos);
  CHECK(warnings[0].find((folder.path / "file" / "folder").string()) != std::string::npos);
  CHECK(sgm::contentOf(folder.path / "file") == "in the way");
}
