// The command that streams a world.

#include <memory>

#include "tools/cli/fly/commands.h"
#include "tools/sgm/arguments/serving_options.h"
#include "tools/sgm/arguments/shared.h"
#include "world/chunk_key.h"

namespace sgm::cli {

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
      "Check every frame's surface for open and non-manifold edges by exact keys, and for triangles that are "
      "degenerate, flat, fold or cut; each 500th frame whole, between chunks too. Status 1 where there are any");
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
  CLI::Option* png =
      app->add_option("--png", options->pictures,
                      "Draw this many frames on one sheet. The first one, and the first one after a leap, is drawn "
                      "once what is near the viewer is there")
          ->check(CLI::Range(uint64_t{1}, uint64_t{64}));
  app->add_option("--out", options->out, "The sheet, a .png file")->check(checkPng)->needs(png)->capture_default_str();
  app->add_flag("--levels", options->levels, "Each level of detail in a colour of its own, in pictures")
      ->excludes(addLightOption(*app, options->light));
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
  addFlightServing(*app, *options);
  app->footer(
      std::string(kLightFooter) +
      "In a flight the camera looks once a second, and two looks must agree on another light.\n"
      "Example:\n  sgm fly samples/grammars/cave.sgm --cell 0.25 --speed 20 --frames 1200 --png 6 --out flight.png");
  return [options, animate] {
    options->animate = animate->count() > 0;
    std::erase(options->animated, "");  // what stands for no name
    return fly(*options);
  };
}

}  // namespace sgm::cli
