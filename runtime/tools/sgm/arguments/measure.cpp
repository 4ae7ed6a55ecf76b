// The command that measures.

#include <memory>
#include <vector>

#include "tools/cli/measure/commands.h"
#include "tools/sgm/arguments/shared.h"
#include "world/chunk_key.h"

namespace sgm::cli {
namespace {

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

}  // namespace

Command addMeasure(CLI::App& root) {
  CLI::App* app = root.add_subcommand(
      "measure", "Measure a mesh file, or a region of a grammar, and say whether it is the closed surface of a solid");
  const auto options = std::make_shared<MeasureOptions>();
  app->add_option("FILE", options->file, "A .glb, .gltf, .obj, .ply or .stl file, or a .sgm grammar")->required();
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
      "their histogram is in --json, where runtime/tools/README.md explains every key.\n"
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
      "  sgm measure samples/grammars/cave.sgm --seed 3 --region=-10,-8,-10:130,20,130 --from 30,0.8,30 \\\n"
      "    --to 90,0.8,90 --radius 0.4");
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

}  // namespace sgm::cli
