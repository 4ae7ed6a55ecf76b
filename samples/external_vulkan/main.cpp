// external_vulkan FILE.sgm [--frames N] [--compare K] [--size WxH] [--png FILE] [--cuda] [--validate]: an engine that
// provides its Vulkan device to the library, flies a viewer through a grammar's world, and draws the meshes from the
// buffers in which they were made, or with --cuda from buffers that CUDA has filled. Every K-th frame is also drawn
// from uploaded buffers, and both pictures must be equal.

#include <sgm/sgm.h>
#include <sgm/sgm_vulkan.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>

#include "../embed/grammar_file.h"
#include "../embed/handles.h"
#include "cave_path.h"
#include "flight.h"
#include "offscreen.h"
#include "picture.h"
#include "vulkan_device.h"

namespace {

constexpr int kSkipped = 77;  // exit status if there is no suitable device: nothing was tested
constexpr double kMetresPerFrame = 0.25;
// Minimum time of a frame, as on a 60 Hz display, so that the device also has time for meshing.
constexpr auto kFrameTime = std::chrono::milliseconds(16);
constexpr const char* kUsage =
    "usage: external_vulkan FILE.sgm [--frames N] [--compare K] [--size WxH] [--png FILE] [--cuda] [--validate]\n";

struct Options {
  std::string grammar, png;
  int frames = 120, compare = 10;
  VkExtent2D size{640, 360};
  bool cuda = false, validate = false;
};

std::optional<Options> parse(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const bool more = i + 1 < argc;
    unsigned width = 0, height = 0;
    if (word == "--validate") {
      options.validate = true;
    } else if (word == "--cuda") {
      options.cuda = true;
    } else if (word == "--frames" && more) {
      options.frames = std::atoi(argv[++i]);
    } else if (word == "--compare" && more) {
      options.compare = std::atoi(argv[++i]);
    } else if (word == "--size" && more && std::sscanf(argv[++i], "%ux%u", &width, &height) == 2) {
      options.size = {width, height};
    } else if (word == "--png" && more) {
      options.png = argv[++i];
    } else if (word.rfind("--", 0) != 0 && options.grammar.empty()) {
      options.grammar = word;
    } else {
      return {};
    }
  }
  const auto sensible = [](uint32_t edge) { return edge >= 1 && edge <= 4096; };
  if (options.grammar.empty() || options.frames < 1 || options.compare < 1) return {};
  if (!sensible(options.size.width) || !sensible(options.size.height)) return {};
  return options;
}

RuntimeOwner makeRuntime() {
  const sgm_log_sink log = {[](void*, sgm_log_level level, const char* message) {
                              if (level < SGM_LOG_WARNING) return;
                              std::fprintf(stderr, "external_vulkan: warning: %s\n", message);
                            },
                            nullptr};
  sgm_runtime_desc desc = SGM_RUNTIME_DESC_INIT;
  desc.log = &log;
  sgm_runtime* runtime = nullptr;
  sgm_error error = SGM_ERROR_INIT;
  must(sgm_runtime_create(&desc, &runtime, &error), error);
  return RuntimeOwner(runtime);
}

void lend(sgm_runtime* runtime, VulkanDevice& device) {
  const sgm_vulkan_device_desc desc = device.lend();
  sgm_error error = SGM_ERROR_INIT;
  must(sgm_runtime_lend_vulkan(runtime, &desc, &error), error);
}

FieldOwner makeField(sgm_runtime* runtime, const sgm_grammar* grammar, bool cuda) {
  sgm_field_desc desc = SGM_FIELD_DESC_INIT;
  desc.grammar = grammar;
  desc.seed = 7;
  desc.cell_units = SGM_UNITS_PER_METRE / 4;
  desc.backend = cuda ? SGM_BACKEND_CUDA : SGM_BACKEND_VULKAN;  // SGM_BACKEND_VULKAN also accepts software devices
  sgm_field* field = nullptr;
  sgm_error error = SGM_ERROR_INIT;
  must(sgm_field_create(runtime, &desc, &field, &error), error);
  return FieldOwner(field);
}

WorldOwner makeWorld(sgm_field* field) {
  sgm_world_desc desc = SGM_WORLD_DESC_INIT;
  desc.top_level = 4;
  desc.flags = SGM_WORLD_RESIDENT;
  desc.finest_distance = 14;
  desc.view_distance = 100;
  sgm_world* world = nullptr;
  sgm_error error = SGM_ERROR_INIT;
  must(sgm_world_create(field, &desc, &world, &error), error);
  return WorldOwner(world);
}

/// Whether everything outside the grammar's shapes is solid rock without end.
bool isClosed(const sgm_grammar* grammar) {
  sgm_domain_info domain = SGM_DOMAIN_INFO_INIT;
  if (sgm_grammar_domain(grammar, &domain) != SGM_OK) throw std::runtime_error("the grammar's domain is not known");
  return domain.infinite != 0 && domain.solid != 0;
}

Picture fly(Flight& flight, const CavePath& path, const Options& options) {
  flight.load(path.at(0));
  flight.draw(path.at(0));
  flight.check(path.at(0), true);
  for (int i = 1; i < options.frames; ++i) {
    const auto next = std::chrono::steady_clock::now() + kFrameTime;
    const ViewPoint view = path.at(i * kMetresPerFrame);
    flight.frame(view);
    if (i % options.compare == 0) flight.check(view, false);
    std::this_thread::sleep_until(next);
  }
  const ViewPoint last = path.at(options.frames * kMetresPerFrame);
  flight.load(last);
  flight.draw(last);
  return flight.check(last, true);
}

void print(const Flight& flight) {
  const DrawList& drawn = flight.drawn();
  std::printf("%llu frames, %zu chunks and %llu triangles in the last, %.1f MiB not uploaded, %zu pictures compared\n",
              static_cast<unsigned long long>(flight.frames()), drawn.records.size(),
              static_cast<unsigned long long>(drawn.triangles()),
              static_cast<double>(flight.scene().residentBytes()) / (1 << 20), flight.compared());
}

void run(const Options& options, Validation* validation) {
  std::optional<VulkanDevice> device;  // must outlive the runtime that uses it
  const RuntimeOwner runtime = makeRuntime();
  const GrammarOwner grammar = compileFile(runtime.get(), options.grammar.c_str());
  device.emplace(validation, options.cuda);
  lend(runtime.get(), *device);
  const FieldOwner field = makeField(runtime.get(), grammar.get(), options.cuda);
  const CavePath path(field.get(), options.frames * kMetresPerFrame);
  const WorldOwner world = makeWorld(field.get());
  const ChunkPipeline pipeline(device->handle(), options.size);
  Flight flight(*device, pipeline, world.get(), isClosed(grammar.get()));
  const Picture last = fly(flight, path, options);
  if (flight.scene().residentChunks() == 0) throw std::runtime_error("no chunk came by way of the device");
  if (!options.png.empty()) writePng(last, options.png);
  print(flight);
}

}  // namespace

int main(int argc, char** argv) {
  const std::optional<Options> options = parse(argc, argv);
  if (!options) {
    std::fputs(kUsage, stderr);
    return 2;
  }
  try {
    Validation validation;  // outlives the device, since the layer also reports faults in the device's destruction
    run(*options, options->validate ? &validation : nullptr);
    if (validation.messages > 0) throw std::runtime_error("the validation layer has found faults");
  } catch (const NoDevice& e) {
    const bool required = std::getenv("SGM_REQUIRE_VULKAN") != nullptr;
    std::fprintf(stderr, "external_vulkan: %s%s\n", required ? "" : "SKIPPED: ", e.what());
    return required ? 1 : kSkipped;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "external_vulkan: %s\n", e.what());
    return 1;
  }
  return 0;
}
