#pragma once
// Meshes chunks and seams by the shaders of shaders/mesher/, and says what the CPU makes of them.

#include <cstdint>
#include <optional>
#include <random>
#include <vector>

#include "backend/vulkan/batch_layout.h"
#include "conformance/vulkan_compute.h"
#include "mesh/body.h"
#include "mesh/seam.h"

namespace sgm::test {

/// What is to be meshed.
struct SeamInput {
  size_t chunk;
  Face face;
  CoarseFace coarse;
};
struct MeshInput {
  std::vector<ChunkSamples> chunks;
  std::vector<bool> with_body;  ///< one a chunk
  std::vector<SeamInput> seams;

  size_t bodies() const;
};

/// How much room there is.
struct Room {
  uint32_t vertices, indices, cells;
};

/// What came back. Parts are the bodies, then the seams. Behind what each buffer has room for lie guard words.
struct MeshOutput {
  batch::Head head;
  std::vector<batch::Part> parts;
  std::vector<Vertex> vertices;
  std::vector<uint32_t> indices;
  std::vector<std::array<uint32_t, 4>> rows;  ///< 33^2 for each body: vertices, indices, cells before; active cells
  bool inputs_kept;                           ///< samples, signs, records and tables
  bool guards_kept;                           ///< and all that lies behind what is used
};

/// The shaders, ready. Skips, visibly, where there is no device.
class Mesher {
 public:
  static std::optional<Mesher> create();

  /// groups: of the kernel of triangles; 0 for as many as it asks for itself.
  MeshOutput run(const MeshInput& input, Room room, uint32_t groups = 0) const;

  std::vector<std::string> messages() const { return compute_.messages(); }

 private:
  explicit Mesher(VulkanCompute compute) : compute_(std::move(compute)) {}

  VulkanCompute compute_;
  std::vector<ComputeShader> shaders_;
};

/// The same on the CPU, hashes included.
std::vector<MeshPart> meshOnCpu(const MeshInput& input);

/// Room for all of these parts, and nothing to spare.
Room roomFor(const MeshInput& input, const std::vector<MeshPart>& parts);

uint32_t activeCells(const ChunkSamples& samples);

/// Random samples: smooth, noisy, lone points, all the same, or of extreme size.
MeshInput randomInput(std::mt19937_64& random, size_t chunks);

/// Requires that parts first..last-1 have come out, byte by byte.
void requireParts(const MeshOutput& output, const std::vector<MeshPart>& expected, size_t count);

}  // namespace sgm::test
