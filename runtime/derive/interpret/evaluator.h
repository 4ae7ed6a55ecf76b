#pragma once
// Evaluates expressions, both those known during derivation and those evaluated per sample: a number is either a
// constant, or an expression of the field, which Draft folds and shares. evaluate.cpp implements operators and names;
// functions.cpp implements the functions of the language.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "derive/draft.h"
#include "derive/interpret/activations.h"
#include "derive/interpret/budget.h"
#include "derive/interpret/cell_inputs.h"
#include "derive/interpret/env.h"
#include "derive/interpret/value.h"
#include "derive/layout/plan.h"
#include "derive/layout/skeleton.h"

namespace sgm::interpret {

/// Evaluates the expressions of a cell. Stores the segments and plan pieces to which values refer, and records which
/// parameters were read.
class Evaluator {
 public:
  Evaluator(const CellInputs& in, const Activations& activations, Draft& draft, Budget& budget)
      : in_(in), program_(in.program), activations_(activations), draft_(draft), budget_(budget) {}

  /// Evaluates an expression. Returns zeros if the cell has failed, or fails during the evaluation.
  Value evaluate(ExprId id, const Env& env);
  double real(ExprId id, const Env& env) { return evaluate(id, env).real(); }

  /// Returns the expression of an argument of a call. index: position in the call's list of bound arguments. kNoId if
  /// the argument is omitted.
  ExprId boundAt(const ExprNode& node, uint32_t index) const;
  /// Returns a key for random draws that depends only on this value.
  PathKey keyOf(const Value& value) const;

  const Segment& segment(uint32_t i) const { return segments_[i]; }
  const PlanPiece& piece(uint32_t i) const { return pieces_[i]; }
  uint32_t pieceCount() const { return static_cast<uint32_t>(pieces_.size()); }
  /// Stores a plan piece. Invalidates references to other pieces.
  void addPiece(PlanPiece piece);

  /// Returns the parameters read so far, as a bit set like GrammarChunk::parameters.
  uint64_t parametersRead() const { return parameters_read_; }

 private:
  Value evaluateBinary(const ExprNode& node, const Env& env);
  Value evaluateName(const ExprNode& node, const Env& env);
  Value evaluateMember(const ExprNode& node, const Env& env);
  Value evaluateCall(const ExprNode& node, const Env& env);
  Value evaluateBuiltin(const ExprNode& node, const Env& env);
  Value evaluatePure(const ExprNode& node, const Env& env);    ///< arithmetic
  Value evaluateRandom(const ExprNode& node, const Env& env);  ///< rand, chance
  /// evaluates calls of the functions cellnoise and fractal, of the methods point and links of a cell, and of the
  /// method point of a face
  Value evaluateCellular(const ExprNode& node, const Env& env);
  Value evaluateBranch(const ExprNode& node, const Env& env);
  Value evaluateQuery(const ExprNode& node, const Env& env);
  Value evaluateLet(const ExprNode& node, const Env& env);
  Value evaluateField(const ExprNode& node, const Env& env);
  Value sampleCoordinates(const Env& env, bool local);
  Value pointValue(Int3 units_from_cell, const Env& env) const;
  Value argument(const ExprNode& node, uint32_t index, const Env& env);
  double realArgument(const ExprNode& node, uint32_t index, const Env& env);

  const CellInputs& in_;
  const Program& program_;
  const Activations& activations_;
  Draft& draft_;
  Budget& budget_;
  std::vector<Segment> segments_;  ///< segments of all skeletons in the cell
  std::vector<PlanPiece> pieces_;  ///< pieces of all plans in the cell
  uint64_t parameters_read_ = 0;
};

}  // namespace sgm::interpret
