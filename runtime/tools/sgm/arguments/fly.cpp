// Declares the command that streams a world along a path.

#include <memory>

#include "tools/cli/fly/commands.h"
#include "tools/sgm/arguments/serving_options.h"
#include "tools/sgm/arguments/shared.h"
#include "world/chunk_key.h"

namespace sgm::cli {

Command addFly(CLI::App& root) {
  CLI::App* app =
      root.add_subcommand("fly", "Stream a world along a path, frame by frame, and report how well it went");
  const auto options = std::make_shared<FlyOptions>();
  addWorldOptions(*app, *options);
  CLI::Option* cell =
      app->add_option("--cell", options->cell, "Edge of a level-0 cell in metres (0.5)")->type_name("METRES");
  app->add_option("--ld", options->density, "Cells per metre: the edge of a cell is 1/N m")
      ->type_name("N")
      ->excludes(cell);
  CLI::Option* path = app->add_option(
      "--path", options->path, "Path to follow, a JSON file in metres: {\"points\": [[x, y, z], ...], \"loop\": true}");
  app->add_flag_callback(
         "--auto", [] {}, "Find a path through the void of the world: the default without --path")
      ->excludes(path);
  app->add_option("--speed", options->speed, "Speed in metres per second")
      ->check(numberIn(0.0, 1000.0))
      ->capture_default_str();
  app->add_option("--frames", options->frames, "Number of frames of 1/60 s")
      ->check(CLI::Range(uint64_t{1}, uint64_t{100000000}))
      ->capture_default_str();
  app->add_option("--teleports", options->teleports, "Number of leaps to distant places, spread over the frames")
      ->check(checkWhole)
      ->excludes(path)
      ->capture_default_str();
  app->add_option("--edits", options->edits,
                  "Dig while flying, mostly holes of 4 m: N times per second of the path (1 without N). Without "
                  "--edits nothing is dug")
      ->type_name("N")
      ->expected(0, 1)
      ->default_str("1")
      ->check(numberIn(0.0, 60.0));
  CLI::Option* animate = app->add_option("--animate", options->animated,
                                         "Drive these parameters through their ranges and back within 10 s, in ten "
                                         "steps per second. Default: those that the grammar declares `animated`")
                             ->type_name("NAME")
                             ->expected(0, -1);
  app->add_flag("--check", options->check,
                "Check the surface of every frame for open and non-manifold edges by exact keys, and for triangles "
                "that are degenerate, flat, folded or cut each other; in each 500th frame also between chunks. The "
                "exit status is 1 if there are any");
  app->add_flag(
      "--measure", options->measure,
      "Measure every chunk as soon as it is meshed: defects, area, volume. The exit status is 1 if there are defects");
  app->add_flag("--unpaced", options->unpaced,
                "Run each frame as soon as there is something new to draw, instead of 60 frames per second");
  addSharpOption(*app, *options);
  CLI::Option* compare = app->add_flag("--compare", options->compare,
                                       "Fly a second time with level 0 chosen only by distance, to compare");
  app->add_option("--top-level", options->top_level, "Coarsest level of detail")
      ->check(CLI::Range(0, kMaxLevel))
      ->capture_default_str();
  app->add_option("--finest", options->finest, "Distance in metres within which everything visible should have level 0")
      ->check(numberIn(1.0, 10000.0))
      ->capture_default_str();
  app->add_option("--margin", options->finest_margin, "Margin in metres beyond that in which level 0 is meshed ahead")
      ->check(numberIn(0.0, 1000.0))
      ->capture_default_str();
  app->add_option("--view", options->view, "View distance in metres")
      ->check(numberIn(1.0, 100000.0))
      ->capture_default_str();
  app->add_option("--mesh-mb", options->mesh_mb, "Limit of the memory of meshes in megabytes (2^20 bytes)")
      ->check(CLI::Range(uint64_t{1}, uint64_t{1} << 20))
      ->capture_default_str();
  CLI::Option* png = app->add_option("--png", options->pictures,
                                     "Draw this many frames on one sheet. The first frame, and the first one after a "
                                     "leap, is drawn when the surroundings of the viewer are meshed")
                         ->check(CLI::Range(uint64_t{1}, uint64_t{64}));
  app->add_option("--out", options->out, "File of the sheet, a .png file")
      ->check(checkPng)
      ->needs(png)
      ->capture_default_str();
  app->add_flag("--levels", options->levels, "Draw each level of detail in a different colour")
      ->excludes(addLightOption(*app, options->light));
  app->add_option("--video", options->video,
                  "Draw every second frame into a video, an .mp4 file, with the program ffmpeg. The flight waits for "
                  "each picture, while the world continues to stream")
      ->check(checkVideo);
  app->add_option("--cache", options->cache, "Folder that keeps meshed chunks from one flight to the next")
      ->type_name("FOLDER");
  app->add_option("--store", options->stores,
                  "Store of baked worlds to stream from, a folder or an http:// or https:// address (repeatable); "
                  "missing chunks are derived")
      ->type_name("STORE")
      ->allow_extra_args(false);
  app->add_option("--journal", options->journal, "File that keeps the edits from one flight to the next")
      ->type_name("FILE")
      ->excludes(compare);
  addFlightServing(*app, *options);
  app->footer(
      std::string(kLightFooter) +
      "In a flight the light is tested once per second, and changes after two equal results.\n"
      "Example:\n  sgm fly samples/grammars/cave.sgm --cell 0.25 --speed 20 --frames 1200 --png 6 --out flight.png");
  return [options, animate] {
    options->animate = animate->count() > 0;
    std::erase(options->animated, "");  // an --animate without a name gives an empty name: remove it
    return fly(*options);
  };
}

}  // namespace sgm::cli
