#pragma once
// A sequence of ops on values: the form of a group until it is complete. Then its values get registers.

#include <memory_resource>
#include <vector>

#include "base/result.h"
#include "derive/shape.h"
#include "field/program.h"

namespace sgm {

/// The result of an op in the group under construction.
struct Value {
  uint32_t id = kNone;
};

/// The ops of one group under construction, and the current place: the position register that the next op reads.
/// Parameter `params` of functions: index of an op's first parameter word. Not thread-safe.
class OpSequence {
 public:
  explicit OpSequence(std::pmr::memory_resource* memory) : steps_(memory) {}

  /// Returns a new value; a later op writes it.
  Value reserve() { return {next_value_++}; }
  /// Appends an op, and returns its result.
  Value emit(Op op, uint32_t params, Value a = {}, Value b = {}, Value c = {});
  /// Appends an op that adds an operand to an accumulator, which consists of the values `nearest` and `sum`.
  void accumulate(Op op, uint32_t params, Value nearest, Value operand, Value sum);

  /// Makes all ops until popWarp() read the current position displaced by (x, y, z), in metres.
  void pushWarp(Value x, Value y, Value z);
  void popWarp() { --place_; }

  /// Assigns registers, appends the ops to `instrs`, clears the sequence, and returns the register of the root. Error:
  /// limit if the ops need more than kMaxRegisters registers, or if nested warps need more than kMaxPlaces position
  /// registers. After an error, `instrs` is unchanged, but the sequence is cleared.
  Result<uint8_t> moveTo(std::pmr::vector<Instr>& instrs, Value root);

 private:
  struct Step {
    Op op;
    uint32_t dst = kNone, a = kNone, b = kNone, c = kNone;
    uint8_t place = 0;
    uint32_t params = 0;
  };

  std::pmr::vector<Step> steps_;
  uint32_t next_value_ = 0;
  uint8_t place_ = 0;
  bool too_deep_ = false;
};

}  // namespace sgm
