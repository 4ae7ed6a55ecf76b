#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#extension GL_KHR_shader_subgroup_ballot : require
// Writes the triangles of all bodies that fit into the buffers: one invocation per active cell. Requires that the
// positions of vertices are written.
layout(local_size_x = 64) in;
#include "mesher/batch.glsl"
#include "mesher/sizes.glsl"
#include "mesher/edges.glsl"
#include "mesher/cells.glsl"
#include "mesher/case_layout.h"
#include "mesher/hash.glsl"
#include "mesher/traverse.glsl"
#include "mesher/seven_points.glsl"

const uint kEdges = 12u;

void writeTriangles(ActiveCell cell, uint first_vertex, uint first_index, inout uvec2 hash) {
  uint number[kEdges];
  number[0] = cell.first.x;
  number[1] = cell.first.y;
  number[2] = cell.first.z;
  number[3] = cell.first.w;
  number[4] = vertexOnEdge(cell.first.x, cell.owned.x, 1u);
  number[5] = vertexOnEdge(cell.first.x, cell.owned.x, 4u);
  number[6] = vertexOnEdge(cell.first.z, cell.owned.z, 1u);
  number[7] = vertexOnEdge(cell.first.z, cell.owned.z, 4u);
  number[8] = vertexOnEdge(cell.first.x, cell.owned.x, 2u);
  number[9] = vertexOnEdge(cell.first.x, cell.owned.x, 5u);
  number[10] = vertexOnEdge(cell.first.y, cell.owned.y, 2u);
  number[11] = vertexOnEdge(cell.first.y, cell.owned.y, 5u);

  uvec4 loops = table_fours[kCubeCases / 4u + cell.cell_case];
  uint lengths = loops.y >> 16, forbidden = loops.z, index = cell.index;
  do {
    uint n = lengths & 7u, edges = loops.x, i = 0u;
    do {
      place[i] = packPlace(vertices[first_vertex + number[edges >> (4u * i) & 15u]].xy);
      ++i;
    } while (i < n);
    loops.xy = uvec2(loops.x >> (4u * n) | loops.y << (32u - 4u * n), loops.y >> (4u * n));
    uint apexes = chooseApexes(n, forbidden);
    Chords left = wholeLoop(n);
    do {
      uint apex = apexes & 7u, from = left.from, to = endOfFirst(left);
      apexes >>= 3;
      uvec3 corner = uvec3(edges >> (4u * from), edges >> (4u * apex), edges >> (4u * to)) & 15u;
      uvec3 triangle = uvec3(number[corner.x], number[corner.y], number[corner.z]);
      hash += hashIndex(triangle.x, index) + hashIndex(triangle.y, index + 1u) + hashIndex(triangle.z, index + 2u);
      indices[first_index + index] = triangle.x;
      indices[first_index + index + 1u] = triangle.y;
      indices[first_index + index + 2u] = triangle.z;
      index += 3u;
      cutFirst(left, apex);
    } while (anyLeft(left));
    forbidden >>= (n - 1u) * (n - 2u) / 2u;
    lengths >>= 3;
  } while (lengths != 0u);
}

void main() {
  uint cells = parts[kHeadCells], base = gl_WorkGroupID.x * gl_WorkGroupSize.x;
  do {
    uint i = base + gl_LocalInvocationIndex, part = kNoRoom;
    uvec2 hash = uvec2(0u);
    if (i < cells) {
      ActiveCell cell = unpackCell(scratch_fours[cell_list / kCellWords + i]);
      part = cell.part;
      uvec4 record = part_fours[(kHeadWords + part * kPartWords) / 4u];
      writeTriangles(cell, record[kPartFirstVertex], record[kPartFirstIndex], hash);
    }
    addHash(part, hash);
    base += gl_NumWorkGroups.x * gl_WorkGroupSize.x;
  } while (base < cells);
}
