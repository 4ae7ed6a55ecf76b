// Reads arbitrary bytes as a GLB asset: it must be read, closed, fitted and divided into convex pieces, or rejected
// with a message.

#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "asset/convex_cover.h"
#include "asset/fit.h"
#include "asset/read/glb_reader.h"

using namespace sgm;
using namespace sgm::asset;

namespace {

template <class T>
bool saysWhy(const Result<T>& result) {
  if (result) return true;
  if (result.error().message.empty()) std::abort();
  return false;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const Result<TriangleMesh> mesh = readGlb(std::as_bytes(std::span(data, size)));
  if (!saysWhy(mesh)) return 0;
  const Result<Polyhedron> solid = makePolyhedron(*mesh);
  // Skip large meshes, which take too long for so many runs.
  if (!saysWhy(solid) || solid->triangles.size() > 200) return 0;
  const Point own = solid->high - solid->low;
  const FitZone zones[] = {{0, false, 0.25 * own.x, 0.5 * own.x}, {1, true, 0.25 * own.y, 0.75 * own.y}};
  for (const size_t count : {size_t{0}, size_t{1}, size_t{2}}) {
    const Result<Polyhedron> body = fitInto(*solid, 1.7 * own, std::span(zones).first(count));
    if (saysWhy(body) && body->triangles.size() < 400)
      saysWhy(coverWithPieces(*body, {.cells = 300, .pieces = 300, .features = 3000}));
  }
  return 0;
}
