// The command line, declared, and nothing else: whatever includes CLI11 takes its time to compile.

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <functional>
#include <memory>

#include "cli/commands.h"
#include "cli/inspect_arguments.h"
#include "cli/service_arguments.h"
#include "grammar/sink.h"
#include "mesh/export.h"
#include "sgm/sgm.h"
#include "stream/mesh_chunks.h"

namespace sgm::cli {
namespace {

/// What to run when a subcommand is the one given.
using Command = std::function<Exit()>;

/// As CLI::Range, which lets what is not a number pass, and says that 0 is not within 0.000000 and more.
CLI::Validator numberIn(double low, double high) {
  const auto check = [low, high](std::string& text) {
    double value = 0;
    if (!CLI::detail::lexical_cast(text, value) || std::isnan(value)) return fmt::format("'{}' is not a number", text);
    return value >= low && value <= high ? std::string() : fmt::format("{} is not from {:g} to {:g}", text, low, high);
  };
  return {check, fmt::format("FLOAT in [{:g} - {:g}]", low, high)};
}

// Checks for CLI11: "" or what is wrong.

std::string checkRegion(const std::string& text) {
  const size_t colon = text.find(':');
  if (colon != std::string::npos && readPoint(text.substr(0, colon)) && readPoint(text.substr(colon + 1))) return {};
  return fmt::format("'{}' is not x0,y0,z0:x1,y1,z1", text);
}

/// Signed text would wrap round into an unsigned number.
std::string checkWhole(const std::string& text) {
  uint64_t value = 0;
  const char* end = text.data() + text.size();
  const auto [rest, why] = std::from_chars(text.data(), end, value);
  return why == std::errc() && rest == end ? std::string()
                                           : fmt::format("'{}' is not a whole number from 0 to 2^64 - 1", text);
}

std::string checkSet(const std::string& text) {
  return text.find('=') == std::string::npos ? fmt::format("'{}' is not NAME=VALUE", text) : std::string();
}

std::string checkMeshFile(const std::string& out) {
  const Result<MeshFormat> format = meshFormatOf(out);
  return format ? std::string() : format.error().message;
}

std::string checkSize(const std::string& text) {
  if (readSize(text)) return {};
  return fmt::format("'{}' is not WIDTHxHEIGHT with 1 to {} pixels each", text, kMaxPicture);
}

std::string checkPoint(const std::string& text) {
  if (readPoint(text)) return {};
  return fmt::format("'{}' is not a point such as 1,2.5,-3", text);
}

std::string checkCamera(const std::string& text) {
  if (readCamera(text)) return {};
  return fmt::format("'{}' is not x,y,z:x,y,z in metres (from where, and to where)", text);
}

std::string checkLevels(const std::string& text) {
  return readLevels(text) ? std::string()
                          : fmt::format("'{}' is not levels such as 0..4, the finest first, or one alone, from 0 to {}",
                                        text, kMaxLevel);
}

std::string checkShard(const std::string& text) {
  return readShard(text) ? std::string()
                         : fmt::format("'{}' is not a shard such as 0/16, the last of which is 15/16", text);
}

std::string checkPng(const std::string& out) {
  const std::string extension = std::filesystem::path(out).extension().string();
  return CLI::detail::to_lower(extension) == ".png" ? std::string() : "pictures are .png files";
}

std::string checkVideo(const std::string& out) {
  const std::string extension = std::filesystem::path(out).extension().string();
  return CLI::detail::to_lower(extension) == ".mp4" ? std::string() : "videos are .mp4 files";
}

constexpr const char* kCheckFooter =
    "Example:\n"
    "  sgm check samples/grammars/cave.sgm\n"
    "  sgm check --expect samples/grammars/sphere.sgm --seeds 3\n"
    "\n"
    "With --expect every report becomes a line, and so does every expect that holds; one that fails is an error\n"
    "with its place and the measured value, and the exit status is 1. Measures:\n"
    "  watertight  the surface is a manifold, open only in the region's outer border, where the solid is cut\n"
    "  components  connected pieces of the solid, or with (air) of the void, inside the region; (solid above 1m3)\n"
    "              counts those that are larger\n"
    "  volume      m3 of the solid (equation 8 of the paper)\n"
    "  area        m2 of the surface (equation 7), without the faces where the border cuts the solid\n"
    "  triangles   of that surface\n"
    "  genus       handles, summed over closed surfaces; not measured, and so failed, where the border cuts one\n"
    "  anchors     inside the region\n"
    "Where: `in block(n)` is n cells, from cell 0 on, of the layer with the largest cells, on each axis that is cut\n"
    "into cells; on another axis it is what the layers reach. Without it: --region, else all of a finite world, else\n"
    "block(1). Regions are grown to whole chunks of 32 cells. `per Rule` measures each use of the rule whose frame\n"
    "stands in the region by itself, as solid in an empty world, without what encloses the call (a cut, a\n"
    "displacement, a smooth union). Cells are 0.5 m, doubled until the region, or all uses of the rule together, have\n"
    "at most --max-chunks chunks; --cell and --ld choose otherwise.";

void addLevelOption(CLI::App& app, WorldOptions& options) {
  app.add_option("--level", options.level, "Level of detail: each has cells of twice the edge; 0 is the finest")
      ->check(CLI::Range(0, kMaxLevel))
      ->capture_default_str();
}

/// --seed, --set, --backend, --threads.
void addDerivationOptions(CLI::App& app, WorldOptions& options) {
  app.add_option("--seed", options.seed, "Seed of the world, a whole number from 0")
      ->check(checkWhole)
      ->capture_default_str();
  app.add_option(
         "--set", options.sets,
         "Give a parameter of the grammar a value (repeatable); they are its `param` lines, and sgm check --json "
         "lists them")
      ->type_name("NAME=VALUE")
      ->allow_extra_args(false)
      ->check(checkSet);
  app.add_option("--backend", options.backend, "What computes")
      ->check(CLI::IsMember({"auto", "cpu", "vulkan", "cuda"}))
      ->capture_default_str();
  app.add_option("--threads", options.threads, "Threads to use; 0: one for each processor")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
}

/// FILE, --json, and those of addDerivationOptions.
void addWorldOptions(CLI::App& app, WorldOptions& options) {
  app.add_option("FILE", options.file, "The grammar, a .sgm file")->required();
  addDerivationOptions(app, options);
  app.add_flag("--json", options.json, "Print the result as one JSON object on standard output");
}

/// --region, --cell, --ld, --max-chunks.
void addRegionOptions(CLI::App& app, WorldOptions& options) {
  app.add_option("--region", options.region, "Region in metres, x0,y0,z0:x1,y1,z1, grown to whole chunks")
      ->type_name("BOX")
      ->check(checkRegion);
  CLI::Option* cell =
      app.add_option("--cell", options.cell,
                     "Edge of a sampling cell in metres (0.5; larger where a large part of an endless world is chosen)")
          ->type_name("METRES");
  app.add_option("--ld", options.density, "Sampling density of the paper: cells per metre, so a cell edge of 1/N m")
      ->type_name("N")
      ->excludes(cell);
  app.add_option("--max-chunks", options.max_chunks, "Refuse regions of more chunks than this")
      ->check(checkWhole)
      ->capture_default_str();
}

/// All options but these.
std::vector<CLI::Option*> optionsBeside(CLI::App& app, const std::vector<CLI::Option*>& others) {
  std::vector<CLI::Option*> options = app.get_options([](const CLI::Option*) { return true; });
  std::erase_if(options, [&](CLI::Option* o) { return std::find(others.begin(), others.end(), o) != others.end(); });
  return options;
}

Command addCheck(CLI::App& root) {
  CLI::App* app = root.add_subcommand(
      "check", "Check grammars and say what is wrong, with line and column; with --expect, evaluate report and expect");
  const auto options = std::make_shared<CheckOptions>();
  app->add_option("FILE", options->files, "Grammars, .sgm files")->required();
  app->add_flag("--json", options->json, "Print messages, parameters and layers as JSON on standard output");
  CLI::Option* expect =
      app->add_flag("--expect", options->expect, "Derive and mesh what the report and expect statements are about");
  const std::vector<CLI::Option*> plain = optionsBeside(*app, {});
  addDerivationOptions(*app, *options);
  addRegionOptions(*app, *options);
  app->add_option("--seeds", options->seeds, "Evaluate this many seeds, from --seed on, and name those that fail")
      ->check(CLI::Range(uint64_t{1}, uint64_t{1000000}))
      ->capture_default_str();
  for (CLI::Option* option : optionsBeside(*app, plain)) option->needs(expect);
  app->footer(kCheckFooter);
  return [options] { return check(*options); };
}

Command addFmt(CLI::App& root) {
  CLI::App* app = root.add_subcommand("fmt", "Print grammars in their canonical layout, or put them into it");
  const auto options = std::make_shared<FmtOptions>();
  app->add_option("FILE", options->files, "Grammars, .sgm files")->required();
  CLI::Option* write = app->add_flag("--write", options->write, "Change the files in place");
  app->add_flag("--check", options->check, "Change nothing; status 1 where a file is not in canonical layout")
      ->excludes(write);
  app->footer("Example:\n  sgm fmt --write samples/grammars/cave.sgm");
  return [options] { return format(*options); };
}

Command addExplain(CLI::App& root) {
  CLI::App* app = root.add_subcommand("explain", "Say which rules have made a place solid, or left it open");
  const auto options = std::make_shared<ExplainOptions>();
  addWorldOptions(*app, *options);
  app->add_option("--at", options->at, "The place in metres, x,y,z")->type_name("POINT")->required()->check(checkPoint);
  app->add_option("--cell", options->cell, "Edge of a sampling cell in metres (0.5): `detail` below it is left out")
      ->type_name("METRES");
  app->footer(
      "The paths are what `override` takes, and what messages print.\n"
      "Example:\n  sgm explain samples/grammars/building.sgm --at 0,-10,6");
  return [options] { return explain(*options); };
}

Command addLsp(CLI::App& root) {
  CLI::App* app = root.add_subcommand(
      "lsp", "Serve editors by the Language Server Protocol: diagnostics, completion, hover, definitions, formatting");
  app->add_flag("--stdio")->description("Standard input and output, which is what it serves anyway");
  app->footer("Editors start it; editor_plugin/vscode is one's extension.\nExample:\n  sgm lsp");
  return [] { return serveLanguage(); };
}

void addSharpOption(CLI::App& app, WorldOptions& options) {
  app.add_flag("--sharp", options.sharp,
               "Crisp edges and corners, which cells of a plain mesh cut off; smooth surfaces stay as they are");
}

Command addMesh(CLI::App& root) {
  CLI::App* app = root.add_subcommand("mesh", "Mesh a region and write it as .glb, .obj, .ply or .stl");
  const auto options = std::make_shared<MeshOptions>();
  addWorldOptions(*app, *options);
  addRegionOptions(*app, *options);
  addLevelOption(*app, *options);
  addSharpOption(*app, *options);
  app->add_option("--out", options->out,
                  "Mesh file to write; its ending chooses .glb, .obj (with its materials in a .mtl of the same name "
                  "beside it), .ply or .stl. Without it the mesh is only measured")
      ->check(checkMeshFile);
  app->add_flag("--uv", options->uv,
                "Texture coordinates in tiles of 1 m, by the shapes' own axes: along and around a passage. Into .glb "
                "and .obj, and how even they lie; in .glb also a chequered texture, and colours that pass into each "
                "other where materials meet");
  app->footer(
      "Positions in the file are metres from the world's origin. Where the region reaches further than 4096 m from it, "
      "they count from the region's lowest corner instead, which is then printed as the origin.\n"
      "Example:\n  sgm mesh samples/grammars/cave.sgm --out cave.glb --region 0,0,0:192,192,192 --cell 0.5 --seed 7");
  return [options] { return mesh(*options); };
}

Command addBake(CLI::App& root) {
  CLI::App* app = root.add_subcommand(
      "bake", "Mesh a region at several levels ahead of time, into a store that worlds stream from");
  const auto options = std::make_shared<BakeOptions>();
  addWorldOptions(*app, *options);
  addRegionOptions(*app, *options);
  app->remove_option(app->get_option("--max-chunks"));
  addSharpOption(*app, *options);
  app->add_option("--levels", options->levels, "Levels of detail, the finest first")
      ->type_name("A..B")
      ->check(checkLevels)
      ->capture_default_str();
  app->add_option("--out", options->out, "Folder of the store: a new one, or one that holds other worlds already")
      ->type_name("STORE")
      ->required();
  CLI::Option* shard =
      app->add_option(
             "--shard", options->shard,
             "Bake only share I of N, counted from 0; shares take about as long as each other, and may be baked "
             "at one time, in any order, on machines that share the folder")
          ->type_name("I/N")
          ->check(checkShard);
  CLI::Option* merge = app->add_flag("--merge", options->merge, "Make a world of what all shares have baked");
  merge->excludes(shard);
  CLI::Option* slurm =
      app->add_option(
             "--slurm", options->slurm,
             "Bake in this many shares as an array of jobs of Slurm, then merge and verify; the nodes see the same "
             "folders. What is under way already is shown")
          ->check(CLI::Range(uint64_t{1}, uint64_t{100000}))
          ->excludes(shard)
          ->excludes(merge);
  app->add_option("--sbatch", options->sbatch, "Option for every job, such as --sbatch=--partition=long (repeatable)")
      ->allow_extra_args(false)
      ->needs(slurm);
  app->add_flag("--detach", options->detach, "Submit the jobs, and do not wait for them")->needs(slurm);
  app->footer(
      "What is baked follows from grammar, parameters, seed, cells, region and levels alone: the store's bytes are "
      "the\n"
      "same however the work was shared. A bake that was stopped goes on where it was when it is called again. Chunks\n"
      "that are the same are stored once, on whatever level and in whatever world of the store.\n"
      "Example:\n  sgm bake samples/grammars/cave.sgm --region 0,0,0:256,256,256 --levels 0..3 --out store");
  return [options] { return bake(*options); };
}

void addStoreArgument(CLI::App& app, std::string& store) {
  app.add_option("STORE", store, "Folder of a store")->required();
}

Command addStoreVerify(CLI::App& group) {
  CLI::App* app = group.add_subcommand(
      "verify", "Read all of a store, and say whether it is whole; with a grammar, bake some chunks again and compare");
  const auto options = std::make_shared<StoreVerifyOptions>();
  addStoreArgument(*app, options->store);
  CLI::Option* file = app->add_option("FILE", options->file, "The grammar of one of its worlds: bake some of it again");
  app->add_option("--world", options->world, "Only the world whose name begins so")->excludes(file);
  app->add_flag("--json", options->json, "Print the result as one JSON object on standard output");
  const std::vector<CLI::Option*> plain = optionsBeside(*app, {});
  addDerivationOptions(*app, *options);
  addRegionOptions(*app, *options);
  app->remove_option(app->get_option("--max-chunks"));
  addSharpOption(*app, *options);
  app->add_option("--samples", options->samples, "Chunks to bake again")->check(checkWhole)->capture_default_str();
  app->add_option("--draw", options->draw, "Seed by which they are drawn")->check(checkWhole)->capture_default_str();
  for (CLI::Option* option : optionsBeside(*app, plain)) option->needs(file);
  app->footer(
      "Without a grammar: records, packs and contents by their checksums, and whether bodies of a level fit together "
      "at\n"
      "every face of two chunks. With one, parameters, seed, cells and --sharp must be those of the bake; a grammar of "
      "an\n"
      "endless world wants any --region. Exit status 1 where something is wrong.\n"
      "Example:\n  sgm store verify store samples/grammars/cave.sgm --region 0,0,0:1,1,1 --samples 50");
  return [options] { return storeVerify(*options); };
}

Command addStoreDiff(CLI::App& group) {
  CLI::App* app = group.add_subcommand("diff", "Say which chunks of a world are others in another bake");
  const auto options = std::make_shared<StoreDiffOptions>();
  app->add_option("STORE", options->store, "Folder of the store with the bake of before")->required();
  app->add_option("OTHER", options->other, "Folder of that with the other one; may be the same")->required();
  app->add_option("--from", options->from, "The world of before, by the beginning of its name")->type_name("WORLD");
  app->add_option("--to", options->to, "The other one, likewise")->type_name("WORLD");
  app->add_flag("--list", options->list, "Name each chunk: level, x, y, z");
  app->add_flag("--json", options->json, "Print the result as one JSON object on standard output");
  app->footer(
      "The bytes are those of contents that the bake of before does not have, wherever it has them.\n"
      "Example:\n  sgm store diff before after --list");
  return [options] { return storeDiff(*options); };
}

Command addStoreOf(CLI::App& group, const char* name, const char* what, Exit (*run)(const StoreOptions&),
                   bool by_world) {
  CLI::App* app = group.add_subcommand(name, what);
  const auto options = std::make_shared<StoreOptions>();
  addStoreArgument(*app, options->store);
  if (by_world) app->add_option("--world", options->world, "Only the world whose name begins so");
  app->add_flag("--json", options->json, "Print the result as one JSON object on standard output");
  app->footer(fmt::format("Example:\n  sgm store {} store", name));
  return [options, run] { return run(*options); };
}

Command addStore(CLI::App& root) {
  CLI::App* group = root.add_subcommand("store", "Stores of baked worlds: sgm store info, verify, diff, gc");
  group->require_subcommand(1);
  const std::vector<std::pair<const char*, Command>> commands{
      {"info", addStoreOf(*group, "info", "List the worlds of a store", storeInfo, true)},
      {"verify", addStoreVerify(*group)},
      {"diff", addStoreDiff(*group)},
      {"gc", addStoreOf(*group, "gc", "Remove files that no world of the store needs", storeClean, false)}};
  group->footer("sgm bake makes them.\nExample:\n  sgm store verify store");
  return [group, commands] {
    for (const auto& [name, command] : commands) {
      if (group->got_subcommand(name)) return command();
    }
    return Exit::usage;
  };
}

/// Of a process that reads a mesh file.
template <class Options>
void addProcessLimits(CLI::App& app, Options& options) {
  app.add_option("--memory", options.memory, "Megabytes (2^20 bytes) that a mesh file's reading and measuring may take")
      ->check(CLI::Range(uint64_t{64}, uint64_t{1} << 24))
      ->capture_default_str();
  app.add_option("--seconds", options.seconds, "Seconds that it may take, of the clock and of all threads together")
      ->check(numberIn(0.1, 1e6))
      ->capture_default_str();
}

/// --from, --to, --radius, which `excluded` says nothing to.
void addVoidOptions(CLI::App& app, MeasureOptions& options, const std::vector<CLI::Option*>& excluded) {
  CLI::Option* from =
      app.add_option("--from", options.from, "Look for a way through the void from this point, in metres")
          ->type_name("X,Y,Z")
          ->check(checkPoint);
  CLI::Option* to =
      app.add_option("--to", options.to, "And to this one")->type_name("X,Y,Z")->check(checkPoint)->needs(from);
  from->needs(to);
  CLI::Option* radius =
      app.add_option(
             "--radius", options.radius,
             "Of the agent that goes there, below 32 cells (0: a point); without --from measure the voids alone")
          ->type_name("METRES")
          ->check(numberIn(0.0, 1e6));
  for (CLI::Option* option : {from, to, radius}) {
    for (CLI::Option* other : excluded) option->excludes(other);
  }
}

Command addMeasure(CLI::App& root) {
  CLI::App* app = root.add_subcommand(
      "measure", "Measure a mesh file, or a region of a grammar, and say whether it is the closed surface of a solid");
  const auto options = std::make_shared<MeasureOptions>();
  app->add_option("FILE", options->file, "A .glb, .obj, .ply or .stl file, or a .sgm grammar")->required();
  app->add_flag("--json", options->json, "Print the result as one JSON object on standard output");
  const std::vector<CLI::Option*> of_all = optionsBeside(*app, {});
  app->add_flag("--strict", options->strict,
                "Exit with status 1 where it is not the closed surface of a solid, not all of it was looked at, or "
                "there are no triangles; of a grammar's region, the border may cut it");
  app->add_option("--weld", options->weld,
                  "Points at most so far apart are one; 0: those with equal coordinates, which is right for files that "
                  "a program wrote")
      ->type_name("LENGTH")
      ->check(numberIn(0.0, 1e9))
      ->capture_default_str();
  app->add_option("--mode", options->mode,
                  "Histogram of bends along edges: as the paper prints it, as it means it, or by curvature")
      ->check(CLI::IsMember({"printed", "corrected", "curvature"}))
      ->capture_default_str();
  app->add_option("--bins", options->bins, "Of the histogram; an odd number keeps flat edges together")
      ->check(CLI::Range(1, 4096))
      ->capture_default_str();
  app->add_option("--curvature-length", options->curvature_length,
                  "Of --mode curvature: a ball of this radius is at 3/4 of the range")
      ->type_name("LENGTH")
      ->check(numberIn(1e-9, 1e9))
      ->capture_default_str();
  app->add_flag("--unique-edges", options->unique_edges, "Count each edge once, not once a triangle");
  app->add_option("--cubes", options->cubes,
                  "Count cubes of this edge too, by the three rules for what lies inside (equation 8)")
      ->type_name("LENGTH")
      ->check(numberIn(1e-9, 1e9));
  app->add_flag("--no-self-intersections", options->no_self_intersections,
                "Do not look for triangles that cut each other: about half of the time");
  app->add_option("--against", options->against,
                  "Also how far this mesh file's surface lies from it, both ways (Hausdorff distance)")
      ->type_name("FILE");
  app->add_flag("--drawing", options->drawing,
                "Also what a GPU pays to draw it as its triangles are ordered: vertices transformed, pixels shaded");
  app->add_option("--texels", options->texels,
                  "Also how many texels of a texture of this resolution (1024) lie on a unit of length, and how "
                  "evenly; a grammar's tiles are of 1 m")
      ->type_name("TEXELS")
      ->expected(0, 1)
      ->default_str("1024")
      ->check(numberIn(1.0, 1e6));
  app->add_flag("--field", options->field,
                "Also the angles of normals to the field's gradient, and the field at the vertices; of a grammar");
  app->add_option("--levels", options->levels,
                  "Also how far so many levels, from --level on, lie from the next coarser ones; of a grammar")
      ->type_name("N")
      ->check(CLI::Range(1, kMaxLevel));
  const std::vector<CLI::Option*> before_limits = optionsBeside(*app, {});
  addProcessLimits(*app, *options);
  const std::vector<CLI::Option*> of_files = optionsBeside(*app, before_limits), shared = optionsBeside(*app, {});
  addLevelOption(*app, *options);
  addSharpOption(*app, *options);
  std::vector<CLI::Option*> of_surfaces = optionsBeside(*app, of_all);
  addDerivationOptions(*app, *options);
  of_surfaces.push_back(app->get_option("--backend"));  // voids are looked at on the CPU
  addRegionOptions(*app, *options);
  addVoidOptions(*app, *options, of_surfaces);
  const std::vector<CLI::Option*> of_grammars = optionsBeside(*app, shared);
  app->footer(
      "Lengths are in the file's unit, metres in .glb files and grammars. A mesh file is read and measured in a "
      "process\n"
      "of its own, which --memory and --seconds limit; of a grammar they limit the reading of --against's file alone.\n"
      "--level to --radius are for grammars. Places are told from the world's origin, also in files of sgm's whose\n"
      "positions count from another one.\n"
      "Open edges in the border of a grammar's region are no holes: the region cuts the surface there, and the volume\n"
      "says little. Bends are measured between normals averaged at the points, so that a cube's faces are not flat;\n"
      "their histogram is in --json, where runtime/cli/README.md explains every key.\n"
      "Distances are bounded from both sides: from vertices and four places a triangle, and by cutting triangles "
      "until\n"
      "no part may be farther. Of levels, triangles near the cut of a region are left out. Where the field has no\n"
      "detail by level and nothing thinner than a cell, levels are at most 2.6 coarse cells apart, smooth ones far "
      "less.\n"
      "Gradients are differences of the field in double precision; vertices in its creases have no angle.\n"
      "Exit status 0 also where the mesh is not valid, but with --strict: \"valid\" and \"problems\" in --json say "
      "so.\n\n"
      "With --radius or --from and --to it is the void that is measured: how many separate voids an agent, a ball,\n"
      "finds in the region, and the way from one place to another. Exit status 1 where there is none: it says why,\n"
      "and how large an agent may be. An agent fits at a sample where no solid sample, a cell apart, is as near as\n"
      "its radius; the surface may come nearer to the way than that by 2.5 cells, as a rule by one.\n"
      "Example:\n  sgm measure cave.glb --json\n"
      "  sgm measure samples/grammars/sphere.sgm --cell 0.25 --field --levels 3\n"
      "  sgm measure samples/grammars/cave.sgm --seed 3 --region 96,-192,0:320,-32,192 --from 108,-72,72 \\\n"
      "    --to 296,-104,104 --radius 0.5");
  const auto given = [](const std::vector<CLI::Option*>& among) {
    std::vector<std::string> names;
    for (const CLI::Option* option : among)
      if (option->count() > 0 && !option->check_lname("threads")) names.push_back(option->get_name());
    return names;
  };
  return [options, of_grammars, of_files, given] {
    options->of_grammars = given(of_grammars);
    options->of_files = given(of_files);
    return measureMesh(*options);
  };
}

Command addClassify(CLI::App& root) {
  CLI::App* app = root.add_subcommand(
      "classify", "Say whether a mesh file, or a region of a grammar, is a cave, a cloud, a building or unknown");
  const auto options = std::make_shared<ClassifyOptions>();
  app->add_option("FILE", options->file, "A .glb, .obj, .ply or .stl file in metres, or a .sgm grammar")->required();
  app->add_flag("--json", options->json, "Print the result as one JSON object on standard output");
  app->add_option("--masters", options->masters,
                  "A base of masters, from `sgm masters build`. Without it $XDG_DATA_HOME/sgm/masters.db, or "
                  "~/.local/share/sgm/masters.db, or where there is none the masters that are built in")
      ->type_name("FILE");
  app->add_option("--mode", options->mode,
                  "Histogram of bends along edges: by curvature, at any density; as the paper prints it, or as it "
                  "means it, which need masters of the same density")
      ->check(CLI::IsMember({"printed", "corrected", "curvature"}))
      ->capture_default_str();
  addProcessLimits(*app, *options);
  addDerivationOptions(*app, *options);
  addRegionOptions(*app, *options);
  addLevelOption(*app, *options);
  addSharpOption(*app, *options);
  app->footer(
      "The class of the nearest master by the mean squared error, as in the paper; `unknown` where no master is near,\n"
      "or one of noise is nearest. Edges that touch a border of the mesh do not count: there a region is cut off.\n"
      "Without --region all of a finite world, or one cell of its largest layer. --ld also says the density of a mesh\n"
      "file, which --mode printed and corrected need. --seed to --sharp are for grammars. Exit status 0 also for\n"
      "`unknown`.\n"
      "Example:\n  sgm classify cave.glb --json\n  sgm classify samples/grammars/storeys.sgm");
  return [options] { return classifyMesh(*options); };
}

Command addMasters(CLI::App& root) {
  CLI::App* group = root.add_subcommand("masters", "Make the masters that sgm classify compares with, and list them");
  group->require_subcommand(1);
  CLI::App* build = group->add_subcommand(
      "build", "Generate caves, clouds and buildings from the sample grammars, and make masters of them");
  const auto built = std::make_shared<MastersBuildOptions>();
  build
      ->add_option("--out", built->out,
                   "The base to write; what it held is replaced. Without it the one that sgm classify reads")
      ->type_name("FILE");
  build->add_option("--emit", built->emit, "Write the masters as source, in the way in which they are built in")
      ->type_name("FILE");
  build->add_option("--models", built->models, "Of each grammar at each density")
      ->check(CLI::Range(uint64_t{2}, uint64_t{10000}))
      ->capture_default_str();
  build->add_option("--seed", built->seed, "Of the models: no two seeds have one in common")
      ->check(checkWhole)
      ->capture_default_str();
  build->add_option("--threads", built->threads, "Threads to use; 0: one for each processor")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  build->footer("Example:\n  sgm masters build --out masters.db --models 4");
  CLI::App* list = group->add_subcommand("list", "Say which masters there are");
  const auto listed = std::make_shared<MastersListOptions>();
  list->add_option("FILE", listed->file, "A base; without it the one that sgm classify reads");
  list->add_flag("--json", listed->json, "Print them, with their histograms, as one JSON object on standard output");
  list->footer("Example:\n  sgm masters list --json");
  group->footer("Example:\n  sgm masters list\n  sgm masters build --out masters.db");
  return [build, built, listed] { return build->parsed() ? buildMasters(*built) : listMasters(*listed); };
}

Command addRender(CLI::App& root) {
  CLI::App* app = root.add_subcommand("render", "Draw a picture of a region, off-screen");
  const auto options = std::make_shared<RenderOptions>();
  addWorldOptions(*app, *options);
  addRegionOptions(*app, *options);
  addLevelOption(*app, *options);
  addSharpOption(*app, *options);
  app->add_option("--out", options->out, "Picture to write, a .png file")->required()->check(checkPng);
  app->add_flag("--uv", options->uv,
                "Show texture coordinates: chequers of half a metre, lines of u red and of v green at whole metres");
  CLI::Option* camera =
      app->add_option("--camera", options->camera,
                      "From where to where to look in metres, x,y,z:x,y,z; without it, a view is chosen")
          ->type_name("VIEW")
          ->check(checkCamera);
  app->add_option("--at", options->at, "Look from an anchor of this name, kind or tag")
      ->type_name("ANCHOR")
      ->excludes(camera);
  app->add_option("--size", options->size, "Pixels, WIDTHxHEIGHT")->check(checkSize)->capture_default_str();
  app->add_option("--fov", options->fov, "Angle across the picture's height, in degrees")
      ->check(numberIn(1.0, 150.0))
      ->capture_default_str();
  app->add_flag("--volume", options->volume,
                "Draw the solid as fog, by its density at the cells' corners; for grammars that say `output density`")
      ->excludes(app->add_flag("--wires", options->wires, "Draw the mesh's edges, on a surface without materials"));
  app->footer("Example:\n  sgm render samples/grammars/cave.sgm --out cave.png --at spawn --seed 7");
  return [options] { return render(*options); };
}

Command addFly(CLI::App& root) {
  CLI::App* app = root.add_subcommand("fly", "Stream a world along a path, frame by frame, and say how well it went");
  const auto options = std::make_shared<FlyOptions>();
  addWorldOptions(*app, *options);
  CLI::Option* cell =
      app->add_option("--cell", options->cell, "Edge of a level-0 cell in metres (0.5)")->type_name("METRES");
  app->add_option("--ld", options->density, "Cells per metre, so a cell edge of 1/N m")->type_name("N")->excludes(cell);
  CLI::Option* path = app->add_option(
      "--path", options->path, "Path to follow, a JSON file: {\"points\": [[x, y, z], ...], \"loop\": true}, metres");
  app->add_flag_callback(
         "--auto", [] {}, "Find a way through the void of the world: what it does without --path")
      ->excludes(path);
  app->add_option("--speed", options->speed, "Metres a second")->check(numberIn(0.0, 1000.0))->capture_default_str();
  app->add_option("--frames", options->frames, "Frames of 1/60 s")
      ->check(CLI::Range(uint64_t{1}, uint64_t{100000000}))
      ->capture_default_str();
  app->add_option("--teleports", options->teleports, "Leaps to far places, spread over the frames")
      ->check(checkWhole)
      ->excludes(path)
      ->capture_default_str();
  app->add_option("--edits", options->edits,
                  "Dig while flying, mostly holes of 4 m: N times a second of the path, once without N. Without "
                  "--edits nothing is dug")
      ->type_name("N")
      ->expected(0, 1)
      ->default_str("1")
      ->check(numberIn(0.0, 60.0));
  CLI::Option* animate =
      app->add_option("--animate", options->animated,
                      "Drive these parameters through their ranges, there and back in 10 s, ten times a second. "
                      "Without a name: those that the grammar declares `animated`")
          ->type_name("NAME")
          ->expected(0, -1);
  app->add_flag(
      "--check", options->check,
      "Check every frame's surface for open and non-manifold edges by exact keys, and each 500th frame whole. "
      "Status 1 where one is not closed");
  app->add_flag("--measure", options->measure,
                "Measure every chunk as soon as it is meshed: what is wrong with it, area, volume. Status 1 where "
                "anything is wrong");
  app->add_flag("--unpaced", options->unpaced,
                "As soon as there is something new to draw, instead of 60 frames a second");
  addSharpOption(*app, *options);
  CLI::Option* compare =
      app->add_flag("--compare", options->compare, "Fly a second time with level 0 by distance alone, to compare");
  app->add_option("--top-level", options->top_level, "Coarsest level of detail")
      ->check(CLI::Range(0, kMaxLevel))
      ->capture_default_str();
  app->add_option("--finest", options->finest, "Metres within which what is seen shall be of level 0")
      ->check(numberIn(1.0, 10000.0))
      ->capture_default_str();
  app->add_option("--margin", options->finest_margin, "Metres beyond that where level 0 is meshed ahead")
      ->check(numberIn(0.0, 1000.0))
      ->capture_default_str();
  app->add_option("--view", options->view, "Metres within which anything is drawn")
      ->check(numberIn(1.0, 100000.0))
      ->capture_default_str();
  app->add_option("--mesh-mb", options->mesh_mb, "Most megabytes (2^20 bytes) of meshes")
      ->check(CLI::Range(uint64_t{1}, uint64_t{1} << 20))
      ->capture_default_str();
  CLI::Option* png = app->add_option("--png", options->pictures, "Draw this many frames on one sheet")
                         ->check(CLI::Range(uint64_t{1}, uint64_t{64}));
  app->add_option("--out", options->out, "The sheet, a .png file")->check(checkPng)->needs(png)->capture_default_str();
  app->add_flag("--levels", options->levels, "Each level of detail in a colour of its own, in pictures");
  app->add_option(
         "--video", options->video,
         "Draw every second frame into a video, an .mp4 file, by the program ffmpeg. The flight waits for each "
         "picture, but the world is streamed on")
      ->check(checkVideo);
  app->add_option("--cache", options->cache, "Folder that keeps meshed chunks from one flight to the next")
      ->type_name("FOLDER");
  app->add_option(
         "--store", options->stores,
         "Baked worlds to stream from, in a folder or at http:// or https:// (repeatable); what is not there is "
         "derived")
      ->type_name("STORE")
      ->allow_extra_args(false);
  app->add_option("--journal", options->journal, "File that keeps what is dug from one flight to the next")
      ->type_name("FILE")
      ->excludes(compare);
  CLI::Option* serve =
      app->add_flag("--serve", options->serve,
                    "Show the flight on a page and in metrics over HTTP, as sgm serve does, while it goes on");
  app->add_flag("--keep-serving", options->keep_serving,
                "Serve on when the flight has ended, until SIGINT, SIGTERM or SIGHUP; the report comes then")
      ->needs(serve);
  addServingOptions(*app, options->serving, serve);
  app->footer(
      "Example:\n  sgm fly samples/grammars/cave.sgm --cell 0.25 --speed 20 --frames 1200 --png 6 --out flight.png");
  return [options, animate] {
    options->animate = animate->count() > 0;
    std::erase(options->animated, "");  // what stands for no name
    return fly(*options);
  };
}

Command addBenchChunks(CLI::App& group) {
  CLI::App* app = group.add_subcommand(
      "chunks", "How fast this machine's processor meshes a region of a grammar's world, by each instruction set");
  const auto options = std::make_shared<BenchChunksOptions>();
  addWorldOptions(*app, *options);
  addRegionOptions(*app, *options);
  addLevelOption(*app, *options);
  app->add_option("--runs", options->runs, "Runs that count, after the first; the time is their median")
      ->check(CLI::Range(uint64_t{1}, uint64_t{1000}))
      ->capture_default_str();
  app->footer(
      "Rows for one thread, and for --threads. Exit status 1 where two sets, or two numbers of threads, make different "
      "meshes.\n"
      "Example:\n  sgm bench chunks samples/grammars/cave.sgm --region 0,0,0:128,128,128");
  return [options] { return benchChunks(*options); };
}

Command addBenchPaper(CLI::App& group) {
  CLI::App* app = group.add_subcommand(
      "paper",
      "The paper's tables 1 to 3 of this runtime: speedup, efficiency and throughput of cave, cloud, building");
  const auto options = std::make_shared<BenchOptions>();
  app->add_option("--runs", options->runs, "Runs that count, after one that warms up; the times are their median")
      ->check(CLI::Range(uint64_t{1}, uint64_t{1000}))
      ->capture_default_str();
  app->add_option(
         "--backend", options->backends,
         "Measure this one beside the sequential CPU (repeatable). Without it all of them, but software Vulkan, "
         "which --backend vulkan measures")
      ->allow_extra_args(false)
      ->check(CLI::IsMember({"cpu", "vulkan", "cuda"}));
  app->add_option("--threads", options->threads, "Threads beside the sequential one; 0: one for each processor")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  CLI::Option* cell =
      app->add_option("--cell", options->cell, "Edge of a sampling cell in metres, in all stages")->type_name("METRES");
  app->add_option("--size", options->cells,
                  "Sampling cells on the edge of each stage's cube, of 64 m of cave, 1024 m of sky, 32 m of building")
      ->type_name("CELLS")
      ->check(CLI::Range(uint64_t{8}, uint64_t{1024}))
      ->excludes(cell)
      ->capture_default_str();
  app->add_flag("--json", options->json, "Print the result as one JSON object on standard output");
  app->footer(
      "Exit status 1 where two backends, or two runs, make different meshes.\n"
      "Example:\n  sgm bench paper --size 64 --runs 3");
  return [options] { return benchPaper(*options); };
}

Command addBench(CLI::App& root) {
  CLI::App* group = root.add_subcommand("bench", "Measure this machine: sgm bench chunks, sgm bench paper");
  group->require_subcommand(1);
  const Command chunks = addBenchChunks(*group), paper = addBenchPaper(*group);
  group->footer("Example:\n  sgm bench paper --size 64 --runs 3");
  return [group, chunks, paper] { return group->got_subcommand("chunks") ? chunks() : paper(); };
}

Command addPaper(CLI::App& root) {
  CLI::App* app = root.add_subcommand(
      "paper",
      "Reproduce the paper that the language comes from: one HTML report of its figures and tables, ours beside");
  const auto options = std::make_shared<PaperOptions>();
  app->add_option(
         "--out", options->out,
         "Folder to write: a new or an empty one, or that of an earlier report, in which nothing was added or changed")
      ->type_name("DIR")
      ->required();
  app->add_option(
         "--only", options->only,
         "Make this part alone (repeatable): speedup, cloud, cave, architecture, density, objects, histograms, "
         "time, comparison")
      ->type_name("PART")
      ->allow_extra_args(false)
      ->check(CLI::IsMember(paperParts()));
  app->add_flag("--quick", options->quick, "Larger cells, fewer runs and models, smaller pictures");
  app->add_flag("--no-pictures", options->no_pictures,
                "Leave the pictures out, and do without a Vulkan device to draw them with; charts and tables stay");
  app->add_option("--backend", options->backend, "What computes")
      ->check(CLI::IsMember({"auto", "cpu", "vulkan", "cuda"}))
      ->capture_default_str();
  app->add_option("--threads", options->threads, "Threads to use; 0: one for each processor")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  app->add_option("--seed", options->seed, "Of what is drawn by chance: models to be classified, and skies")
      ->check(checkWhole)
      ->capture_default_str();
  app->add_flag("--json", options->json, "Print the report's numbers as one JSON object on standard output");
  app->footer(
      "Takes a few minutes on two cores. The folder is there when all is done, or not at all. Pictures are drawn\n"
      "off-screen, on a Vulkan device, software too. But for times and what follows from them, the same options give\n"
      "the same report.\n"
      "Example:\n  sgm paper --out paper --quick");
  return [options] { return reproducePaper(*options); };
}

Command addBackends(CLI::App& root) {
  CLI::App* app = root.add_subcommand("backends", "List what can compute and draw on this machine, and why not");
  const auto json = std::make_shared<bool>(false);
  app->add_flag("--json", *json, "Print the list as one JSON object on standard output");
  app->footer("Example:\n  sgm backends --json");
  return [json] { return listBackends(*json); };
}

/// Of a word that stands where a command should: what is wrong with it; else the parser's own message.
std::string complaintOf(const CLI::App& root, const CLI::ParseError& error, int argc, char** argv) {
  std::vector<const CLI::App*> commands = root.get_subcommands(nullptr);
  for (int i = 1; i < argc && !commands.empty() && argv[i][0] != '-'; ++i) {
    const std::string word = argv[i];
    const auto known = std::ranges::find(commands, word, [](const CLI::App* command) { return command->get_name(); });
    if (known != commands.end()) {
      commands = (*known)->get_subcommands(nullptr);
      continue;
    }
    Suggestion suggestion(word);
    std::string all;
    for (const CLI::App* command : commands) {
      if (command->get_group().empty()) continue;  // not for people
      suggestion.offer(command->get_name());
      all += (all.empty() ? "" : ", ") + command->get_name();
    }
    const std::string_view best = suggestion.best();
    return fmt::format("there is no command '{}': {}", word,
                       best.empty() ? "write one of " + all : fmt::format("did you mean '{}'?", best));
  }
  return error.what();
}

}  // namespace

Exit runCommandLine(int argc, char** argv) {
  CLI::App app("Shape grammars with morphing: from grammar text to meshes and pictures.", "sgm");
  app.set_version_flag("--version", std::string("sgm ") + sgm_version_string());
  app.require_subcommand(1);
  app.footer(
      "Run sgm COMMAND --help for its options and an example.\n"
      "Exit status: 0 done; 1 the input is wrong; 2 usage; 3 no such backend or device here; 4 a file could not "
      "be read or written; the highest of several.");
  std::vector<Command> commands;
  for (const auto add : {addCheck, addFmt, addExplain, addMesh, addBake, addStore, addMeasure, addClassify, addMasters,
                         addRender, addFly, addServe, addInspect, addLsp, addBench, addPaper, addBackends})
    commands.push_back(add(app));

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) return app.exit(e), Exit::done;
    fmt::print(stderr, "sgm: usage: {}\nRun sgm --help, or sgm COMMAND --help.\n", complaintOf(app, e, argc, argv));
    return Exit::usage;
  }
  const std::vector<CLI::App*> all = app.get_subcommands([](CLI::App*) { return true; });
  for (size_t i = 0; i < all.size(); ++i) {
    if (all[i]->parsed()) return commands[i]();
  }
  return Exit::usage;
}

}  // namespace sgm::cli
