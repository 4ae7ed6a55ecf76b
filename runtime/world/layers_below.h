#pragma once
// Lets the derivation of a cell query the field of the layers below the cell's layer. The queries use field programs
// that are compiled once for the cell's surroundings.

#include <exception>
#include <map>
#include <optional>

#include "derive/interpret/lower_layers.h"
#include "field/prune.h"
#include "world/world_field.h"

namespace sgm {

/// An object of this class serves one derivation, on its thread. The caller must check error() after the derivation.
class LayersBelow final : public LowerLayers {
 public:
  LayersBelow(const WorldField& world, const IntBox& around);

  bool solid(uint32_t layer, Int3 p) const override;
  std::optional<int32_t> probe(uint32_t layer, Int3 from, std::array<double, 3> direction,
                               int32_t length) const override;
  BallProof prove(uint32_t layer, const Ball& ball, BoxContent wanted) const override;

  const std::optional<Error>& error() const { return error_; }
  /// Returns the mask of parameters that the queried layers have read (GrammarChunk::parameters).
  uint64_t parameters() const { return parameters_; }

 private:
  const FieldProgram* program(uint32_t layer, const IntBox& box) const;
  /// Adds the shift that the world's settings define, because derivation works in coordinates without that shift.
  Int3 shifted(Int3 p) const;

  const WorldField& world_;
  IntBox around_;
  mutable std::map<uint32_t, std::shared_ptr<const FieldProgram>> programs_;
  /// the program for the last queried box that lies outside of `around_`, at least in part
  mutable std::shared_ptr<const FieldProgram> elsewhere_;
  mutable EvalScratch scratch_;
  mutable PruneScratch prune_scratch_;
  mutable PrunedProgram pruned_, piece_;
  mutable std::vector<int32_t> x_, y_, z_, q_;
  mutable std::optional<Error> error_;
  mutable uint64_t parameters_ = 0;
};

}  // namespace sgm
