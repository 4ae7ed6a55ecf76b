// The commands that measure this machine, and compare the runtime with its paper.

#include <memory>

#include "tools/cli/bench/commands.h"
#include "tools/paper/commands.h"
#include "tools/sgm/arguments/shared.h"

namespace sgm::cli {
namespace {

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

}  // namespace

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

}  // namespace sgm::cli
