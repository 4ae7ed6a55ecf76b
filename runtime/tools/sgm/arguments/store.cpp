// Declares the commands that bake worlds into stores, and that maintain these stores.

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
      "verify", "Read all of a store and test that it is complete; with a grammar, bake some chunks again and compare");
  const auto options = std::make_shared<StoreVerifyOptions>();
  addStoreArgument(*app, options->store);
  CLI::Option* file =
      app->add_option("FILE", options->file, "The grammar of one of its worlds, to bake some chunks again");
  app->add_option("--world", options->world, "Only the world whose name begins with this")->excludes(file);
  app->add_flag("--json", options->json, "Print the result as one JSON object on standard output");
  const std::vector<CLI::Option*> plain = optionsBeside(*app, {});
  addDerivationOptions(*app, *options);
  addRegionOptions(*app, *options);
  app->remove_option(app->get_option("--max-chunks"));
  addSharpOption(*app, *options);
  app->add_option("--samples", options->samples, "Number of chunks to bake again")
      ->check(checkWhole)
      ->capture_default_str();
  app->add_option("--draw", options->draw, "Seed of the choice of these chunks")
      ->check(checkWhole)
      ->capture_default_str();
  for (CLI::Option* option : optionsBeside(*app, plain)) option->needs(file);
  app->footer(
      "Without a grammar, the command tests the checksums of records, packs and contents, and whether the bodies of\n"
      "a level fit together at every face between two chunks. With a grammar, parameters, seed, cells and --sharp\n"
      "must be those of the bake; the grammar of an endless world needs any --region. The exit status is 1 if there\n"
      "is a problem.\n"
      "Example:\n  sgm store verify store samples/grammars/cave.sgm --region 0,0,0:1,1,1 --samples 50");
  return [options] { return storeVerify(*options); };
}

Command addStoreDiff(CLI::App& group) {
  CLI::App* app = group.add_subcommand("diff", "List the chunks of a world that differ in another bake");
  const auto options = std::make_shared<StoreDiffOptions>();
  app->add_option("STORE", options->store, "Folder of the store with the previous bake")->required();
  app->add_option("OTHER", options->other, "Folder of the store with the other bake; may be the same")->required();
  app->add_option("--from", options->from, "The previous world, by the beginning of its name")->type_name("WORLD");
  app->add_option("--to", options->to, "The other world, by the beginning of its name")->type_name("WORLD");
  app->add_flag("--list", options->list, "Name each chunk: level, x, y, z");
  app->add_flag("--json", options->json, "Print the result as one JSON object on standard output");
  app->footer(
      "The printed bytes are those of contents that occur nowhere in the previous bake.\n"
      "Example:\n  sgm store diff before after --list");
  return [options] { return storeDiff(*options); };
}

Command addStoreOf(CLI::App& group, const char* name, const char* what, Exit (*run)(const StoreOptions&),
                   bool by_world) {
  CLI::App* app = group.add_subcommand(name, what);
  const auto options = std::make_shared<StoreOptions>();
  addStoreArgument(*app, options->store);
  if (by_world) app->add_option("--world", options->world, "Only the world whose name begins with this");
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
  app->add_option("--levels", options->levels, "Levels of detail, finest first")
      ->type_name("A..B")
      ->check(checkLevels)
      ->capture_default_str();
  app->add_option("--out", options->out, "Folder of the store: a new one, or one that holds other worlds already")
      ->type_name("STORE")
      ->required();
  CLI::Option* shard = app->add_option("--shard", options->shard,
                                       "Bake only share I of N, counted from 0; all shares take about the same time, "
                                       "and may be baked concurrently, in any order, on machines that share the folder")
                           ->type_name("I/N")
                           ->check(checkShard);
  CLI::Option* merge = app->add_flag("--merge", options->merge, "Merge the shares into a world");
  merge->excludes(shard);
  CLI::Option* slurm =
      app->add_option("--slurm", options->slurm,
                      "Bake in this many shares with an array of Slurm jobs, then merge and verify; the nodes must "
                      "share the folders. If the jobs are already under way, their state is shown")
          ->check(CLI::Range(uint64_t{1}, uint64_t{100000}))
          ->excludes(shard)
          ->excludes(merge);
  app->add_option("--sbatch", options->sbatch,
                  "Option of sbatch for every job, such as --sbatch=--partition=long (repeatable)")
      ->allow_extra_args(false)
      ->needs(slurm);
  app->add_flag("--detach", options->detach, "Submit the jobs, and do not wait for them")->needs(slurm);
  app->footer(
      "The bake depends only on grammar, parameters, seed, cells, region and levels: the bytes of the store are the\n"
      "same however the work was shared. A bake that was stopped continues where it was when it is called again.\n"
      "Equal chunks are stored once, across all levels and worlds of the store.\n"
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
  group->footer(
      "sgm bake makes stores.\n"
      "Example:\n  sgm store verify store");
  return [group, commands](const Words& words) {
    for (const auto& [name, command] : commands) {
      if (group->got_subcommand(name)) return command(words);
    }
    return Exit::usage;
  };
}

}  // namespace sgm::cli
