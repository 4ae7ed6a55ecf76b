#include "field/compile.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory_resource>
#include <optional>

#include "field/shape_compiler.h"

namespace sgm {

namespace {

struct Gathered {
  size_t cell;  ///< index in the `cells` passed to compileField
  uint32_t group;
  uint32_t layer;
  bool cut;
  PathKey key;
};

}  // namespace

Result<FieldProgram> compileField(std::span<const IndexedCell> cells, const IntBox& box, const FieldSettings& settings,
                                  std::pmr::memory_resource* memory, std::span<const HostField> hosts,
                                  std::span<const Brush> brushes) {
  // Growing arrays allocate from this buffer instead of `memory`: each request to `memory` updates a shared counter,
  // for which threads contend.
  std::array<std::byte, 8192> room;
  std::pmr::monotonic_buffer_resource scratch(room.data(), room.size(), memory);
  // The scratch buffer never frees memory that an array has outgrown. The samples of host fields can be large, so if
  // there are host fields, the builder allocates from `memory`.
  std::pmr::memory_resource* large = hosts.empty() ? &scratch : memory;
  const int32_t margin = influenceMargin(settings.cell);
  std::pmr::vector<Gathered> gathered(&scratch);
  std::pmr::vector<uint32_t> found(&scratch);
  for (size_t i = 0; i < cells.size(); ++i) {
    found.clear();
    cells[i].index->query(box.grown(margin), found);
    for (uint32_t g : found) {
      const Group& group = cells[i].chunk->groups[g];
      gathered.push_back({i, g, cells[i].chunk->layer, group.cut, group.key});
    }
  }
  std::sort(gathered.begin(), gathered.end(), [&](const Gathered& a, const Gathered& b) {
    if (a.layer != b.layer) return a.layer < b.layer;
    if (a.cut != b.cut) return b.cut;
    if (a.key != b.key) return a.key < b.key;
    if (a.cell != b.cell) return cells[a.cell].chunk->cell < cells[b.cell].chunk->cell;
    return a.group < b.group;
  });

  const bool by_shape = settings.shapes != nullptr;
  ProgramBuilder builder(settings.finest_cell, settings.solid, by_shape ? kNoShape : settings.label, large);
  std::pmr::vector<std::optional<ShapeCompiler>> compilers(cells.size(), &scratch);
  for (const Gathered& g : gathered) {
    std::optional<ShapeCompiler>& compiler = compilers[g.cell];
    if (!compiler) {
      compiler.emplace(*cells[g.cell].chunk, static_cast<uint32_t>(g.cell), box, settings.cell, settings.shapes,
                       builder, &scratch);
    }
    const Group& group = cells[g.cell].chunk->groups[g.group];
    Result<std::optional<Value>> root = compiler->root(group.root);
    if (!root) return root.error();
    if (!*root) continue;
    if (Result<void> ended = builder.group(**root, group.bounds.grown(margin), g.layer, g.cut); !ended) {
      return ended.error();
    }
  }
  uint32_t layer = gathered.empty() ? 0 : gathered.back().layer;
  for (const HostField& host : hosts) {
    if (!host.bounds.grown(host.smooth).grown(margin).meets(box)) continue;
    const uint32_t label = by_shape ? kNoShape : host.label;
    if (Result<void> emitted = emitHostField(builder, host, box, settings.cell, ++layer, label, memory); !emitted) {
      return emitted.error();
    }
  }
  for (Brush brush : brushes) {
    if (!brushShows(brush, settings.cell) || !brushBounds(brush).grown(margin).meets(box)) continue;
    if (by_shape) brush.material = brush.tag = 0xFFFF;
    if (Result<void> emitted = emitBrush(builder, brush, settings.cell, ++layer); !emitted) return emitted.error();
  }
  return FieldProgram(builder.finish(), memory);
}

}  // namespace sgm
