#include "float_operations.h"

#include <cstring>
#include <utility>
#include <vector>

#include "base/kernel.h"

namespace sgm::counted {

using std::memcpy;

/// Records a graph of values: which value was computed from which others, since the last reset.
class Trace {
 public:
  enum Kind : uint8_t { counted, arithmetic, other };

  uint32_t add(Kind kind, uint32_t a, uint32_t b = 0, uint32_t c = 0) {
    nodes_.push_back({{a, b, c}, kind});
    return static_cast<uint32_t>(nodes_.size() - 1);
  }
  /// Marks a value as used, and counts the operations that compute it and all values on which it depends.
  void keep(uint32_t node) {
    pending_.push_back(node);
    while (!pending_.empty()) {
      Node& next = nodes_[pending_.back()];
      pending_.pop_back();
      const Kind kind = std::exchange(next.kind, counted);
      if (kind == counted) continue;
      ++(kind == arithmetic ? count_.arithmetic : count_.others);
      pending_.insert(pending_.end(), next.from, next.from + 3);
    }
  }
  void reset() { nodes_.assign(1, {{0, 0, 0}, counted}); }
  bench::OperationCount take() { return std::exchange(count_, {}); }

 private:
  struct Node {
    uint32_t from[3];  ///< operands, as indices into nodes_; 0 for a constant or no operand
    Kind kind;
  };
  std::vector<Node> nodes_ = {{{0, 0, 0}, counted}};
  std::vector<uint32_t> pending_;
  bench::OperationCount count_;
};

Trace& trace() {
  static thread_local Trace one;
  return one;
}

#define FN inline
using uint = uint32_t;
using Params = const uint32_t*;

FN float uniformFloat(uint u) {
  float f;
  memcpy(&f, &u, 4);
  return f;
}

/// A number that knows its node in the graph: the operation that computed it.
template <class T>
struct Traced {
  T v{};
  uint32_t node = 0;
  Traced() = default;
  Traced(T value, uint32_t of = 0) : v(value), node(of) {}
};
struct Real : Traced<float> {
  using Traced::Traced;
};
struct Int : Traced<int32_t> {
  using Traced::Traced;
};
struct Uint : Traced<uint32_t> {
  using Traced::Traced;
};
struct Bool : Traced<bool> {
  using Traced::Traced;
};

template <class A, class B>
uint32_t made(Trace::Kind kind, const A& a, const B& b) {
  return trace().add(kind, a.node, b.node);
}

FN Real operator+(Real a, Real b) { return {a.v + b.v, made(Trace::arithmetic, a, b)}; }
FN Real operator-(Real a, Real b) { return {a.v - b.v, made(Trace::arithmetic, a, b)}; }
FN Real operator*(Real a, Real b) { return {a.v * b.v, made(Trace::arithmetic, a, b)}; }
// A negation is not counted: hardware does it as a part of the operation that uses the result.
FN Real operator-(Real a) { return {-a.v, a.node}; }
FN Bool operator<(Real a, Real b) { return {a.v < b.v, made(Trace::other, a, b)}; }
FN Bool operator>(Real a, Real b) { return {a.v > b.v, made(Trace::other, a, b)}; }
FN Bool operator<=(Real a, Real b) { return {a.v <= b.v, made(Trace::other, a, b)}; }
FN Bool operator>=(Real a, Real b) { return {a.v >= b.v, made(Trace::other, a, b)}; }
FN Bool operator<(Int a, Int b) { return {a.v < b.v, made(Trace::other, a, b)}; }
FN Bool operator>(Int a, Int b) { return {a.v > b.v, made(Trace::other, a, b)}; }
FN Bool operator>=(Int a, Int b) { return {a.v >= b.v, made(Trace::other, a, b)}; }
FN Bool operator==(Int a, Int b) { return {a.v == b.v, made(Trace::other, a, b)}; }
FN Bool operator&&(Bool a, Bool b) { return {a.v && b.v, made(Trace::other, a, b)}; }
FN Bool operator||(Bool a, Bool b) { return {a.v || b.v, made(Trace::other, a, b)}; }
FN Bool operator!(Bool a) { return {!a.v, a.node}; }
FN Int operator&(Int a, Int b) { return {a.v & b.v, made(Trace::other, a, b)}; }
FN Int operator|(Int a, Int b) { return {a.v | b.v, made(Trace::other, a, b)}; }
FN Int operator^(Int a, Int b) { return {a.v ^ b.v, made(Trace::other, a, b)}; }
FN Int wrapOf(uint32_t bits, uint32_t node) { return {static_cast<int32_t>(bits), node}; }
FN uint32_t bitsOf(Int a) { return static_cast<uint32_t>(a.v); }
FN Int wrapAdd(Int a, Int b) { return wrapOf(bitsOf(a) + bitsOf(b), made(Trace::other, a, b)); }
FN Int wrapSub(Int a, Int b) { return wrapOf(bitsOf(a) - bitsOf(b), made(Trace::other, a, b)); }
FN Int wrapMul(Int a, Int b) { return wrapOf(bitsOf(a) * bitsOf(b), made(Trace::other, a, b)); }
FN Uint operator-(Uint a, Uint b) { return {a.v - b.v, made(Trace::other, a, b)}; }
FN Uint operator*(Uint a, Uint b) { return {a.v * b.v, made(Trace::other, a, b)}; }
FN Uint operator^(Uint a, Uint b) { return {a.v ^ b.v, made(Trace::other, a, b)}; }
FN Uint operator&(Uint a, Uint b) { return {a.v & b.v, made(Trace::other, a, b)}; }
FN Uint operator|(Uint a, Uint b) { return {a.v | b.v, made(Trace::other, a, b)}; }
FN Uint operator>>(Uint a, int count) { return {a.v >> count, trace().add(Trace::other, a.node)}; }
FN Uint operator<<(Uint a, int count) { return {a.v << count, trace().add(Trace::other, a.node)}; }

FN Real broadcast(float x) { return {x}; }
FN Int broadcastInt(int32_t x) { return {x}; }
FN Real bitsToReal(Uint u) { return {uniformFloat(u.v), u.node}; }
FN Uint realToBits(Real r) {
  uint32_t u;
  memcpy(&u, &r.v, 4);
  return {u, r.node};
}
FN Real gatherReal(Params P, Int i) { return {uniformFloat(P[i.v]), trace().add(Trace::other, i.node)}; }
FN Real toReal(Int i) { return {static_cast<float>(i.v), trace().add(Trace::other, i.node)}; }
FN Int toInt(Real r) { return {static_cast<int32_t>(r.v), trace().add(Trace::other, r.node)}; }
FN Int toIntBits(Uint u) { return {static_cast<int32_t>(u.v), u.node}; }
FN Uint toUintBits(Int i) { return {static_cast<uint32_t>(i.v), i.node}; }
FN Real sel(Bool c, Real a, Real b) { return {c.v ? a.v : b.v, trace().add(Trace::other, c.node, a.node, b.node)}; }
FN Int sel(Bool c, Int a, Int b) { return {c.v ? a.v : b.v, trace().add(Trace::other, c.node, a.node, b.node)}; }

constexpr size_t kLanes = 1;
FN Real loadReal(const uint32_t* p) { return {uniformFloat(*p)}; }
FN Int loadInt(const uint32_t* p) { return {static_cast<int32_t>(*p)}; }
FN void storeReal(Real r, uint32_t* p) {
  trace().keep(r.node);
  memcpy(p, &r.v, 4);
}
FN void storeInt(Int i, uint32_t* p) {
  trace().keep(i.node);
  *p = bitsOf(i);
}
FN uint64_t signMask(const uint32_t* p, size_t count) {
  uint64_t mask = 0;
  for (size_t i = 0; i < count; ++i) mask |= uint64_t{p[i] >> 31} << i;
  return mask;
}

#define SGM_WIDE
#include "common/common.h"
#include "field/evaluate_blocks.inl"
#undef SGM_WIDE

void samples(const ProgramView& program, const Points& points, EvalScratch& scratch, int32_t* q) {
  trace().reset();
  evaluateSamples(program, points, scratch, q);
}
void box(const ProgramView& program, const LatticeBox& lattice, EvalScratch& scratch, const LatticeSamples& out) {
  trace().reset();
  evaluateBox(program, lattice, scratch, out);
}

}  // namespace sgm::counted

namespace bench {

OperationCount takeOperationCount() { return sgm::counted::trace().take(); }

const sgm::FieldKernels& floatCountingKernels() {
  static const sgm::FieldKernels kernels{"counting floats", sgm::counted::samples, sgm::scalarKernels().attributes,
                                         sgm::counted::box};
  return kernels;
}

}  // namespace bench
