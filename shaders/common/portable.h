// The subset of GLSL, C++ and CUDA in which the functions of fields are written, once for all backends (arithmetic
// contract, rule 2).
//
// Allowed on values are + - *, comparisons, conversions and integer operations; conditions use sel() instead of
// branches. A value that differs from sample to sample has type Real, Int, Uint or Bool; a value that is equal for all
// samples has type float, int or uint. PF, PI and PU read a parameter word of an op, the same word for all samples; the
// word's number must be a constant. QF, QI and QU do the same for a number that is not a constant, but below 28; RF, RI
// and RU for any number. On some backends these reads are slower. gatherReal can read a different word for each
// sample. No word may be read on the right of && or ||, or in a branch that not all samples take: the invocations of a
// shader exchange words, and one that does not take part would supply undefined words. Every product or sum that is an
// operand of a sum must be a local variable declared PRECISE, so that GLSL does not contract it. The headers here have
// no include guards: a C++ source includes common.h once in each namespace for which it has defined the types (scalar
// types below, vectors in backend/cpu/wide.h).

#ifndef __cplusplus

#define FN
#define PRECISE precise
#define Real float
#define Int int
#define Uint uint
#define Bool bool
#define Params uint
#ifndef PU  // parameter access by default; a shader may define these macros differently, if it stores parameters in
            // another way
#define PU(P, i) params[(P) + uint(i)]
#define QU(P, i) PU(P, i)
#define RU(P, i) PU(P, i)
#define gatherReal(P, i) uintBitsToFloat(params[(P) + uint(i)])
#endif
#define PF(P, i) uintBitsToFloat(PU(P, i))
#define PI(P, i) int(PU(P, i))
#define QF(P, i) uintBitsToFloat(QU(P, i))
#define QI(P, i) int(QU(P, i))
#define RF(P, i) uintBitsToFloat(RU(P, i))
#define RI(P, i) int(RU(P, i))
#define toReal(i) float(i)
#define toInt(r) int(r)
#define toIntBits(u) int(u)
#define toUintBits(i) uint(i)
#define bitsToReal(u) uintBitsToFloat(u)
#define realToBits(r) floatBitsToUint(r)
#define broadcast(x) (x)
#define broadcastInt(x) (x)
FN Real sel(Bool c, Real a, Real b) { return c ? a : b; }
FN Int sel(Bool c, Int a, Int b) { return c ? a : b; }
FN Int wrapAdd(Int a, Int b) { return a + b; }
FN Int wrapSub(Int a, Int b) { return a - b; }
FN Int wrapMul(Int a, Int b) { return a * b; }

#else

#define PRECISE
#define PI(P, i) static_cast<int>((P)[i])
#define PU(P, i) (P)[i]
#define PF(P, i) uniformFloat((P)[i])
#define QF(P, i) PF(P, i)
#define QI(P, i) PI(P, i)
#define RF(P, i) PF(P, i)
#define RI(P, i) PI(P, i)

#ifndef SGM_WIDE
// Scalar types, for the reference evaluator. All other backends must reproduce its results bit for bit.
#ifdef __CUDACC__
#define FN __host__ __device__ inline
#else
#define FN [[gnu::always_inline]] inline
#endif
typedef uint32_t uint;
typedef float Real;
typedef int32_t Int;
typedef uint32_t Uint;
typedef bool Bool;
typedef const uint32_t* Params;
FN float uniformFloat(uint u) {
  float f;
  memcpy(&f, &u, 4);
  return f;
}
FN Real bitsToReal(Uint u) { return uniformFloat(u); }
FN Uint realToBits(Real r) {
  Uint u;
  memcpy(&u, &r, 4);
  return u;
}
FN Real gatherReal(Params P, Int i) { return uniformFloat(P[i]); }
FN Real toReal(Int i) { return static_cast<Real>(i); }
FN Int toInt(Real r) { return static_cast<Int>(r); }
FN Int toIntBits(Uint u) { return static_cast<Int>(u); }
FN Uint toUintBits(Int i) { return static_cast<Uint>(i); }
FN Real broadcast(float x) { return x; }
FN Int broadcastInt(int x) { return x; }
FN Real sel(Bool c, Real a, Real b) { return c ? a : b; }
FN Int sel(Bool c, Int a, Int b) { return c ? a : b; }
FN Int wrapAdd(Int a, Int b) { return static_cast<Int>(static_cast<Uint>(a) + static_cast<Uint>(b)); }
FN Int wrapSub(Int a, Int b) { return static_cast<Int>(static_cast<Uint>(a) - static_cast<Uint>(b)); }
FN Int wrapMul(Int a, Int b) { return static_cast<Int>(static_cast<Uint>(a) * static_cast<Uint>(b)); }
#endif

#endif

struct Vec3 {
  Real x, y, z;
};

// A value, its gradient per world unit, and the label (tag << 16 | material) of the shape that determines it. If only
// the value is used, the compiler removes the rest.
struct Dual {
  Real v, x, y, z;
  Int label;
};

FN Vec3 makeVec3(Real x, Real y, Real z) {
  Vec3 r;
  r.x = x;
  r.y = y;
  r.z = z;
  return r;
}

FN Dual makeDual(Real v, Real x, Real y, Real z, Int label) {
  Dual r;
  r.v = v;
  r.x = x;
  r.y = y;
  r.z = z;
  r.label = label;
  return r;
}
