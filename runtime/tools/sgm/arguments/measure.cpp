// Declares the command that measures meshes and voids.

#include <memory>
#include <vector>

#include "tools/cli/measure/commands.h"
#include "tools/sgm/arguments/shared.h"
#include "world/chunk_key.h"

namespace sgm::cli {
namespace {

/// Adds --from, --to and --radius. None of them can be combined with an option in `excluded`.
void addVoidOptions(CLI::App& app, MeasureOptions& options, const std::vector<CLI::Option*>& excluded) {
  CLI::Option* from = app.add_option("--from", options.from, "Find a path through the void from this point, in metres")
                          ->type_name("X,Y,Z")
                          ->check(checkPoint);
  CLI::Option* to =
      app.add_option("--to", options.to, "Target of that path")->type_name("X,Y,Z")->check(checkPoint)->needs(from);
  from->needs(to);
  CLI::Option* radius = app.add_option("--radius", options.radius,
                                       "Radius of the agent on that path, below 32 cells (0: a point); without --from "
                                       "only the voids are measured")
                            ->type_name("METRES")
                            ->check(numberIn(0.0, 1e6));
  for (CLI::Option* option : {from, to, radius}) {
    for (CLI::Option* other : excluded) option->excludes(other);
  }
}

}  // namespace

Command addMeasure(CLI::App& root) {
  CLI::App* app = root.add_subcommand(
      "measure", "Measure a mesh file, or a region of a grammar, and test whether it is the closed surface of a solid");
  const auto options = std::make_shared<MeasureOptions>();
  app->add_option("FILE", options->file, "A .glb, .gltf, .obj, .ply or .stl file, or a .sgm grammar")->required();
  app->add_flag("--json", options->json, "Print the result as one JSON object on standard output");
  addSandboxed(*app, options->sandbox);
  const std::vector<CLI::Option*> of_all = optionsBeside(*app, {});
  app->add_flag("--strict", options->strict,
                "Exit with status 1 if it is not the closed surface of a solid, if not all of it was tested, or if it "
                "has no triangles; the border of a grammar's region may cut it");
  app->add_option("--weld", options->weld,
                  "Weld points that are at most this far apart; 0: points with equal coordinates, which is right for "
                  "files that a program wrote")
      ->type_name("LENGTH")
      ->check(numberIn(0.0, 1e9))
      ->capture_default_str();
  app->add_option("--mode", options->mode,
                  "Histogram of dihedral angles: as printed in the paper, corrected, or by curvature")
      ->check(CLI::IsMember({"printed", "corrected", "curvature"}))
      ->capture_default_str();
  app->add_option("--bins", options->bins,
                  "Number of bins of the histogram; with an odd number, flat edges share a bin")
      ->check(CLI::Range(1, 4096))
      ->capture_default_str();
  app->add_option("--curvature-length", options->curvature_length,
                  "Scale of --mode curvature: a ball of this radius is at 3/4 of the range")
      ->type_name("LENGTH")
      ->check(numberIn(1e-9, 1e9))
      ->capture_default_str();
  app->add_flag("--unique-edges", options->unique_edges, "Count each edge once, instead of once per triangle");
  app->add_option(
         "--cubes", options->cubes,
         "Also measure the volume by cubes of this edge, under the three rules of which cubes are inside (equation 8)")
      ->type_name("LENGTH")
      ->check(numberIn(1e-9, 1e9));
  app->add_flag("--no-self-intersections", options->no_self_intersections,
                "Skip the test for triangles that intersect each other, which takes about half of the time");
  app->add_option("--against", options->against,
                  "Also measure the distance to the surface of this mesh file, both ways (Hausdorff distance)")
      ->type_name("FILE");
  app->add_flag(
      "--drawing", options->drawing,
      "Also measure the cost for a GPU to draw the triangles in their order: transformed vertices, shaded pixels");
  app->add_option("--texels", options->texels,
                  "Also measure how many texels of a texture of this resolution (1024) lie on a unit of length, and "
                  "how uniformly; the tiles of a grammar have 1 m")
      ->type_name("TEXELS")
      ->expected(0, 1)
      ->default_str("1024")
      ->check(numberIn(1.0, 1e6));
  app->add_flag("--field", options->field,
                "Also measure the angles between normals and the gradient of the field, and the field at the vertices; "
                "for grammars");
  app->add_option(
         "--levels", options->levels,
         "Also measure the distance of this many levels, from --level on, to the next coarser ones; for grammars")
      ->type_name("N")
      ->check(CLI::Range(1, kMaxLevel));
  const std::vector<CLI::Option*> before_limits = optionsBeside(*app, {});
  addSandboxLimits(*app, options->sandbox);
  const std::vector<CLI::Option*> of_files = optionsBeside(*app, before_limits), shared = optionsBeside(*app, {});
  addLevelOption(*app, *options);
  addSharpOption(*app, *options);
  std::vector<CLI::Option*> of_surfaces = optionsBeside(*app, of_all);
  addDerivationOptions(*app, *options);
  // voids are measured on the CPU, so their options exclude --backend
  of_surfaces.push_back(app->get_option("--backend"));
  addRegionOptions(*app, *options);
  addVoidOptions(*app, *options, of_surfaces);
  const std::vector<CLI::Option*> of_grammars = optionsBeside(*app, shared);
  app->footer(
      "Lengths are in the unit of the file, metres in .glb files and grammars. A mesh file is read and measured in\n"
      "a separate process, which --memory and --seconds limit; for a grammar they limit only the reading of the\n"
      "file of --against. --level to --radius are for grammars. Places are relative to the world's origin, even for\n"
      "files of sgm whose positions count from another origin.\n"
      "Open edges in the border of a grammar's region are not holes: the region cuts the surface there, and the\n"
      "volume means little. Dihedral angles are measured between normals averaged at the points, so that the faces\n"
      "of a cube are not flat; their histogram is in --json, and runtime/tools/README.md explains every key.\n"
      "Distances have a lower bound, from vertices and four places per triangle, and an upper bound, from\n"
      "subdividing triangles until no part can be farther away. For levels, triangles near the cut of a region are\n"
      "left out. If the field has no detail by level and nothing thinner than a cell, levels are at most 2.6 coarse\n"
      "cells apart, and smooth ones far less. Gradients are differences of the field in double precision; vertices\n"
      "in creases have no angle. The exit status is 0 for an invalid mesh, too, unless --strict is given; see\n"
      "\"valid\" and \"problems\" in --json.\n\n"
      "With --radius, or --from and --to, the command measures the void: how many separate voids an agent (a ball)\n"
      "finds in the region, and the path from one place to another. Without a path, the exit status is 1, and the\n"
      "message has the reason and the largest possible agent. Samples are a cell apart. An agent fits at one if no\n"
      "solid sample is within its radius; the surface may come nearer to the path than that by 2.5 cells, usually by\n"
      "one.\n"
      "Example:\n  sgm measure cave.glb --json\n"
      "  sgm measure samples/grammars/sphere.sgm --cell 0.25 --field --levels 3\n"
      "  sgm measure samples/grammars/cave.sgm --seed 3 --region=-10,-8,-10:130,20,130 --from 30,0.8,30 \\\n"
      "    --to 90,0.8,90 --radius 0.4");
  const auto given = [](const std::vector<CLI::Option*>& among) {
    std::vector<std::string> names;
    for (const CLI::Option* option : among)
      if (option->count() > 0 && !option->check_lname("threads")) names.push_back(option->get_name());
    return names;
  };
  return [options, of_grammars, of_files, given](const Words& words) {
    options->sandbox.words = words;
    options->of_grammars = given(of_grammars);
    options->of_files = given(of_files);
    return measureMesh(*options);
  };
}

}  // namespace sgm::cli
