// The commands that bake worlds, and look after stores of them.

#include <fmt/core.h>

#include <memory>
#include <utility>
#include <vector>

#include "tools/cli/bake/commands.h"
#include "tools/sgm/arguments/shared.h"

namespace sgm::cli {
namespace {

void addStoreArgument(CLI::App& app, std::string& store) {
  app.add_option("STORE", store, "Folder of a store")->required();
}

Command addStoreVerify(CLI::App& group) {
  CLI::App* app = group.add_subcommand(
      "verify", "Read all of a store, and say whether it is whole; with a grammar, bake some chunks again and compare");
  const auto options = std::make_shared<StoreVerifyOptions>();
  addStoreArgument(*app, options->store);
  CLI::Option* file = app->add_option("FILE", options->file, "The grammar of one of its worlds: bake some of it again");
  app->add_option("--world", options->world, "Only the world whose name begins so")->excludes(file);
  app->add_flag("--json", options->json, "Print the result as one JSON object on standard output");
  const std::vector<CLI::Option*> plain = optionsBeside(*app, {});
  addDerivationOptions(*app, *options);
  addRegionOptions(*app, *options);
  app->remove_option(app->get_option("--max-chunks"));
  addSharpOption(*app, *options);
  app->add_option("--samples", options->samples, "Chunks to bake again")->check(checkWhole)->capture_default_str();
  app->add_option("--draw", options->draw, "Seed by which they are drawn")->check(checkWhole)->capture_default_str();
  for (CLI::Option* option : optionsBeside(*app, plain)) option->needs(file);
  app->footer(
      "Without a grammar: records, packs and contents by their checksums, and whether bodies of a level fit together\n"
      "at every face of two chunks. With one, parameters, seed, cells and --sharp must be those of the bake; a "
      "grammar\n"
      "of an endless world wants any --region. Exit status 1 where something is wrong.\n"
      "Example:\n  sgm store verify store samples/grammars/cave.sgm --region 0,0,0:1,1,1 --samples 50");
  return [options] { return storeVerify(*options); };
}

Command addStoreDiff(CLI::App& group) {
  CLI::App* app = group.add_subcommand("diff", "Say which chunks of a world are others in another bake");
  const auto options = std::make_shared<StoreDiffOptions>();
  app->add_option("STORE", options->store, "Folder of the store with the bake of before")->required();
  app->add_option("OTHER", options->other, "Folder of that with the other one; may be the same")->required();
  app->add_option("--from", options->from, "The world of before, by the beginning of its name")->type_name("WORLD");
  app->add_option("--to", options->to, "The other one, likewise")->type_name("WORLD");
  app->add_flag("--list", options->list, "Name each chunk: level, x, y, z");
  app->add_flag("--json", options->json, "Print the result as one JSON object on standard output");
  app->footer(
      "The bytes are those of contents that the bake of before does not have, wherever it has them.\n"
      "Example:\n  sgm store diff before after --list");
  return [options] { return storeDiff(*options); };
}

Command addStoreOf(CLI::App& group, const char* name, const char* what, Exit (*run)(const StoreOptions&),
                   bool by_world) {
  CLI::App* app = group.add_subcommand(name, what);
  const auto options = std::make_shared<StoreOptions>();
  addStoreArgument(*app, options->store);
  if (by_world) app->add_option("--world", options->world, "Only the world whose name begins so");
  app->add_flag("--json", options->json, "Print the result as one JSON object on standard output");
  app->footer(fmt::format("Example:\n  sgm store {} store", name));
  return [options, run] { return run(*options); };
}

}  // namespace

Command addBake(CLI::App& root) {
  CLI::App* app = root.add_subcommand(
      "bake", "Mesh a region at several levels ahead of time, into a store that worlds stream from");
  const auto options = std::make_shared<BakeOptions>();
  addWorldOptions(*app, *options);
  addRegionOptions(*app, *options);
  app->remove_option(app->get_option("--max-chunks"));
  addSharpOption(*app, *options);
  app->add_option("--levels", options->levels, "Levels of detail, the finest first")
      ->type_name("A..B")
      ->check(checkLevels)
      ->capture_default_str();
  app->add_option("--out", options->out, "Folder of the store: a new one, or one that holds other worlds already")
      ->type_name("STORE")
      ->required();
  CLI::Option* shard =
      app->add_option(
             "--shard", options->shard,
             "Bake only share I of N, counted from 0; shares take about as long as each other, and may be baked "
             "at one time, in any order, on machines that share the folder")
          ->type_name("I/N")
          ->check(checkShard);
  CLI::Option* merge = app->add_flag("--merge", options->merge, "Make a world of what all shares have baked");
  merge->excludes(shard);
  CLI::Option* slurm =
      app->add_option(
             "--slurm", options->slurm,
             "Bake in this many shares as an array of jobs of Slurm, then merge and verify; the nodes see the same "
             "folders. What is under way already is shown")
          ->check(CLI::Range(uint64_t{1}, uint64_t{100000}))
          ->excludes(shard)
          ->excludes(merge);
  app->add_option("--sbatch", options->sbatch, "Option for every job, such as --sbatch=--partition=long (repeatable)")
      ->allow_extra_args(false)
      ->needs(slurm);
  app->add_flag("--detach", options->detach, "Submit the jobs, and do not wait for them")->needs(slurm);
  app->footer(
      "What is baked follows from grammar, parameters, seed, cells, region and levels alone: the store's bytes are "
      "the\n"
      "same however the work was shared. A bake that was stopped goes on where it was when it is called again. Chunks\n"
      "that are the same are stored once, on whatever level and in whatever world of the store.\n"
      "Example:\n  sgm bake samples/grammars/cave.sgm --region 0,-16,0:256,48,256 --levels 0..3 --out store");
  return [options] { return bake(*options); };
}

Command addStore(CLI::App& root) {
  CLI::App* group = root.add_subcommand("store", "Stores of baked worlds: sgm store info, verify, diff, gc");
  group->require_subcommand(1);
  const std::vector<std::pair<const char*, Command>> commands{
      {"info", addStoreOf(*group, "info", "List the worlds of a store", storeInfo, true)},
      {"verify", addStoreVerify(*group)},
      {"diff", addStoreDiff(*group)},
      {"gc", addStoreOf(*group, "gc", "Remove files that no world of the store needs", storeClean, false)}};
  group->footer("sgm bake makes them.\nExample:\n  sgm store verify store");
  return [group, commands] {
    for (const auto& [name, command] : commands) {
      if (group->got_subcommand(name)) return command();
    }
    return Exit::usage;
  };
}

}  // namespace sgm::cli
