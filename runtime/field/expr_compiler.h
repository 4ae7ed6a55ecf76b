#pragma once
// Compiles the expressions of a grammar chunk to ops of a field program.

#include <memory_resource>
#include <vector>

#include "derive/shape.h"
#include "field/builder.h"

namespace sgm {

/// Emits the expressions of one grammar chunk. Each expression is emitted once for each combination of a group and a
/// place (the sample's position, or a warped one); further uses read its register.
class ExprCompiler {
 public:
  /// cell: edge length of the level's cells, in units. Octaves of noise that are too fine for such cells are omitted.
  ExprCompiler(const GrammarChunk& chunk, int32_t cell, ProgramBuilder& builder, std::pmr::memory_resource* memory)
      : chunk_(chunk), cell_(cell), builder_(builder), known_(chunk.exprs.size(), memory) {}

  /// Begins a group: expressions that were emitted in earlier groups must be emitted again.
  void beginGroup() { epoch_ = ++epochs_; }
  /// Begins a place (the position after a warp), where expressions must be emitted again. Returns the previous place,
  /// for returnTo().
  uint64_t beginPlace();
  void returnTo(uint64_t place) { epoch_ = place; }

  Value emit(uint32_t index);

 private:
  uint32_t octavesAt(const NoiseSpec& noise) const;

  struct Known {
    uint64_t epoch = 0;
    Value value;
  };

  const GrammarChunk& chunk_;
  int32_t cell_;
  ProgramBuilder& builder_;
  std::pmr::vector<Known> known_;
  uint64_t epochs_ = 0;
  /// number of the current combination of a group and its place (warp); a cached value is valid only while this number
  /// is unchanged
  uint64_t epoch_ = 0;
};

}  // namespace sgm
