#pragma once
// Edges and corners of a chunk, which marching cubes cuts off: feature vertices from the field's gradients (after
// Kobbelt et al. 2001, "Feature Sensitive Surface Extraction from Volume Data").
//
// A loop with face vertices (mesh/creases.h) becomes a fan about a CELL VERTEX, the point nearest to the planes of its
// own vertices (mesh/least_squares.h). All other triangles stay as they are. A seam takes up the face vertices of both
// levels that it joins: the triangles at those sides are divided. So what was closed stays closed, and manifold.

#include "mesh/creases.h"

namespace sgm {

/// Adds feature vertices behind the others, and hashes the part anew. A feature vertex lies at most 1/25 cell and a
/// unit off the surface, and a cell beyond its face or cell; a cell vertex that finds no such place, as on noise as
/// fine as the cells, lies amid its loop, and triangles may fold there. Else slivers of a fan may fold, by less than
/// 1/50 of a cell's face; and where a corner lies beyond the loop that sees it, part of a flat side lies upon itself.
/// Pure: the same bytes for the same part and field, with doubles and + - * / sqrt alone. The field is sampled up to a
/// cell and a unit beyond the chunk. Throws std::bad_alloc.
void sharpenBody(const ChunkGrid& grid, const FieldSampler& field, MeshPart& body,
                 std::pmr::memory_resource* memory = std::pmr::get_default_resource());

/// As sharpenBody, of the seam over a face. coarser: the field of the level above, sampled up to one of its cells and a
/// unit beyond the chunk.
void sharpenSeam(const ChunkGrid& grid, Face face, const FieldSampler& field, const FieldSampler& coarser,
                 MeshPart& seam, std::pmr::memory_resource* memory = std::pmr::get_default_resource());

}  // namespace sgm
