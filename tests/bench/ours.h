#pragma once
// Our side of the benchmark, through the C interface alone.

#include <memory>
#include <string>

#include "grid_file.h"
#include "measure.h"
#include "scene.h"

struct sgm_runtime;
struct sgm_field;

namespace bench {

/// One scene in one runtime. Every function throws std::runtime_error with the library's message when a call fails.
class Ours {
 public:
  Ours(const Scene& scene, int cells, int threads);
  ~Ours();
  Ours(const Ours&) = delete;
  Ours& operator=(const Ours&) = delete;

  std::string device() const;  ///< instruction set in use

  /// Evaluates and meshes every chunk of the cube: what an engine would ask for. Returns the triangles.
  size_t meshChunks();
  /// The same surface as one welded mesh, in cells from the cube's lowest corner.
  Mesh welded();
  /// The scene's field on the corners of all cells, in cells.
  Grid sample();
  /// Meshes a grid with normals from its gradient. Returns the triangles.
  size_t meshGrid(const Grid& grid);
  Mesh gridMesh(const Grid& grid);

 private:
  Scene scene_;
  int cells_;
  sgm_runtime* runtime_ = nullptr;
  sgm_field* field_ = nullptr;
};

}  // namespace bench
