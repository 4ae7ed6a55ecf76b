#include "backend/vulkan/case_tables.h"

#include "mesh/tables.h"

namespace sgm {
namespace {

using namespace case_layout;

constexpr size_t kCubeCount = 256, kSeamCount = 8192;
static_assert(kCubeCases % 4 == 0, "the shaders read four cases at a time");
static_assert(kSeamCases == kCubeCases + 4 * kCubeCount);
static_assert(kSeamFaces == kSeamCases + kSeamCount);
static_assert(kSeamBytes == kSeamFaces + kSeamEdges);
static_assert(kTableWords == (kSeamBytes + (kSeamLoopBytes + 3) / 4 + 3) / 4 * 4);
static_assert(kSeamLoopBytes < 1u << kSeamTrianglesShift);

void packCube(size_t cube_case, uint32_t* words) {
  uint64_t edges = 0;
  uint32_t lengths = 0, forbidden = 0;
  int edge_bit = 0, length_bit = 0, chord_bit = 0;
  const uint8_t* end = kCubeLoops + kCubeLoopStart[cube_case + 1];
  for (const uint8_t* loop = kCubeLoops + kCubeLoopStart[cube_case]; loop != end;) {
    const int n = *loop++;
    lengths |= static_cast<uint32_t>(n) << length_bit;
    length_bit += 3;
    for (int j = 0; j < n; ++j) {
      edges |= uint64_t{loop[j]} << edge_bit;
      edge_bit += 4;
      for (int i = 0; i + 1 < j; ++i, ++chord_bit) {
        const uint32_t from = chordMask(kCubeEdgeFaces[loop[i]], loop[i], n);
        const uint32_t to = chordMask(kCubeEdgeFaces[loop[j]], loop[j], n);
        forbidden |= uint32_t{(from & to) != 0} << chord_bit;
      }
    }
    loop += n;
  }
  words[0] = static_cast<uint32_t>(edges);
  words[1] = static_cast<uint32_t>(edges >> 32) | lengths << 16;
  words[2] = forbidden;
}

}  // namespace

std::vector<uint32_t> caseTables() {
  std::vector<uint32_t> words(kTableWords);
  for (size_t c = 0; c < kCubeCount; ++c) packCube(c, &words[kCubeCases + 4 * c]);
  for (size_t c = 0; c < kSeamCount; ++c)
    words[kSeamCases + c] = kSeamLoopStart[c] | uint32_t{kSeamTriangles[c]} << kSeamTrianglesShift;
  for (size_t e = 0; e < kSeamEdges; ++e) words[kSeamFaces + e] = kSeamEdgeFaces[e];
  for (size_t i = 0; i < kSeamLoopBytes; ++i) words[kSeamBytes + i / 4] |= uint32_t{kSeamLoops[i]} << 8 * (i % 4);
  return words;
}

}  // namespace sgm
