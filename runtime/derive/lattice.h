#pragma once
// The cells of a layer and the points, faces and links that they share. Every function is pure: it depends only on the
// seed, the layer and integer coordinates, so that both cells of a face compute the same without communication.

#include <cstdint>
#include <vector>

#include "base/fixed.h"
#include "base/hash.h"

namespace sgm {

/// A face between `lower` and the next cell up along `axis`. It belongs to `lower`; only that cell emits shapes that
/// cross it.
struct FaceId {
  Int3 lower;
  int axis = 0;
  friend auto operator<=>(const FaceId&, const FaceId&) = default;
  Int3 upper() const {
    Int3 cell = lower;
    ++cell[axis];
    return cell;
  }
};

struct Lattice {
  uint64_t seed = 0;  ///< of world, grammar and layer combined
  Int3 size;          ///< edges of a cell in units; 0 along axes that are not divided into cells

  bool hasAxis(int axis) const { return size[axis] > 0; }
  PathKey cellKey(Int3 cell) const;
  PathKey faceKey(FaceId face) const;

  /// The low corner relative to that of `home`, in units. For differences of up to a few thousand cells.
  Int3 lowFrom(Int3 home, Int3 cell) const;
  /// A point of the cell, relative to the low corner of `home`, in units: jitter 0 is the centre, 1 is anywhere.
  Int3 point(Int3 home, Int3 cell, double jitter) const;
  /// A point of the face, as above; its coordinate along the axis is the face's.
  Int3 facePoint(Int3 home, FaceId face, double jitter) const;

  /// The faces that the cell owns: one along each axis that is divided into cells.
  std::vector<FaceId> ownedFaces(Int3 cell) const;
  /// True if a passage crosses the face. Compulsory faces: inside each block of 2^tree cells per side, every node of
  /// the block's octree joins its children by a hash-chosen spanning tree, each edge of which is one hash-chosen face;
  /// neighbouring blocks are joined by one face. So every block is connected in itself and to all its neighbours. Any
  /// other face is open with probability `extra`. The cost is one node test. tree: 0..20.
  bool linked(FaceId face, int tree, double extra) const;
  /// The linked faces of ownedFaces().
  std::vector<FaceId> links(Int3 cell, int tree, double extra) const;

  /// Smooth noise in 0..1 at the centre of a cell; period in units, at least 1.
  double noise(Int3 cell, int32_t period, uint64_t noise_seed) const;
};

}  // namespace sgm
