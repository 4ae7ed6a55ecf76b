#pragma once
// Finds the sharp features of a body: the positions of its face vertices and cell vertices, which are the feature
// vertices of cell faces and of cells (mesh/sharp_loops.h).

#include <array>
#include <memory_resource>
#include <span>

#include "mesh/creases.h"
#include "mesh/sharp_loops.h"

namespace sgm {

/// Computes the sharp loops of one body. Member functions throw std::bad_alloc.
class Features {
 public:
  /// Borrows all arguments. creases: those of the body, after settle(), with the tangents of all its vertices. border:
  /// the result of borderSides for the body.
  Features(const BodyLoops& body, const Creases& creases, std::span<const SharpSide> border, const FieldSampler& field,
           std::pmr::memory_resource* memory);

  /// Call once.
  SharpLoops find() &&;

 private:
  static constexpr uint32_t kNone = SharpLoops::kNone;

  /// The candidate centres for the fan of one loop.
  class Centres {
   public:
    void add(const FanCentre& centre) {
      if (count_ < centres_.size()) centres_[count_++] = centre;
    }
    std::span<const FanCentre> all() const { return {centres_.data(), count_}; }

   private:
    std::array<FanCentre, 6 + FacePlaces::kMost * kLongestBodyLoop + kLongestBodyLoop> centres_;
    size_t count_ = 0;
  };

  bool passesVertices(const SurfaceLoop& loop) const;
  void findSides();
  void placeCellVertices();
  Centres centresOf(const SharpLoop& loop) const;
  std::optional<FanCentre> nextCentre(SharpLoop& loop) const;
  bool takeNextCentre(SharpLoop& loop) const;
  bool take(const FanCentre& centre, const FieldSample& sample, SharpLoop& loop) const;
  bool takeStrip(const FanCentre& centre, SharpLoop& loop) const;
  static void makeFan(const FanCentre& centre, bool by_patches, SharpLoop& loop);
  bool takeAs(const FanCentre& centre, bool by_patches, SharpLoop& loop) const;
  const SurfaceLoop& of(const SharpLoop& loop) const { return sharp_.of(loop); }

  const BodyLoops& body_;
  const Creases& creases_;
  const std::span<const SharpSide> border_;
  const FieldSampler& field_;
  std::pmr::memory_resource* memory_;
  SharpLoops sharp_;
};

}  // namespace sgm
