// What is added to a sum: `a`, or the morph of a and b, and the kernel of that (record_header.h).
Dual addend(Dual a, Dual b, uint P) {
  const uint how = PU(P, kHow);
  a = selDual((how & kByConstant) != 0u, opMorph(a, b, makeDual(PF(P, kBy), 0.0f, 0.0f, 0.0f, 0)), a);
  return selDual((how & kWeighs) != 0u, opKernel(a, P), a);
}
