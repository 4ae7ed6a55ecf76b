#pragma once
// Finds the sharp features of a body: where its face and cell vertices lie (mesh/sharp_loops.h).
//
// The order of face vertices along a crease follows from the places nearest to the sides' middles; but where the crease
// passes near a corner of the grid these may come in another order than the sides, or fall together. Each face vertex
// within a chunk is therefore placed at the mean of its own such place, which counts twice, and those of the next sides
// of the two loops that it joins: three sides on span more than one cell, so that the means come in order.

#include <array>
#include <memory_resource>
#include <span>

#include "mesh/creases.h"
#include "mesh/sharp_loops.h"

namespace sgm {

/// Throws std::bad_alloc.
class Features {
 public:
  /// Borrows all. creases: of all vertices of the body, settled.
  Features(const BodyLoops& body, const Creases& creases, const FieldSampler& field, std::pmr::memory_resource* memory);

  /// Once.
  SharpLoops find() &&;

 private:
  static constexpr uint32_t kNone = SharpLoops::kNone;

  /// Some centres of one fan.
  class Centres {
   public:
    void add(const FanCentre& centre) {
      if (count_ < centres_.size()) centres_[count_++] = centre;
    }
    std::span<const FanCentre> all() const { return {centres_.data(), count_}; }

   private:
    std::array<FanCentre, 8> centres_;
    size_t count_ = 0;
  };

  void findSides();
  void placeFaceVertices();
  void placeCellVertices();
  Vector3 meetingPoint(const SharpLoop& loop, const Int3& corner, std::span<const Vector3> ideals) const;
  Vector3 meanOnCrease(const SharpSide& side, std::span<const Vector3> ideals) const;
  Centres centresOf(const SharpLoop& loop) const;
  std::optional<FanCentre> nextCentre(SharpLoop& loop) const;
  bool takeNextCentre(SharpLoop& loop) const;
  bool take(const FanCentre& centre, const FieldSample& sample, SharpLoop& loop) const;
  bool takeAs(const FanCentre& centre, bool by_patches, SharpLoop& loop) const;
  const SurfaceLoop& of(const SharpLoop& loop) const { return sharp_.of(loop); }

  const BodyLoops& body_;
  const Creases& creases_;
  const FieldSampler& field_;
  std::pmr::memory_resource* memory_;
  SharpLoops sharp_;
};

}  // namespace sgm
