#pragma once
// Connected pieces of solid and air by the mesh's own rule, face by face: a slow but simple reference.

#include <algorithm>
#include <functional>
#include <map>
#include <numeric>
#include <vector>

#include "mesh/case_rule.h"
#include "region/components.h"

namespace sgm::test {

/// Finds the pieces of a lattice of samples; solid(x, y, z) is called for 0 <= x < nx and so on. On each face of each
/// cell, the mesh separates the maximal runs of solid corners from each other: the corners of a run belong to one
/// piece, and all void corners of the face belong to one piece.
inline Pieces bruteForce(int nx, int ny, int nz, const std::function<bool(int, int, int)>& solid) {
  std::vector<int> parent(static_cast<size_t>(nx) * static_cast<size_t>(ny) * static_cast<size_t>(nz));
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int i) {
    while (parent[static_cast<size_t>(i)] != i) {
      int& up = parent[static_cast<size_t>(i)];
      up = parent[static_cast<size_t>(up)];
      i = up;
    }
    return i;
  };
  const auto join = [&](int a, int b) { parent[static_cast<size_t>(root(a))] = root(b); };
  const auto number = [&](int x, int y, int z) { return x + nx * (y + ny * z); };
  const auto joinFace = [&](const std::vector<int>& face, const std::function<int(int)>& sample,
                            const std::function<bool(int)>& isSolid) {
    int last_void = -1;
    for (size_t i = 0; i < face.size(); ++i) {
      const int here = face[i], next = face[(i + 1) % face.size()];
      if (isSolid(here) && isSolid(next)) join(sample(here), sample(next));
      if (isSolid(here)) continue;
      if (last_void >= 0) join(sample(here), last_void);
      last_void = sample(here);
    }
  };
  const Cell cube = cubeCell();
  for (int z = 0; z + 1 < nz; ++z) {
    for (int y = 0; y + 1 < ny; ++y) {
      for (int x = 0; x + 1 < nx; ++x) {
        const auto sample = [&](int c) { return number(x + (c & 1), y + (c >> 1 & 1), z + (c >> 2)); };
        const auto isSolid = [&](int c) { return solid(x + (c & 1), y + (c >> 1 & 1), z + (c >> 2)); };
        for (const std::vector<int>& face : cube.faces) joinFace(face, sample, isSolid);
      }
    }
  }
  std::map<int, Piece> pieces;
  std::map<int, bool> is_solid;
  for (int z = 0; z < nz; ++z) {
    for (int y = 0; y < ny; ++y) {
      for (int x = 0; x < nx; ++x) {
        Piece& piece = pieces[root(number(x, y, z))];
        ++piece.samples;
        piece.box = piece.box.joined({{x, y, z}, {x, y, z}});
        is_solid[root(number(x, y, z))] = solid(x, y, z);
      }
    }
  }
  Pieces found;
  for (const auto& [number_of, piece] : pieces) (is_solid[number_of] ? found.solid : found.air).push_back(piece);
  const auto before = [](const Piece& a, const Piece& b) {
    const auto key = [](const Piece& p) { return std::tuple(p.samples, p.box.lo.z, p.box.lo.y, p.box.lo.x); };
    return key(a) < key(b);
  };
  std::sort(found.solid.begin(), found.solid.end(), before);
  std::sort(found.air.begin(), found.air.end(), before);
  return found;
}

}  // namespace sgm::test
