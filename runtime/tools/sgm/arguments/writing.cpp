// Declares the commands for authors of grammars: a language server and a preview window.

#include <memory>

#include "tools/cli/serve/commands.h"
#include "tools/preview/commands.h"
#include "tools/sgm/arguments/shared.h"
#include "tools/support/render_options.h"

namespace sgm::cli {

Command addLsp(CLI::App& root) {
  CLI::App* app = root.add_subcommand(
      "lsp", "Serve editors by the Language Server Protocol: diagnostics, completion, hover, definitions, formatting");
  app->add_flag("--stdio")->description("Use standard input and output, which is the default");
  app->footer(
      "Editors start this command; editor_plugin/vscode is an extension for VS Code.\n"
      "Example:\n  sgm lsp");
  return [] { return serveLanguage(); };
}

Command addPreview(CLI::App& root) {
  CLI::App* app = root.add_subcommand("preview", "Open a window that redraws a grammar whenever it is saved");
  const auto options = std::make_shared<RenderOptions>();
  options->size = "1280x800";
  addWorldOptions(*app, *options);
  addRegionOptions(*app, *options);
  addSharpOption(*app, *options);
  CLI::Option* camera =
      app->add_option("--camera", options->camera,
                      "Position and target of the camera in metres, x,y,z:x,y,z; default: an automatic view")
          ->type_name("VIEW")
          ->check(checkCamera);
  app->add_option("--at", options->at, "Look from an anchor of this name, kind or tag")
      ->type_name("ANCHOR")
      ->excludes(camera);
  app->add_option("--size", options->size, "Size of the window in pixels, WIDTHxHEIGHT")
      ->check(checkSize)
      ->capture_default_str();
  app->add_option("--fov", options->fov, "Vertical field of view in degrees")
      ->check(numberIn(1.0, 150.0))
      ->capture_default_str();
  addLightOption(*app, options->light);
  app->footer(
      "The window shows a draft with coarse cells and plain colours first, then the picture of `sgm render`. The\n"
      "panel has the seed, the light and a slider for each parameter. Messages about the text are at the bottom,\n"
      "and the last picture stays until the text is correct again. A change of an imported file in the grammar's\n"
      "folder redraws, too.\n"
      "Mouse: a drag turns, a right drag shifts, the wheel moves nearer; if the pointer rests, the window names the\n"
      "rule that made the place, and a click prints the rule with its line. Keys: W, A, S, D, Q, E walk; H returns\n"
      "to the first view; P prints the command that draws the picture; Escape closes the window.\n"
      "--json prints a line for each picture and message, for tools.\n" +
      std::string(kLightFooter) +
      "Example:\n  sgm preview samples/grammars/building.sgm\n"
      "  sgm preview samples/grammars/cave.sgm --at spawn --seed 7 --size 1600x900");
  return [options] { return showPreview(*options); };
}

}  // namespace sgm::cli
