// Declares the commands that classify meshes, and that build the reference histograms for classification.

#include <memory>

#include "tools/cli/classify/commands.h"
#include "tools/sgm/arguments/shared.h"

namespace sgm::cli {

Command addClassify(CLI::App& root) {
  CLI::App* app = root.add_subcommand(
      "classify",
      "Classify a mesh file, or a region of a grammar, as a cave, a cloud, a building, terrain, trees or unknown");
  const auto options = std::make_shared<ClassifyOptions>();
  app->add_option("FILE", options->file, "A .glb, .gltf, .obj, .ply or .stl file in metres, or a .sgm grammar")
      ->required();
  app->add_flag("--json", options->json, "Print the result as one JSON object on standard output");
  app->add_option("--masters", options->masters,
                  "Database of reference histograms, from `sgm masters build`. Default: $XDG_DATA_HOME/sgm/masters.db "
                  "or ~/.local/share/sgm/masters.db if it exists, else the built-in reference histograms")
      ->type_name("FILE");
  app->add_option("--mode", options->mode,
                  "Histogram of dihedral angles: by curvature, for any density; or as printed in the paper, or "
                  "corrected, which need reference histograms of the same density")
      ->check(CLI::IsMember({"printed", "corrected", "curvature"}))
      ->capture_default_str();
  addSandboxed(*app, options->sandbox);
  addSandboxLimits(*app, options->sandbox);
  addDerivationOptions(*app, *options);
  addRegionOptions(*app, *options);
  addLevelOption(*app, *options);
  addSharpOption(*app, *options);
  app->footer(
      "The class is that of the nearest reference histogram by the mean squared error, as in the paper; with --mode\n"
      "curvature, by the error of the square roots of the shares, so that rare angles count beside the many flat\n"
      "edges. It is `unknown` if no reference histogram is near, or if one of noise is nearest. Edges that touch a\n"
      "border of the mesh do not count, because a region is cut off there. Without --region the command classifies\n"
      "all of a finite world, or one cell of the largest layer. --ld also gives the density of a mesh file, which\n"
      "--mode printed and corrected need. --seed to --sharp are for grammars. The exit status is 0 for `unknown`,\n"
      "too.\n"
      "Example:\n  sgm classify cave.glb --json\n  sgm classify samples/grammars/storeys.sgm");
  return [options](const Words& words) {
    options->sandbox.words = words;
    return classifyMesh(*options);
  };
}

Command addMasters(CLI::App& root) {
  CLI::App* group =
      root.add_subcommand("masters", "Make and list the reference histograms with which sgm classify compares");
  group->require_subcommand(1);
  CLI::App* build = group->add_subcommand(
      "build", "Generate models of each class from the sample grammars, and make reference histograms from them");
  const auto built = std::make_shared<MastersBuildOptions>();
  build
      ->add_option("--out", built->out,
                   "Database to write; its content is replaced. Default: the one that sgm classify reads")
      ->type_name("FILE");
  build
      ->add_option("--emit", built->emit,
                   "Write the reference histograms as C++ source, the form in which they are built in")
      ->type_name("FILE");
  build->add_option("--models", built->models, "Number of models of each grammar at each density")
      ->check(CLI::Range(uint64_t{2}, uint64_t{10000}))
      ->capture_default_str();
  build->add_option("--seed", built->seed, "Seed of the models: different seeds have no model in common")
      ->check(checkWhole)
      ->capture_default_str();
  build->add_option("--threads", built->threads, "Number of threads; 0: one for each processor")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  build->footer("Example:\n  sgm masters build --out masters.db --models 4");
  CLI::App* list = group->add_subcommand("list", "List the reference histograms");
  const auto listed = std::make_shared<MastersListOptions>();
  list->add_option("FILE", listed->file, "Database; default: the one that sgm classify reads");
  list->add_flag("--json", listed->json, "Print them, with their histograms, as one JSON object on standard output");
  list->footer("Example:\n  sgm masters list --json");
  group->footer("Example:\n  sgm masters list\n  sgm masters build --out masters.db");
  return [build, built, listed] { return build->parsed() ? buildMasters(*built) : listMasters(*listed); };
}

}  // namespace sgm::cli
