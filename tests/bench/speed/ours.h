#pragma once
// Our side of the benchmark, through the C interface alone.

#include <memory>
#include <string>
#include <vector>

#include "grid_file.h"
#include "measure.h"
#include "scene.h"

struct sgm_chunk_request;
struct sgm_field;
struct sgm_mesh;
struct sgm_runtime;
struct sgm_surface;

namespace bench {

/// One scene in one runtime. Every function throws std::runtime_error with the library's message when a call fails.
class Ours {
 public:
  /// Without a scene: for grids alone.
  explicit Ours(int threads);
  Ours(const Scene& scene, int cells, int threads);
  ~Ours();
  Ours(const Ours&) = delete;
  Ours& operator=(const Ours&) = delete;

  std::string device() const;  ///< instruction set in use

  /// Evaluates and meshes every chunk of the cube: what an engine would ask for. Returns the triangles.
  size_t meshChunks();
  /// Milliseconds of one chunk of a level after the other, from derived cells to packed meshes: of those that have a
  /// surface. At each level as many chunks on an axis as the cube has at level 0.
  std::vector<double> surfaceChunks(int level);
  /// Evaluates and meshes the cube as one welded mesh. Returns the triangles.
  size_t meshRegion();
  /// The same surface as one welded mesh, in cells from the cube's lowest corner.
  Mesh welded();
  /// The scene's field on the corners of all cells, in cells.
  Grid sample();
  /// Meshes a grid, with normals from its gradient where they are wanted. Returns the triangles.
  size_t meshGrid(const Grid& grid, bool normals);
  Mesh gridMesh(const Grid& grid);
  /// Milliseconds of one block of 32^3 cells of a grid after the other, without normals: of those that have a surface.
  std::vector<double> gridChunks(const Grid& grid);

 private:
  std::vector<sgm_chunk_request> allRequests(int level) const;
  sgm_surface* makeRegion();
  void mesh(const sgm_chunk_request* requests, size_t count, sgm_mesh** meshes);
  /// Lets go of a mesh; returns its triangles.
  static size_t release(sgm_mesh* mesh);

  Scene scene_{};
  int cells_ = 0;
  sgm_runtime* runtime_ = nullptr;
  sgm_field* field_ = nullptr;
};

}  // namespace bench
