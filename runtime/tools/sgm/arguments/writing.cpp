// The commands that stand beside an author: an editor's language server, and a window.

#include <memory>

#include "tools/cli/serve/commands.h"
#include "tools/preview/commands.h"
#include "tools/sgm/arguments/shared.h"
#include "tools/support/render_options.h"

namespace sgm::cli {

Command addLsp(CLI::App& root) {
  CLI::App* app = root.add_subcommand(
      "lsp", "Serve editors by the Language Server Protocol: diagnostics, completion, hover, definitions, formatting");
  app->add_flag("--stdio")->description("Standard input and output, which is what it serves anyway");
  app->footer("Editors start it; editor_plugin/vscode is one's extension.\nExample:\n  sgm lsp");
  return [] { return serveLanguage(); };
}

Command addPreview(CLI::App& root) {
  CLI::App* app = root.add_subcommand("preview", "Open a window that draws a grammar again whenever it is saved");
  const auto options = std::make_shared<RenderOptions>();
  options->size = "1280x800";
  addWorldOptions(*app, *options);
  addRegionOptions(*app, *options);
  addSharpOption(*app, *options);
  CLI::Option* camera =
      app->add_option("--camera", options->camera,
                      "From where to where to look in metres, x,y,z:x,y,z; without it, a view is chosen")
          ->type_name("VIEW")
          ->check(checkCamera);
  app->add_option("--at", options->at, "Look from an anchor of this name, kind or tag")
      ->type_name("ANCHOR")
      ->excludes(camera);
  app->add_option("--size", options->size, "Pixels of the window, WIDTHxHEIGHT")
      ->check(checkSize)
      ->capture_default_str();
  app->add_option("--fov", options->fov, "Angle across the picture's height, in degrees")
      ->check(numberIn(1.0, 150.0))
      ->capture_default_str();
  addLightOption(*app, options->light);
  app->footer(
      "A draft with coarse cells and plain colours comes first, then the picture as `sgm render` draws it. The panel\n"
      "has the seed, the light and a slider for each parameter; messages about the text stand at the foot, and the\n"
      "last picture stays until the text is right again. The imported files of the grammar's folder count as it does.\n"
      "Mouse: a drag turns, a right drag shifts, the wheel comes nearer; where the pointer rests, the rule that made\n"
      "the place is shown, and a click prints it with its line. Keys: W, A, S, D, Q, E walk; H goes back to the first\n"
      "view; P prints the command that draws the picture; Escape closes the window.\n"
      "--json prints a line for each picture and message, for tools.\n" +
      std::string(kLightFooter) +
      "Example:\n  sgm preview samples/grammars/building.sgm\n"
      "  sgm preview samples/grammars/cave.sgm --at spawn --seed 7 --size 1600x900");
  return [options] { return showPreview(*options); };
}

}  // namespace sgm::cli
