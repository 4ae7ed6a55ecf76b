// `sgm mesh`: writes a region of a grammar's world to a mesh file.

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <filesystem>

#include "base/json.h"
#include "mesh/export/export.h"
#include "region/measure.h"
#include "region/solid_volume.h"
#include "sgm/sgm.h"
#include "tools/cli/picture/commands.h"
#include "tools/support/checkerboard.h"
#include "tools/support/console.h"
#include "tools/support/ending_signals.h"
#include "tools/support/materials.h"
#include "tools/support/region.h"

namespace sgm::cli {
namespace {

struct Summary {
  Measures measures;
  double volume = 0, void_volume = 0;  ///< volume in m3 of the solid and of the void, by the divergence theorem
  double cubes = 0, void_cubes = 0;    ///< volume in m3 of the solid and of the void, by counting cubes (equation 8 of
                                       ///< the paper)
  std::vector<std::string> files;
  uint64_t bytes = 0;  ///< total size of all written files
};

void printJson(const MeshOptions& options, const Region& region, const Summary& summary) {
  Json json = toJson(options, region);
  json.update({{"area", summary.measures.area},
               {"volume", summary.volume},
               {"void_volume", summary.void_volume},
               {"cubes", {{"edge", metres(region.cell)}, {"solid", summary.cubes}, {"void", summary.void_cubes}}},
               {"objects", summary.measures.objects},
               {"device", region.device}});
  if (!options.out.empty()) {
    json["out"] = options.out;
    for (const std::string& file : summary.files) json["files"].push_back(file);
    json["bytes"] = summary.bytes;
  }
  fmt::print("{}\n", json.text());
}

void printText(const MeshOptions& options, const Region& region, const Summary& summary) {
  const IntBox& box = region.meshed.extent;
  const size_t triangles = region.meshed.mesh.indices.size() / 3, vertices = region.meshed.mesh.positions.size();
  if (options.out.empty()) {
    fmt::print("{} triangles, {} vertices, {:.2f} s\n", triangles, vertices, region.seconds);
  } else {
    fmt::print("{}: {} triangles, {} vertices, {:.1f} MB, {:.2f} s\n", fmt::join(summary.files, ", "), triangles,
               vertices, static_cast<double>(summary.bytes) / 1e6, region.seconds);
  }
  fmt::print("  region   {},{},{} to {},{},{} m: {} chunks, cells of {} m ({} units)\n", metres(box.lo.x),
             metres(box.lo.y), metres(box.lo.z), metres(box.hi.x), metres(box.hi.y), metres(box.hi.z),
             region.meshed.chunks, metres(region.cell), region.cell);
  if (const Int3 o = region.meshed.mesh.origin; o != Int3{})
    fmt::print("  origin   {},{},{} m: positions count from here\n", metres(o.x), metres(o.y), metres(o.z));
  fmt::print("  area     {:.1f} m2 (equation 7: half of each triangle's cross product)\n", summary.measures.area);
  fmt::print("  volume   {:.1f} m3 solid, {:.1f} m3 open (divergence theorem, closed at the region's border)\n",
             summary.volume, summary.void_volume);
  fmt::print("  cubes    {:.1f} m3 solid, {:.1f} m3 open (equation 8: cubes of one cell, each centred on a sample)\n",
             summary.cubes, summary.void_cubes);
  fmt::print("  objects  {} (section 7.3: triangles joined by shared vertices)\n", summary.measures.objects);
  if (region.texture) {
    const TexelDensity& density = region.texture->density;
    fmt::print(
        "  texture  tiles of 1 m are {:.2f} to {:.2f} times as dense on 90 % of the surface, {:.2f} at the median; "
        "{:.1f} % of the vertices are duplicated by charts and materials\n",
        density.low, density.high, density.middle, 100 * density.seams);
  }
  fmt::print("  hash     {:016x} (seed {}, {} on {})\n", region.meshed.hash.value(), options.seed, region.backend,
             region.device);
}

/// Measures the meshed region. Volumes are those of the solid and of the void inside the region.
Result<void> measureRegion(const WorldField& world, const Region& region, const MeshOptions& options,
                           Summary& summary) {
  const IntBox& extent = region.meshed.extent;
  const WorldMesh& mesh = region.unsplit ? *region.unsplit : region.meshed.mesh;
  summary.measures = measuresOf(mesh, extent.lo);
  const Result<double> border = borderFlux(world, extent, options.level, mesh);
  if (!border) return border.error();
  summary.volume = solidVolume(world, extent, summary.measures.flux + *border);
  summary.cubes = cubeVolume(region.meshed.solid_samples, region.cell);
  summary.void_cubes = cubeVolume(region.samples() - region.meshed.solid_samples, region.cell);
  summary.void_volume = summary.cubes + summary.void_cubes - summary.volume;
  return {};
}

}  // namespace

Exit mesh(const MeshOptions& options) {
  if (options.uv && !options.out.empty() && !MeshFile::holdsTexture(options.out)) {
    return reportError(Exit::usage, "--uv: only .glb and .obj files have texture coordinates; write one of these");
  }
  // Open the output file before the long meshing, so that its errors are reported at once.
  std::optional<MeshFile> file;
  if (!options.out.empty()) {
    Result<MeshFile> opened = MeshFile::create(options.out, &unfinished_files);
    if (!opened) return reportError(opened.error());
    file.emplace(std::move(*opened));
  }
  Summary summary;
  RegionPlan plan;
  plan.texture = options.uv;
  plan.after = [&](const WorldField& world, Backend&, JobSystem&, const Region& region) {
    return measureRegion(world, region, options, summary);
  };
  const RegionResult made = meshRegion(options, plan);
  if (!made.region) return made.status;
  const Region& region = *made.region;
  if (file) {
    ExportInfo info;
    info.name = std::filesystem::path(options.file).stem().string();
    info.generator = std::string("sgm ") + sgm_version_string();
    info.materials = exportMaterials(*region.program);
    for (const std::pmr::string& tag : region.program->tags) info.tags.emplace_back(tag);
    ExportTexture texture;
    std::vector<uint32_t> vertices;
    std::vector<std::array<float, 2>> coordinates;
    std::vector<ExportBlend> blends;
    std::vector<std::byte> checkerboard;
    if (region.texture) {
      Result<std::vector<std::byte>> drawn = checkerboardPng();
      if (!drawn) return reportError(drawn.error());
      checkerboard = std::move(*drawn);
      for (const Wedge& wedge : region.texture->unwrapped.wedges) {
        vertices.push_back(wedge.vertex);
        coordinates.push_back({wedge.u, wedge.v});
        blends.push_back({wedge.materials, wedge.share, wedge.plane_shares});
      }
      texture = {vertices, coordinates, blends, region.texture->unwrapped.corners, checkerboard};
      info.texture = &texture;
    }
    if (Result<void> ok = file->write(region.meshed.mesh, info); !ok) return reportError(ok.error());
    for (const std::filesystem::path& path : file->paths()) summary.files.push_back(path.string());
    summary.bytes = file->bytes();
  }
  if (!region.empty_because.empty()) fmt::print(stderr, "sgm: warning: no triangles: {}\n", region.empty_because);
  if (options.json) {
    printJson(options, region, summary);
  } else {
    printText(options, region, summary);
  }
  return Exit::done;
}

}  // namespace sgm::cli
