#pragma once
// Restores sharp edges and corners of a chunk, which marching cubes cuts off: adds the features that mesh/features.h
// finds.
//
// In a body, a loop with a crease becomes a fan or a strip (mesh/sharp_loops.h), and cells beside an ambiguous face may
// get other loops (mesh/ambiguous_faces.h). All other loops keep their triangles. A seam gets the face vertices of both
// levels in its face, and the triangles at those sides are divided, so that a closed surface stays closed and manifold.

#include "mesh/creases.h"

namespace sgm {

/// Adds feature vertices behind the existing ones, and recomputes the part's hash. Returns the number of rounded loops.
/// A loop is rounded, so that it has no feature vertex in its cell, if its fan would have a triangle with two corners
/// in one place, or a triangle that intersects another one of the level (mesh/triangle_faults.h).
///
/// A feature vertex lies at most 1/25 cell plus one unit off the surface. The vertex of a cell lies less than one cell
/// outside that cell; the vertex of a face lies less than one cell outside the two cells at that face. The only
/// exception is the centre of a rounded loop with face vertices in a face of the chunk: it may lie anywhere in its
/// cell. No feature vertex lies beyond the chunk.
///
/// Pure: the same part and field give the same bytes, since only doubles with + - * / sqrt are used. Samples the field
/// up to sharpReach() beyond the chunk. grid: the chunk's grid; its origin must be a multiple of 32 cells. Throws
/// std::bad_alloc.
uint32_t sharpenBody(const ChunkGrid& grid, const FieldSampler& field, MeshPart& body,
                     std::pmr::memory_resource* memory = std::pmr::get_default_resource());

/// Same as sharpenBody, for the seam over a face: adds the face vertices that the bodies on both sides have in that
/// face. coarser: the field of the level above; it is sampled up to sharpReach() of the coarser cell beyond the face.
void sharpenSeam(const ChunkGrid& grid, Face face, const FieldSampler& field, const FieldSampler& coarser,
                 MeshPart& seam, std::pmr::memory_resource* memory = std::pmr::get_default_resource());

}  // namespace sgm
