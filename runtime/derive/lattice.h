#pragma once
// The cells of a layer, and the points, faces and links that neighbouring cells share. All functions are pure: they
// depend only on the seed, the layer and integer coordinates, so that both cells of a face compute the same results
// without communication.

#include <cstdint>
#include <vector>

#include "base/fixed.h"
#include "base/hash.h"

namespace sgm {

/// The face between the cell `lower` and the next cell upwards along `axis`. `lower` owns the face: only it derives
/// shapes that cross the face.
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
  uint64_t seed = 0;  ///< hash of the seeds of the world, the grammar and the layer
  Int3 size;          ///< edges of a cell in units; 0 along axes that are not divided into cells

  bool hasAxis(int axis) const { return size[axis] > 0; }
  PathKey cellKey(Int3 cell) const;
  PathKey faceKey(FaceId face) const;

  /// Returns the low corner of the cell `cell` relative to the low corner of the cell `home`, in units. The distance
  /// between them may be up to a few thousand cells.
  Int3 lowFrom(Int3 home, Int3 cell) const;
  /// Returns a random point of a cell, relative to the low corner of the cell `home`, in units. jitter 0: the centre of
  /// the cell; 1: anywhere in the cell.
  Int3 point(Int3 home, Int3 cell, double jitter) const;
  /// Returns a random point of the face (exactly in the face's plane), relative to the low corner of the cell `home`,
  /// in units.
  Int3 facePoint(Int3 home, FaceId face, double jitter) const;

  /// Returns the faces that the cell owns: one along each axis that is divided into cells.
  std::vector<FaceId> ownedFaces(Int3 cell) const;
  /// Whether a passage crosses the face. The world is divided into blocks of 2^tree cells per side, each with an
  /// octree. In every octree node, a random spanning tree connects the children; for each edge of this tree, one
  /// randomly chosen face between the two children is open. One face between each pair of neighbouring blocks is open,
  /// too. So every block is connected in itself and to all its neighbours. Each other face is open with probability
  /// `extra`. A call examines only one octree node. tree: 0..20.
  bool linked(FaceId face, int tree, double extra) const;
  /// Returns the faces of ownedFaces() for which linked() is true.
  std::vector<FaceId> links(Int3 cell, int tree, double extra) const;

  /// Returns smooth noise in 0..1 at the centre of a cell. period: in units, at least 1.
  double noise(Int3 cell, int32_t period, uint64_t noise_seed) const;
};

}  // namespace sgm
