#pragma once
// The values of expressions.

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "derive/draft.h"
#include "derive/frame.h"
#include "derive/lattice.h"
#include "grammar/syntax/builtins.h"

namespace sgm::interpret {

/// A value of an expression. Members used by each kind: numbers, vectors and pairs: n; a cell: `cell`; a face: `cell`
/// and `axis`; a list of faces: `faces`; a range: n[0] and n[1]; a segment: `first`; a list of segments and a plan:
/// `first` and `count`.
struct Value {
  ValueKind kind = ValueKind::number;
  std::array<Num, 3> n{};
  Int3 cell;
  int axis = 0;
  std::vector<FaceId> faces;
  uint32_t first = 0, count = 0;  ///< range of indices in the evaluator's list of segments, or of plan pieces

  static Value number(Num v) {
    Value result;
    result.n[0] = v;
    return result;
  }
  static Value number(double v) { return number(Num{v}); }
  static Value boolean(Num v) {
    Value result = number(v);
    result.kind = ValueKind::boolean;
    return result;
  }
  static Value vector(Num x, Num y, Num z) {
    Value result;
    result.kind = ValueKind::vector;
    result.n = {x, y, z};
    return result;
  }
  static Value vector(Vec3 v) { return vector({v.x}, {v.y}, {v.z}); }
  static Value ofCell(Int3 c) {
    Value result;
    result.kind = ValueKind::cell;
    result.cell = c;
    return result;
  }
  static Value ofFace(FaceId f) {
    Value result = ofCell(f.lower);
    result.kind = ValueKind::face;
    result.axis = f.axis;
    return result;
  }
  static Value ofFaces(std::vector<FaceId> list) {
    Value result;
    result.kind = ValueKind::faces;
    result.faces = std::move(list);
    return result;
  }
  static Value ofSegment(uint32_t index) {
    Value result;
    result.kind = ValueKind::segment;
    result.first = index;
    return result;
  }
  static Value ofSegments(uint32_t first, uint32_t count) {
    Value result = ofSegment(first);
    result.kind = ValueKind::segments;
    result.count = count;
    return result;
  }
  static Value ofPlan(uint32_t first, uint32_t count) {
    Value result = ofSegments(first, count);
    result.kind = ValueKind::plan;
    return result;
  }
  double real() const { return n[0].value; }
  bool truth() const { return n[0].value != 0; }
  Vec3 vec() const { return {n[0].value, n[1].value, n[2].value}; }
  FaceId face() const { return {cell, axis}; }
};

}  // namespace sgm::interpret
