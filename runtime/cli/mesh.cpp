// sgm mesh: a region of a grammar's world as one mesh file.

#include <fmt/core.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "cli/materials.h"
#include "cli/measure.h"
#include "cli/region.h"
#include "mesh/export.h"
#include "sgm/sgm.h"

namespace sgm::cli {
namespace {

using Json = nlohmann::ordered_json;

struct MeshOptions : WorldOptions {
  std::string out;
};

std::string checkOut(const std::string& out) {
  const Result<MeshFormat> format = meshFormatOf(out);
  return format ? std::string() : format.error().message;
}

double metres(int32_t units) { return static_cast<double>(units) / kUnitsPerMetre; }

Json metres(Int3 p) { return {metres(p.x), metres(p.y), metres(p.z)}; }

struct Summary {
  Measures measures;
  double volume = 0, void_volume = 0;
  uint64_t bytes = 0;
};

void printJson(const MeshOptions& options, const Region& region, const Summary& summary) {
  Json json{{"triangles", region.meshed.mesh.indices.size() / 3},
            {"vertices", region.meshed.mesh.positions.size()},
            {"chunks", region.meshed.chunks},
            {"seconds", region.seconds},
            {"hash", fmt::format("{:016x}", region.meshed.hash.value())},
            {"seed", options.seed},
            {"cell", metres(region.cell)},
            {"cell_units", region.cell},
            {"density", 1 / metres(region.cell)},
            {"region", {metres(region.meshed.extent.lo), metres(region.meshed.extent.hi)}},
            {"area", summary.measures.area},
            {"volume", summary.volume},
            {"void_volume", summary.void_volume},
            {"objects", summary.measures.objects},
            {"anchors", region.anchors.size()},
            {"backend", region.backend},
            {"device", region.device}};
  if (!options.out.empty()) json.update({{"out", options.out}, {"bytes", summary.bytes}});
  fmt::print("{}\n", json.dump(2));
}

void printText(const MeshOptions& options, const Region& region, const Summary& summary) {
  const IntBox& box = region.meshed.extent;
  const size_t triangles = region.meshed.mesh.indices.size() / 3, vertices = region.meshed.mesh.positions.size();
  if (options.out.empty()) {
    fmt::print("{} triangles, {} vertices, {:.2f} s\n", triangles, vertices, region.seconds);
  } else {
    fmt::print("{}: {} triangles, {} vertices, {:.1f} MB, {:.2f} s\n", options.out, triangles, vertices,
               static_cast<double>(summary.bytes) / 1e6, region.seconds);
  }
  fmt::print("  region   {},{},{} to {},{},{} m: {} chunks, cells of {} m ({} units)\n", metres(box.lo.x),
             metres(box.lo.y), metres(box.lo.z), metres(box.hi.x), metres(box.hi.y), metres(box.hi.z),
             region.meshed.chunks, metres(region.cell), region.cell);
  fmt::print("  area     {:.1f} m2 (equation 7: half of each triangle's cross product)\n", summary.measures.area);
  fmt::print("  volume   {:.1f} m3 solid, {:.1f} m3 open (equation 8: cubes of one cell, each centred on a sample)\n",
             summary.volume, summary.void_volume);
  fmt::print("  objects  {} (section 7.3: triangles joined by shared vertices)\n", summary.measures.objects);
  fmt::print("  hash     {:016x} (seed {}, {} on {})\n", region.meshed.hash.value(), options.seed, region.backend,
             region.device);
}

Exit mesh(const MeshOptions& options) {
  const RegionResult made = meshRegion(options);
  if (!made.region) return made.status;
  const Region& region = *made.region;
  Summary summary;
  summary.measures = measure(region.meshed.mesh);
  summary.volume = cubeVolume(region.meshed.solid_samples, region.cell);
  summary.void_volume = cubeVolume(region.samples() - region.meshed.solid_samples, region.cell);
  if (!options.out.empty()) {
    ExportInfo info;
    info.name = std::filesystem::path(options.file).stem().string();
    info.generator = std::string("sgm ") + sgm_version_string();
    info.materials = exportMaterials(*region.program);
    for (const std::pmr::string& tag : region.program->tags) info.tags.emplace_back(tag);
    if (Result<void> ok = exportMesh(region.meshed.mesh, info, options.out); !ok) return complain(ok.error());
    std::error_code why;
    const uintmax_t bytes = std::filesystem::file_size(options.out, why);
    summary.bytes = why ? 0 : bytes;
  }
  if (options.json) {
    printJson(options, region, summary);
  } else {
    printText(options, region, summary);
  }
  return Exit::done;
}

}  // namespace

Command addMesh(CLI::App& root) {
  CLI::App* app = root.add_subcommand("mesh", "Mesh a region and write it as .glb, .obj, .ply or .stl");
  const auto options = std::make_shared<MeshOptions>();
  addWorldOptions(*app, *options);
  addRegionOptions(*app, *options);
  app->add_option("--out", options->out,
                  "Mesh file to write; its ending chooses .glb, .obj, .ply or .stl. Without it the "
                  "mesh is only measured")
      ->check(checkOut);
  app->footer(
      "Example:\n  sgm mesh samples/grammars/cave.sgm --out cave.glb --region 0,0,0:192,192,192 --cell 0.5 --seed 7");
  return [options] { return mesh(*options); };
}

}  // namespace sgm::cli
