// Returns the value that an instruction adds to a sum: `a`, or the morph of a and b, or the kernel weight of one of
// these (record_header.h).
Dual addend(Dual a, Dual b, uint P) {
  if ((kKindsHigh & kSomeMorphs) != 0u) {
    a = selDual(HOW(P, kHowMorphs), opMorph(a, b, makeDual(PF(P, kByWord), 0.0f, 0.0f, 0.0f, 0)), a);
  }
  if ((kKindsHigh & kSomeWeighs) != 0u) a = selDual(HOW(P, kHowWeighs), opKernel(a, P), a);
  return a;
}
