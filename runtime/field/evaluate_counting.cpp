#include "field/evaluate.h"

namespace sgm {

namespace {

void addOperations(const ProgramView& program, const Points& points, EvalScratch& scratch) {
  for (const ProgramGroup& group : program.groups) scratch.operations += uint64_t{group.count} * points.count;
}

void countSamples(const ProgramView& program, const Points& points, EvalScratch& scratch, int32_t* q) {
  addOperations(program, points, scratch);
  scalarKernels().samples(program, points, scratch, q);
}

void countAttributes(const ProgramView& program, const Points& points, EvalScratch& scratch, const Attributes& out) {
  addOperations(program, points, scratch);
  scalarKernels().attributes(program, points, scratch, out);
}

}  // namespace

const FieldKernels& countingKernels() {
  static constexpr FieldKernels kernels{"counting", countSamples, countAttributes};
  return kernels;
}

}  // namespace sgm
