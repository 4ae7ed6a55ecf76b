#include "field/evaluate.h"

namespace sgm {

namespace {

void addOperations(const ProgramView& program, size_t points, EvalScratch& scratch) {
  for (const ProgramGroup& group : program.groups) scratch.operations += uint64_t{group.count} * points;
}

void countSamples(const ProgramView& program, const Points& points, EvalScratch& scratch, int32_t* q) {
  addOperations(program, points.count, scratch);
  scalarKernels().samples(program, points, scratch, q);
}

void countAttributes(const ProgramView& program, const Points& points, EvalScratch& scratch, const Attributes& out) {
  addOperations(program, points.count, scratch);
  scalarKernels().attributes(program, points, scratch, out);
}

void countBox(const ProgramView& program, const LatticeBox& box, EvalScratch& scratch, const LatticeSamples& out) {
  addOperations(program, box.size[0] * box.size[1] * box.size[2], scratch);
  scalarKernels().box(program, box, scratch, out);
}

}  // namespace

const FieldKernels& countingKernels() {
  static constexpr FieldKernels kernels{"counting", countSamples, countAttributes, countBox};
  return kernels;
}

}  // namespace sgm
