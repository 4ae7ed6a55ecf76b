#pragma once
// Evaluators of field programs. Every one gives the same bits: the scalar one here is the measure of the others.

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "field/program.h"

namespace sgm {

inline constexpr size_t kEvalBlock = 256;  ///< points that pass through a program together, in cache

/// Scratch of one thread: reused, grows once to the largest program.
class EvalScratch {
 public:
  explicit EvalScratch(std::pmr::memory_resource* memory = std::pmr::get_default_resource()) : words_(memory) {}
  uint32_t* reserve(size_t words) {
    if (words_.size() < words) words_.resize(words);
    return words_.data();
  }

  uint64_t operations = 0;  ///< what countingKernels() has added up, and nobody else touches

 private:
  std::pmr::vector<uint32_t> words_;
};

/// Points by axis, in units; not owned.
struct Points {
  const int32_t* x = nullptr;
  const int32_t* y = nullptr;
  const int32_t* z = nullptr;
  size_t count = 0;
};

/// Points of a lattice: origin + step * (i, j, k) in units, i fastest. size[0] * size[1] is at most kEvalBlock.
struct LatticeBox {
  Int3 origin;
  int32_t step = 1;
  std::array<size_t, 3> size{};
};

/// Where a box's samples go: Q of (i, j, k) to q[i + j * row + k * plane]; and of a negative one bit first_bit + i of
/// signs[j + k * sign_plane] is set.
struct LatticeSamples {
  int32_t* q = nullptr;
  size_t row = 0, plane = 0;
  uint64_t* signs = nullptr;
  size_t sign_plane = 0, first_bit = 0;
};

/// Where attributes go, each `count` long; null where not wanted.
struct Attributes {
  float* value = nullptr;  ///< units
  float* gradient_x = nullptr;
  float* gradient_y = nullptr;
  float* gradient_z = nullptr;
  int16_t* normal_x = nullptr;  ///< octahedral, as in Vertex
  int16_t* normal_y = nullptr;
  uint32_t* label = nullptr;  ///< tag << 16 | material
};

/// One instruction set's evaluator. The functions are pure but for scratch; any count of points, 0 included.
struct FieldKernels {
  const char* name;
  void (*samples)(const ProgramView&, const Points&, EvalScratch&, int32_t* q);
  void (*attributes)(const ProgramView&, const Points&, EvalScratch&, const Attributes&);
  void (*box)(const ProgramView&, const LatticeBox&, EvalScratch&, const LatticeSamples&);
};

/// Plain float, one point at a time.
const FieldKernels& scalarKernels();

/// As scalarKernels(), and adds to EvalScratch::operations the instructions of the program times the points: what every
/// evaluator of this interface does, but for whole vectors at a block's end.
const FieldKernels& countingKernels();

}  // namespace sgm
