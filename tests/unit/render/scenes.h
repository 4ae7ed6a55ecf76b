#pragma once
// Small meshes to draw, and the device that draws them.

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "catch.h"
#include "tools/render/renderer.h"

namespace sgm {

struct TestMesh {
  std::vector<RenderVertex> vertices;
  std::vector<uint32_t> indices;
};

/// The mesh of a solid sphere, or of a hollow one: void inside, endless rock outside.
inline TestMesh sphereMesh(glm::vec3 centre, float radius, bool hollow, int rings = 24) {
  TestMesh mesh;
  const int around = 2 * rings;
  for (int ring = 0; ring <= rings; ++ring) {
    for (int i = 0; i < around; ++i) {
      const float a = 3.14159265f * static_cast<float>(ring) / static_cast<float>(rings);
      const float b = 6.2831853f * static_cast<float>(i) / static_cast<float>(around);
      const glm::vec3 n(std::sin(a) * std::cos(b), std::cos(a), std::sin(a) * std::sin(b));
      mesh.vertices.push_back({centre + n * radius, hollow ? -n : n, 0});
    }
  }
  const auto at = [&](int ring, int i) { return static_cast<uint32_t>(ring * around + i % around); };
  for (int ring = 0; ring < rings; ++ring) {
    for (int i = 0; i < around; ++i) {
      const uint32_t a = at(ring, i), b = at(ring, i + 1), c = at(ring + 1, i), d = at(ring + 1, i + 1);
      for (const auto& [p, q, r] : {std::array{a, b, c}, std::array{b, d, c}}) {
        mesh.indices.insert(mesh.indices.end(), {p, hollow ? r : q, hollow ? q : r});
      }
    }
  }
  return mesh;
}

inline bool vulkanRequired() { return std::getenv("SGM_REQUIRE_VULKAN") != nullptr; }

/// Makes a renderer with the validation layer; nullopt, after printing the reason, if this machine has no Vulkan
/// device.
inline std::optional<Renderer> testRenderer() {
  auto gpus = listGpus();
  if (!gpus) {
    INFO(gpus.error().message);
    REQUIRE(!vulkanRequired());
    std::fprintf(stderr, "SKIPPED: %s\n", gpus.error().message.c_str());
    return {};
  }
  GpuOptions options;
  options.validation = true;
  auto renderer = Renderer::create(options);
  INFO((renderer ? std::string() : renderer.error().message));
  REQUIRE(renderer);
  return std::move(*renderer);
}

/// The mean of red, green and blue over a square of `side` pixels around (x, y), 0..255.
inline double brightness(const Image& image, int x, int y, int side) {
  double sum = 0;
  int count = 0;
  for (int v = y - side / 2; v <= y + side / 2; ++v) {
    for (int u = x - side / 2; u <= x + side / 2; ++u) {
      if (u < 0 || v < 0 || u >= image.width || v >= image.height) continue;
      for (int c = 0; c < 3; ++c) sum += image.rgba[static_cast<size_t>(4 * (v * image.width + u) + c)];
      count += 3;
    }
  }
  return sum / count;
}

}  // namespace sgm
