#pragma once
// Makes models of known class. Reference histograms are built from such models, and classification is tested with them.
// The models are generated from the current samples, and from simple grammars in tests/bench/grammars, which do not
// change. A model depends only on its family, its seed, and the standard library.

#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "asset/triangle_mesh.h"
#include "backend/backend.h"
#include "grammar/syntax/program.h"
#include "measure/triangles.h"

namespace sgm::masters {

/// The models of one grammar at one density; or a kind of noise: a plane grid of quadrangles whose points are moved
/// randomly (the maximum is 0.4 to 2 edge lengths, different for each model), or voxels that are solid at random.
struct Family {
  std::string_view class_name;
  std::string_view file;  ///< path in samples/grammars, bench/... for tests/bench/grammars, or a description for noise
  std::string_view text;  ///< text of the grammar; empty for noise
  double cell = 0;        ///< edge of a grid cell, metres; for noise, the edge of a quadrangle
  double edge = 0;        ///< edge of the meshed cube, metres; 0: the world is finite, and all of it is meshed
  /// Width in metres, along x and z, of the central part of a finite world in which a cube's centre must lie; 0:
  /// anywhere.
  double middle = 0;
};
std::span<const Family> families();

/// The names of all classes except noise, in the order of families().
std::vector<std::string_view> classNames();

using ModelMesh = asset::TriangleMesh;

/// Makes models of one family; holds its compiled grammar.
class ModelMaker {
 public:
  static Result<ModelMaker> create(const Family& family);

  /// Makes the model of a seed. The seed determines the world's seed and random values for the grammar's parameters,
  /// from their whole ranges. If the world is larger than the cube, the model is the part around a random steep point
  /// of its surface. If the model is nearly empty (a sky without a cloud), another random attempt is made. Errors:
  /// those of meshing; limit if ten attempts are empty.
  Result<ModelMesh> make(uint64_t seed, Backend& backend, JobSystem& jobs) const;

  const Family& family() const { return *family_; }

 private:
  ModelMaker(const Family& family, std::shared_ptr<const Program> program)
      : family_(&family), program_(std::move(program)) {}
  Result<ModelMesh> draw(uint64_t seed, uint64_t attempt, Backend& backend, JobSystem& jobs) const;

  const Family* family_;
  std::shared_ptr<const Program> program_;
};

}  // namespace sgm::masters
