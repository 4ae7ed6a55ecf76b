#pragma once
// Models of known class: what masters are built from, and what classification is judged by. They are made from the
// samples of today, and from the plain ones of tests/bench/grammars, which stay as they are. A model is a function of
// its family and seed, and of the standard library.

#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "asset/triangle_mesh.h"
#include "backend/backend.h"
#include "grammar/syntax/program.h"
#include "measure/triangles.h"

namespace sgm::masters {

/// The models of one grammar, at one density. Or noise: a plane's grid of quadrangles whose points are moved by chance,
/// at most 0.4 to 2 edges of one, and voxels that are solid by chance.
struct Family {
  std::string_view class_name;
  std::string_view file;  ///< of samples/grammars, bench/... of tests/bench/grammars, or what else it shows
  std::string_view text;  ///< empty: the grid
  double cell = 0;        ///< metres; of the grid the quadrangles' edge
  double edge = 0;        ///< of the cube that is looked at, metres; 0: the whole world, which is finite
  double middle = 0;      ///< how wide the middle of a finite world is in which cubes lie, metres; 0: all of it
};
std::span<const Family> families();

/// All but noise, in the order of families().
std::vector<std::string_view> classNames();

using ModelMesh = asset::TriangleMesh;

/// A family's grammar, compiled.
class ModelMaker {
 public:
  static Result<ModelMaker> create(const Family& family);

  /// Parameters are drawn from their whole ranges, each seed's anew, and the world has that seed. Of a world that is
  /// larger than the cube the part around a steep point of its surface, which the seed chooses too. Where there is next
  /// to nothing (a sky without a cloud) the seed's next draw is tried. Errors: those of meshing; limit where ten draws
  /// give nothing.
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
