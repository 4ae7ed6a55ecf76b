#pragma once
// Reference models of known class: reference histograms are built from them, and classification is tested with them.
// They come from the current samples, and from simple grammars in tests/bench/grammars, which do not change. A model
// depends only on its family, its seed, and the standard library.

#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "asset/triangle_mesh.h"
#include "backend/backend.h"
#include "grammar/syntax/program.h"
#include "measure/triangles.h"

namespace sgm::masters {

/// The models of one grammar, at one density; or noise: a plane grid of quadrangles whose points are moved randomly, by
/// at most 0.4 to 2 edges, or randomly solid voxels.
struct Family {
  std::string_view class_name;
  std::string_view file;  ///< in samples/grammars, bench/... in tests/bench/grammars, or a description
  std::string_view text;  ///< empty: the grid
  double cell = 0;        ///< metres; of the grid, the quadrangles' edge
  double edge = 0;        ///< of the examined cube, metres; 0: the whole world, which is finite
  double middle = 0;      ///< width of the middle of a finite world that contains the cubes, metres; 0: all
};
std::span<const Family> families();

/// All classes but noise, in the order of families().
std::vector<std::string_view> classNames();

using ModelMesh = asset::TriangleMesh;

/// A family's grammar, compiled.
class ModelMaker {
 public:
  static Result<ModelMaker> create(const Family& family);

  /// Each seed draws new parameters from their whole ranges, and is the world's seed. If the world is larger than the
  /// cube, the model is the part around a steep point of its surface, also chosen by the seed. If the model is nearly
  /// empty (a sky without a cloud), the seed's next draw is tried. Errors: those of meshing; limit if ten draws are
  /// empty.
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
