// Declares the commands that benchmark this machine, and that compare the runtime with its paper.

#include <memory>

#include "tools/cli/bench/commands.h"
#include "tools/paper/commands.h"
#include "tools/sgm/arguments/shared.h"

namespace sgm::cli {
namespace {

Command addBenchChunks(CLI::App& group) {
  CLI::App* app = group.add_subcommand(
      "chunks", "Measure how fast the processor meshes a region of a grammar's world, with each instruction set");
  const auto options = std::make_shared<BenchChunksOptions>();
  addWorldOptions(*app, *options);
  addRegionOptions(*app, *options);
  addLevelOption(*app, *options);
  app->add_option("--runs", options->runs,
                  "Measured runs, after a first run that is not counted; the time is their median")
      ->check(CLI::Range(uint64_t{1}, uint64_t{1000}))
      ->capture_default_str();
  app->footer(
      "There is a row for one thread, and one for --threads. The exit status is 1 if two sets, or two numbers of\n"
      "threads, make different meshes.\n"
      "Example:\n  sgm bench chunks samples/grammars/cave.sgm --region 0,0,0:128,128,128");
  return [options] { return benchChunks(*options); };
}

Command addBenchPaper(CLI::App& group) {
  CLI::App* app = group.add_subcommand(
      "paper",
      "Measure tables 1 to 3 of the paper: speedup, efficiency and throughput for a cave, a cloud and a building");
  const auto options = std::make_shared<BenchOptions>();
  app->add_option("--runs", options->runs, "Measured runs, after one that warms up; the times are their median")
      ->check(CLI::Range(uint64_t{1}, uint64_t{1000}))
      ->capture_default_str();
  app->add_option("--backend", options->backends,
                  "Backend to measure beside the sequential CPU (repeatable). Default: all but software Vulkan, which "
                  "--backend vulkan measures")
      ->allow_extra_args(false)
      ->check(CLI::IsMember({"cpu", "vulkan", "cuda"}));
  app->add_option("--threads", options->threads,
                  "Number of threads of the parallel CPU backend; 0: one for each processor")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  CLI::Option* cell =
      app->add_option("--cell", options->cell, "Edge of a sampling cell in metres, in all stages")->type_name("METRES");
  app->add_option("--size", options->cells,
                  "Sampling cells along the edge of each stage's cube (64 m of cave, 1024 m of sky, 32 m of building)")
      ->type_name("CELLS")
      ->check(CLI::Range(uint64_t{8}, uint64_t{1024}))
      ->excludes(cell)
      ->capture_default_str();
  app->add_flag("--json", options->json, "Print the result as one JSON object on standard output");
  app->footer(
      "The exit status is 1 if two backends, or two runs, make different meshes.\n"
      "Example:\n  sgm bench paper --size 64 --runs 3");
  return [options] { return benchPaper(*options); };
}

}  // namespace

Command addBench(CLI::App& root) {
  CLI::App* group = root.add_subcommand("bench", "Measure this machine: sgm bench chunks, sgm bench paper");
  group->require_subcommand(1);
  const Command chunks = addBenchChunks(*group), paper = addBenchPaper(*group);
  group->footer("Example:\n  sgm bench paper --size 64 --runs 3");
  return [group, chunks, paper](const Words& words) {
    return group->got_subcommand("chunks") ? chunks(words) : paper(words);
  };
}

Command addPaper(CLI::App& root) {
  CLI::App* app = root.add_subcommand(
      "paper",
      "Reproduce the paper that the language comes from: an HTML report with its figures and tables beside ours");
  const auto options = std::make_shared<PaperOptions>();
  app->add_option("--out", options->out,
                  "Folder to write: a new or an empty one, or that of an earlier report without added or changed files")
      ->type_name("DIR")
      ->required();
  app->add_option("--only", options->only,
                  "Make only this part (repeatable): speedup, cloud, cave, architecture, density, objects, histograms, "
                  "time, comparison")
      ->type_name("PART")
      ->allow_extra_args(false)
      ->check(CLI::IsMember(paperParts()));
  app->add_flag("--quick", options->quick, "Use larger cells, fewer runs and models, smaller pictures");
  app->add_flag("--no-pictures", options->no_pictures,
                "Leave out the pictures, so that no Vulkan device is needed; charts and tables stay");
  app->add_option("--backend", options->backend, "Backend that computes")
      ->check(CLI::IsMember({"auto", "cpu", "vulkan", "cuda"}))
      ->capture_default_str();
  app->add_option("--threads", options->threads, "Number of threads; 0: one for each processor")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  app->add_option("--seed", options->seed, "Seed of the random choices: models to be classified, and skies")
      ->check(checkWhole)
      ->capture_default_str();
  app->add_flag("--json", options->json, "Print the report's numbers as one JSON object on standard output");
  app->footer(
      "The report takes a few minutes on two cores. Its folder appears when everything is done, or not at all.\n"
      "Pictures are drawn off-screen, on a Vulkan device, which may be software. The same options give the same\n"
      "report, except for times and values that depend on them.\n"
      "Example:\n  sgm paper --out paper --quick");
  return [options] { return reproducePaper(*options); };
}

}  // namespace sgm::cli
