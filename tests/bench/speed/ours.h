#pragma once
// Our library's side of the benchmark, through the C interface alone.

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

/// A runtime with one scene. Every function throws std::runtime_error with the library's message if a call fails.
class Ours {
 public:
  /// Makes a runtime without a scene, for meshing grids only.
  explicit Ours(int threads);
  Ours(const Scene& scene, int cells, int threads);
  ~Ours();
  Ours(const Ours&) = delete;
  Ours& operator=(const Ours&) = delete;

  std::string device() const;  ///< name of the instruction set that the library uses

  /// Evaluates and meshes every chunk of the cube, as an engine would request them. Returns the number of triangles.
  size_t meshChunks();
  /// Meshes the chunks of a level one by one, from derived cells to packed meshes. Returns the milliseconds of each
  /// chunk that has a surface. At every level, meshes as many chunks along each axis as the cube has at level 0, so
  /// coarser levels cover a larger region.
  std::vector<double> surfaceChunks(int level);
  /// Evaluates and meshes the cube as one welded mesh. Returns the number of triangles.
  size_t meshRegion();
  /// Returns the cube's surface as one welded mesh, in units of a cell, relative to the cube's lowest corner.
  Mesh welded();
  /// Samples the scene's field at the corners of all cells. Values are distances in units of a cell.
  Grid sample();
  /// Meshes a grid of samples. normals: true: also computes a normal for each vertex from the grid's gradient. Returns
  /// the number of triangles.
  size_t meshGrid(const Grid& grid, bool normals);
  Mesh gridMesh(const Grid& grid);
  /// Meshes the blocks of 32^3 cells of a grid one by one, without normals. Returns the milliseconds of each block that
  /// has a surface.
  std::vector<double> gridChunks(const Grid& grid);

 private:
  std::vector<sgm_chunk_request> allRequests(int level) const;
  sgm_surface* makeRegion();
  void mesh(const sgm_chunk_request* requests, size_t count, sgm_mesh** meshes);
  /// Releases a mesh. Returns its number of triangles.
  static size_t release(sgm_mesh* mesh);

  Scene scene_{};
  int cells_ = 0;
  sgm_runtime* runtime_ = nullptr;
  sgm_field* field_ = nullptr;
};

}  // namespace bench
