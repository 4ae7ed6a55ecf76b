#pragma once
// Meshes chunks and seams with the shaders of shaders/mesher/, and with the CPU for comparison.

#include <cstdint>
#include <optional>
#include <random>
#include <vector>

#include "backend/vulkan/batch_layout.h"
#include "conformance/vulkan_compute.h"
#include "mesh/body.h"
#include "mesh/seam.h"

namespace sgm::test {

/// A seam between a chunk and a coarser one, to be meshed.
struct SeamInput {
  size_t chunk;
  Face face;
  CoarseFace coarse;
};
struct MeshInput {
  std::vector<ChunkSamples> chunks;
  std::vector<bool> with_body;  ///< for each chunk, whether its body is meshed
  std::vector<SeamInput> seams;

  size_t bodies() const;
};

/// Capacities of the output buffers, in elements.
struct Room {
  uint32_t vertices, indices, cells;
};

/// The shaders' output. The parts are the bodies, followed by the seams. Guard words follow the capacity of each
/// buffer.
struct MeshOutput {
  batch::Head head;
  std::vector<batch::Part> parts;
  std::vector<Vertex> vertices;
  std::vector<uint32_t> indices;
  /// For each body, the counts of its 33^2 rows: vertices, indices and active cells before the row, and active cells in
  /// it.
  std::vector<std::array<uint32_t, 4>> rows;
  bool inputs_kept;  ///< whether the shaders left samples, signs, records and tables unchanged
  bool guards_kept;  ///< whether the shaders left everything after the used elements unchanged
};

/// The compiled shaders on a device. create() prints the reason and returns nullopt if there is no device.
class Mesher {
 public:
  static std::optional<Mesher> create();

  /// Runs the shaders. groups: number of workgroups of the kernel for triangles; 0: as many as the shaders compute.
  MeshOutput run(const MeshInput& input, Room room, uint32_t groups = 0) const;

  std::vector<std::string> messages() const { return compute_.messages(); }

 private:
  explicit Mesher(VulkanCompute compute) : compute_(std::move(compute)) {}

  VulkanCompute compute_;
  std::vector<ComputeShader> shaders_;
};

/// Meshes the same input on the CPU, including hashes.
std::vector<MeshPart> meshOnCpu(const MeshInput& input);

/// The capacities that exactly suffice for these parts.
Room roomFor(const MeshInput& input, const std::vector<MeshPart>& parts);

uint32_t activeCells(const ChunkSamples& samples);

/// Random samples: smooth, noisy, with isolated points, uniform, or of extreme size.
MeshInput randomInput(std::mt19937_64& random, size_t chunks);

/// Requires that the first `count` parts are equal, byte by byte.
void requireParts(const MeshOutput& output, const std::vector<MeshPart>& expected, size_t count);

}  // namespace sgm::test
