#pragma once
// Evaluators of field programs. All of them compute the same bits; the scalar evaluator here is the reference.

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "field/program.h"

namespace sgm {

/// number of points that an evaluator processes together; so few that their registers fit in the processor's cache
inline constexpr size_t kEvalBlock = 256;

/// Scratch memory of one thread. It can be reused, and grows to the size of the largest program.
class EvalScratch {
 public:
  explicit EvalScratch(std::pmr::memory_resource* memory = std::pmr::get_default_resource()) : words_(memory) {}
  uint32_t* reserve(size_t words) {
    if (words_.size() < words) words_.resize(words);
    return words_.data();
  }

  uint64_t operations = 0;  ///< number of operations, counted by countingKernels() only

 private:
  std::pmr::vector<uint32_t> words_;
};

/// Coordinates of points in units, one array per axis. Does not own the arrays.
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

/// The destination of the samples of a box. Sample (i, j, k) is written to q[i + j * row + k * plane]. If the sample is
/// negative (solid), bit first_bit + i of signs[j + k * sign_plane] is set.
struct LatticeSamples {
  int32_t* q = nullptr;
  size_t row = 0, plane = 0;
  uint64_t* signs = nullptr;
  size_t sign_plane = 0, first_bit = 0;
};

/// The destination of attributes: arrays of `count` elements each, or null if an attribute is not wanted.
struct Attributes {
  float* value = nullptr;  ///< units
  float* gradient_x = nullptr;
  float* gradient_y = nullptr;
  float* gradient_z = nullptr;
  int16_t* normal_x = nullptr;  ///< octahedral normal in two components, packed as in Vertex
  int16_t* normal_y = nullptr;
  uint32_t* label = nullptr;  ///< tag << 16 | material
};

/// The functions of an evaluator for one instruction set. They are pure except for the scratch memory, and accept any
/// number of points, including 0.
struct FieldKernels {
  const char* name;
  void (*samples)(const ProgramView&, const Points&, EvalScratch&, int32_t* q);
  void (*attributes)(const ProgramView&, const Points&, EvalScratch&, const Attributes&);
  void (*box)(const ProgramView&, const LatticeBox&, EvalScratch&, const LatticeSamples&);
};

/// Returns the evaluator that computes one point at a time with plain floats.
const FieldKernels& scalarKernels();

/// Same as scalarKernels(), but counts the work: adds the number of instructions times the number of points to
/// EvalScratch::operations. Every evaluator of this interface does the same work, except that a vector evaluator also
/// computes the unused lanes of a block's last vector.
const FieldKernels& countingKernels();

}  // namespace sgm
