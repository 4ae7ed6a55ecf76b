// The commands that classify meshes, and make the reference histograms for it.

#include <memory>

#include "tools/cli/classify/commands.h"
#include "tools/sgm/arguments/shared.h"

namespace sgm::cli {

Command addClassify(CLI::App& root) {
  CLI::App* app = root.add_subcommand(
      "classify",
      "Say whether a mesh file, or a region of a grammar, is a cave, a cloud, a building, terrain, trees or unknown");
  const auto options = std::make_shared<ClassifyOptions>();
  app->add_option("FILE", options->file, "A .glb, .gltf, .obj, .ply or .stl file in metres, or a .sgm grammar")
      ->required();
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
      "The class of the nearest master by the mean squared error, as in the paper; with --mode curvature by that of\n"
      "the shares' square roots, so that rare bends count beside the many flat edges. `unknown` where no master is\n"
      "near, or one of noise is nearest. Edges that touch a border of the mesh do not count: there a region is cut "
      "off.\n"
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
      "build", "Generate models of each class from the sample grammars, and make masters of them");
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

}  // namespace sgm::cli
