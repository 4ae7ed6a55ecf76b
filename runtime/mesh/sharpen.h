#pragma once
// Edges and corners of a chunk, which marching cubes cuts off: the features of mesh/features.h, put into a body or
// seam.
//
// A loop that a crease passes through becomes a fan or a strip (mesh/sharp_loops.h), and cells beside an ambiguous face
// may get other loops (mesh/ambiguous_faces.h). All other loops keep their triangles. A seam takes up the face vertices
// of both levels that it joins, which lie in its face: the triangles at those sides are divided. So a closed surface
// stays closed, and manifold.

#include "mesh/creases.h"

namespace sgm {

/// Adds feature vertices behind the others, and hashes the part anew. A feature vertex lies at most 1/25 cell and a
/// unit off the surface, and less than a cell outside of its cell, or of the cells of its face; but the centre of a
/// rounded loop that has face vertices in a face of the chunk lies anywhere in its cell. No feature vertex lies beyond
/// the chunk. No triangle has two corners in one place, none meets another one of the level wrongly
/// (mesh/triangle_faults.h): a loop for which a fan would is rounded. Returns the number of rounded loops.
///
/// Pure: the same bytes for the same part and field, with doubles and + - * / sqrt alone. The field is sampled up to
/// sharpReach() beyond the chunk. grid: of a chunk, whose origin is a multiple of 32 cells. Throws std::bad_alloc.
uint32_t sharpenBody(const ChunkGrid& grid, const FieldSampler& field, MeshPart& body,
                     std::pmr::memory_resource* memory = std::pmr::get_default_resource());

/// As sharpenBody, of the seam over a face: with the face vertices that the bodies on both sides of it have there.
/// coarser: the field of the level above, sampled up to sharpReach() of its cells beyond the face.
void sharpenSeam(const ChunkGrid& grid, Face face, const FieldSampler& field, const FieldSampler& coarser,
                 MeshPart& seam, std::pmr::memory_resource* memory = std::pmr::get_default_resource());

}  // namespace sgm
