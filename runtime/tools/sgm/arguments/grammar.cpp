// Declares the commands that work on a grammar, or on a region of its world.

#include "tools/cli/grammar/commands.h"
#include "tools/cli/picture/commands.h"
#include "tools/sgm/arguments/shared.h"
#include "tools/support/render_options.h"

#include <memory>

namespace sgm::cli {
namespace {

constexpr const char* kCheckFooter =
    "Example:\n"
    "  sgm check samples/grammars/cave.sgm\n"
    "  sgm check --expect samples/grammars/sphere.sgm --seeds 3\n"
    "\n"
    "With --expect, every report and every expect that holds prints a line. An expect that fails is an error with\n"
    "its place and the measured value, and the exit status is 1. Measures:\n"
    "  watertight  the surface is a manifold, open only in the region's outer border, where the solid is cut\n"
    "  components  connected pieces of the solid, or with (air) of the void, inside the region; (solid above 1m3)\n"
    "              counts only larger ones\n"
    "  volume      m3 of the solid, by the divergence theorem; --json also has that of equation 8\n"
    "  area        m2 of the surface (equation 7), without the faces where the border cuts the solid\n"
    "  triangles   of that surface\n"
    "  genus       handles, summed over closed surfaces; not measured, and so failed, if the border cuts one\n"
    "  anchors     inside the region\n"
    "Regions: `in block(n)` is n cells, from cell 0 on, of the layer with the largest cells, on each axis that is\n"
    "cut into cells; on other axes it is the reach of the layers. The default is --region, else all of a finite\n"
    "world, else block(1). Regions grow to whole chunks of 32 cells. `per Rule` measures separately each use of\n"
    "the rule whose frame is in the region, as solid in an empty world, without the statements around the call (a\n"
    "cut, a displacement, a smooth union). Cells are 0.5 m, doubled until the region, or all uses of the rule\n"
    "together, have at most --max-chunks chunks; --cell and --ld override this.";

}  // namespace

Command addCheck(CLI::App& root) {
  CLI::App* app = root.add_subcommand(
      "check", "Check grammars and report errors with line and column; with --expect, evaluate report and expect");
  const auto options = std::make_shared<CheckOptions>();
  app->add_option("FILE", options->files, "Grammars, .sgm files")->required();
  app->add_flag("--json", options->json, "Print messages, parameters and layers as JSON on standard output");
  CLI::Option* expect =
      app->add_flag("--expect", options->expect, "Derive and mesh the regions of the report and expect statements");
  const std::vector<CLI::Option*> plain = optionsBeside(*app, {});
  addDerivationOptions(*app, *options);
  addRegionOptions(*app, *options);
  app->add_option("--seeds", options->seeds, "Number of seeds to evaluate, from --seed on; the failing ones are named")
      ->check(CLI::Range(uint64_t{1}, uint64_t{1000000}))
      ->capture_default_str();
  for (CLI::Option* option : optionsBeside(*app, plain)) option->needs(expect);
  app->footer(kCheckFooter);
  return [options] { return check(*options); };
}

Command addFmt(CLI::App& root) {
  CLI::App* app = root.add_subcommand("fmt", "Print grammars in their canonical layout, or rewrite them in it");
  const auto options = std::make_shared<FmtOptions>();
  app->add_option("FILE", options->files, "Grammars, .sgm files")->required();
  CLI::Option* write = app->add_flag("--write", options->write, "Change the files in place");
  app->add_flag("--check", options->check, "Change nothing; the exit status is 1 if a file is not in canonical layout")
      ->excludes(write);
  app->footer("Example:\n  sgm fmt --write samples/grammars/cave.sgm");
  return [options] { return format(*options); };
}

Command addExplain(CLI::App& root) {
  CLI::App* app = root.add_subcommand("explain", "Name the rules that made a place solid, or left it open");
  const auto options = std::make_shared<ExplainOptions>();
  addWorldOptions(*app, *options);
  app->add_option("--at", options->at, "The place in metres, x,y,z")->type_name("POINT")->required()->check(checkPoint);
  app->add_option("--cell", options->cell, "Edge of a sampling cell in metres (0.5): finer `detail` is left out")
      ->type_name("METRES");
  app->footer(
      "The printed paths are those that `override` takes and messages print.\n"
      "Example:\n  sgm explain samples/grammars/building.sgm --at 0,-10,6");
  return [options] { return explain(*options); };
}

Command addMesh(CLI::App& root) {
  CLI::App* app = root.add_subcommand("mesh", "Mesh a region and write it as .glb, .obj, .ply or .stl");
  const auto options = std::make_shared<MeshOptions>();
  addWorldOptions(*app, *options);
  addRegionOptions(*app, *options);
  addLevelOption(*app, *options);
  addSharpOption(*app, *options);
  app->add_option("--out", options->out,
                  "Mesh file to write; its extension chooses .glb, .obj (with its materials in a .mtl file of the same "
                  "name), .ply or .stl. Without it the mesh is only measured")
      ->check(checkMeshFile);
  app->add_flag("--uv", options->uv,
                "Write texture coordinates into .glb and .obj, and report how uniform they are. Tiles of 1 m follow "
                "the axes of the shapes: along and around a passage. A .glb also gets a checkerboard texture, and "
                "colours that blend where materials meet");
  app->footer(
      "Positions in the file are metres from the world's origin. If the region reaches further than 4096 m from it,\n"
      "they count from the region's lowest corner instead, which is then printed as the origin.\n"
      "Example:\n  sgm mesh samples/grammars/cave.sgm --out cave.glb --region 0,-8,0:192,16,192 --cell 0.5 --seed 7");
  return [options] { return mesh(*options); };
}

namespace {

constexpr const char* kSurveySize = "1600x1200";

bool isSurvey(const RenderOptions& options) { return options.plan || options.section; }

/// Adds the options with which `render` draws a survey (plan or section) instead of a picture.
void addSurveyOptions(CLI::App& app, RenderOptions& options) {
  CLI::Option* plan = app.add_flag("--plan", options.plan,
                                   "Draw the plan of a survey instead: the void of a solid world, else the solids, "
                                   "from above, with walls, contours, water, dripstone and a scale bar");
  CLI::Option* section =
      app.add_option_function<std::string>(
             "--section", [&options](const std::string& line) { options.section = line; },
             "Draw a long section instead, along the longer axis of the region where it cuts the most, or along the "
             "given line in plan view, in metres; with --plan, both are on one sheet")
          ->type_name("X,Z:X,Z")
          ->expected(0, 1)
          ->default_str("")
          ->check(checkCutLine);
  for (const char* other :
       {"--camera", "--frame", "--seeds", "--fov", "--light", "--pixels", "--uv", "--volume", "--wires", "--sharp"})
    for (CLI::Option* survey : {plan, section}) survey->excludes(app.get_option(other));
}

/// Adds the options that choose a use of a rule to show, or several seeds.
void addChoiceOptions(CLI::App& app, RenderOptions& options) {
  app.add_option("--frame", options.frame,
                 "Show a use of this rule over two thirds of the picture, from the best point of view: Drip, "
                 "cave.Dripstone, or a path such as Row/Post[2]. Without --region, the use nearest to the origin")
      ->type_name("RULE")
      ->excludes(app.get_option("--camera"))
      ->excludes(app.get_option("--at"));
  CLI::Option* seeds =
      app.add_option("--seeds", options.seeds, "With --sheet: one picture for each of these seeds, 1..9 or 3,7,11")
          ->type_name("SEEDS")
          ->excludes(app.get_option("--seed"))
          ->check(checkSeeds);
  CLI::Option* sheet =
      app.add_flag("--sheet")
          ->description("Put all pictures on one sheet of about --size, each with its seed in a corner")
          ->needs(seeds);
  seeds->needs(sheet);
}

}  // namespace

Command addRender(CLI::App& root) {
  CLI::App* app = root.add_subcommand("render", "Draw a picture of a region, off-screen");
  const auto options = std::make_shared<RenderOptions>();
  addWorldOptions(*app, *options);
  addRegionOptions(*app, *options);
  addLevelOption(*app, *options);
  addSharpOption(*app, *options);
  app->add_option("--out", options->out, "Picture to write, a .png file; for --plan and --section also .svg")
      ->required()
      ->check(checkPicture);
  app->add_flag("--uv", options->uv,
                "Show texture coordinates: a checkerboard of half a metre, with red lines of u and green lines of v at "
                "whole metres");
  CLI::Option* camera =
      app->add_option("--camera", options->camera,
                      "Position and target of the camera in metres, x,y,z:x,y,z; default: an automatic view")
          ->type_name("VIEW")
          ->check(checkCamera);
  app->add_option("--at", options->at, "Look from an anchor of this name, kind or tag; a plan is centred on it")
      ->type_name("ANCHOR")
      ->excludes(camera);
  const CLI::Option* size =
      app->add_option("--size", options->size, "Pixels, WIDTHxHEIGHT; 1600x1200 for --plan and --section")
          ->check(checkSize)
          ->capture_default_str();
  app->add_option("--fov", options->fov, "Vertical field of view in degrees")
      ->check(numberIn(1.0, 150.0))
      ->capture_default_str();
  CLI::Option* pixels = app->add_option("--pixels", options->pixels,
                                        "Let no cell be wider than this many pixels: cells are smaller near the "
                                        "camera, down to 1 cm, and those of --cell far away")
                            ->type_name("N")
                            ->check(numberIn(0.25, 1000.0));
  CLI::Option* light = addLightOption(*app, options->light);
  app->add_flag("--volume", options->volume,
                "Draw the solid as fog, by its density at the corners of the cells; for grammars with `output density`")
      ->excludes(light)
      ->excludes(pixels)
      ->excludes(app->add_flag("--wires", options->wires, "Draw the mesh's edges, on a surface without materials"));
  addChoiceOptions(*app, *options);
  addSurveyOptions(*app, *options);
  app->footer(std::string(kLightFooter) +
              "Example:\n  sgm render samples/grammars/cave.sgm --out cave.png --at spawn --seed 7\n"
              "  sgm render samples/grammars/cave.sgm --out sheet.png --seeds 1..9 --sheet\n"
              "  sgm render samples/grammars/lake.sgm --out plan.svg --plan --section --seed 3\n"
              "  sgm render samples/grammars/lake.sgm --out drip.png --frame karst.Dripstone");
  return [options, size] {
    if (!isSurvey(*options)) return render(*options);
    if (size->count() == 0) options->size = kSurveySize;
    return render(*options);
  };
}

}  // namespace sgm::cli
