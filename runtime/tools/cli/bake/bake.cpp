// `sgm bake`: meshes a region of a world at several levels of detail ahead of time, into a store from which worlds
// stream.

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>

#include "base/json.h"
#include "chunk/chunk_codec.h"
#include "sgm/sgm.h"
#include "store/merge.h"
#include "store/plan.h"
#include "tools/cli/bake/bake_slurm.h"
#include "tools/cli/bake/commands.h"
#include "tools/cli/bake/store_turn.h"
#include "tools/support/console.h"
#include "tools/support/ending_signals.h"
#include "tools/support/region.h"
#include "tools/support/source.h"

namespace sgm::cli {
namespace {

namespace fs = std::filesystem;

struct Report {
  /// Numbers of tiles (cubes of 8 x 8 x 8 chunks) in this shard: total, baked by this call, and baked by an earlier
  /// call.
  size_t tiles = 0, made = 0, made_before = 0;
  std::optional<store::Merged> merged;
  uint64_t index_bytes = 0;
  bool there_before = false;
  double seconds = 0;
};

double perTriangle(uint64_t bytes, uint64_t triangles) {
  return triangles == 0 ? 0 : static_cast<double>(bytes) / static_cast<double>(triangles);
}

Json manifestOf(const BakeOptions& options, const OpenedWorld& world, const std::string& text,
                const store::BakedRegion& region, const store::WorldSummary& baked) {
  Json parameters = Json::object();
  for (size_t i = 0; i < world.program->params.size(); ++i)
    parameters[world.program->text(world.program->params[i].name)] = world.settings.parameters.values[i];
  const measure::SurfaceSums& sums = baked.measured;
  Json defects = Json::object();
  for (size_t i = 0; i < measure::kDefects; ++i)
    defects[measure::defectName(static_cast<measure::Defect>(i))] = sums.defects[i];
  return {{"format", store::kStoreVersion},
          {"library", sgm_version_string()},
          {"meshing", kMeshingVersion},
          {"codec", kChunkCodecVersion},
          {"grammar", {{"file", fs::path(options.file).filename().string()}, {"text", text}}},
          {"parameters", parameters},
          {"seed", world.settings.seed},
          {"cell_units", world.settings.finest_cell},
          {"sharp", options.sharp},
          {"region", {metresJson(region.box.lo), metresJson(region.box.hi)}},
          {"levels", {region.first_level, region.last_level}},
          {"tiles", baked.tiles},
          {"chunks", baked.chunks},
          {"triangles", sums.triangles},
          {"area", sums.area},
          {"defects", defects}};
}

void print(const BakeOptions& options, const Report& report, const std::string& world) {
  if (options.json) {
    Json json = {{"world", world},
                 {"tiles", report.tiles},
                 {"made", report.made},
                 {"made_before", report.made_before},
                 {"there_before", report.there_before},
                 {"seconds", report.seconds}};
    if (report.merged) {
      const store::WorldSummary& baked = report.merged->world;
      json.update({{"chunks", baked.chunks},
                   {"contents", baked.contents},
                   {"triangles", baked.measured.triangles},
                   {"packs", baked.packs},
                   {"pack_bytes", baked.pack_bytes},
                   {"new_bytes", report.merged->new_bytes},
                   {"index_bytes", report.index_bytes},
                   {"bytes_per_triangle", perTriangle(baked.pack_bytes + report.index_bytes, baked.measured.triangles)},
                   {"sound", baked.measured.sound()}});
    }
    fmt::print("{}\n", json.text());
    return;
  }
  if (report.there_before) {
    fmt::print("{}: already baked (world {})\n", options.out, world);
    return;
  }
  fmt::print("{}: {} tiles, {} of them baked before, {:.1f} s\n", options.out, report.tiles, report.made_before,
             report.seconds);
  if (!report.merged) {
    fmt::print("  The world is not in the store yet: when all shards are done, run sgm bake --merge\n");
    return;
  }
  const store::WorldSummary& baked = report.merged->world;
  const uint64_t bytes = baked.pack_bytes + report.index_bytes;
  fmt::print("  world    {}\n", world);
  fmt::print("  chunks   {}, {} triangles; {} different contents\n", baked.chunks, baked.measured.triangles,
             baked.contents);
  fmt::print(
      "  files    {} packs of {:.1f} MB ({:.1f} MB of them new), an index of {:.2f} MB, {:.2f} bytes per triangle\n",
      baked.packs, static_cast<double>(baked.pack_bytes) / 1e6, static_cast<double>(report.merged->new_bytes) / 1e6,
      static_cast<double>(report.index_bytes) / 1e6, perTriangle(bytes, baked.measured.triangles));
  fmt::print("  measured {:.1f} m2 on all levels, {}\n", baked.measured.area,
             baked.measured.sound() ? "no defects" : "with defects: the manifest lists them");
}

/// Bakes the tiles with indices from `first` up to, but not including, `last`. Skips tiles that an earlier call has
/// baked.
Result<Report> bakeTiles(const store::Bakery& bakery, const std::vector<store::TileKey>& tiles,
                         const std::vector<uint64_t>& costs, size_t first, size_t last) {
  Report report;
  report.tiles = last - first;
  uint64_t all = 0, done = 0;
  for (size_t i = first; i < last; ++i) all += costs[i] + 1;
  ProgressBar bar("baking");
  const auto show = [&](uint64_t cost) { bar.show(1000 * (done + cost) / std::max<uint64_t>(all, 1), 1000); };
  for (size_t i = first; i < last; ++i) {
    if (store::madeBefore(bakery, tiles[i])) {
      ++report.made_before;
    } else {
      const Result<store::TileRecord> record = store::bakeTile(bakery, tiles[i], [&](uint64_t chunks, uint64_t of) {
        show((costs[i] + 1) * chunks / (of + 1));
        return true;
      });
      if (!record) return record.error();
      ++report.made;
    }
    done += costs[i] + 1;
    show(0);
  }
  return report;
}

}  // namespace

Exit bake(const BakeOptions& options) {
  const Stopwatch watch;
  if (const Result<void> can = store::available(); !can) return reportError(can.error());
  const std::optional<std::pair<int, int>> levels = readLevels(options.levels);
  const std::optional<std::pair<uint64_t, uint64_t>> shard = readShard(options.shard.empty() ? "0/1" : options.shard);
  const OpenedWorld opened = openWorld(options);
  if (opened.program == nullptr) return opened.status;
  const Result<std::string> text = readGrammarText(options.file);
  if (!text) return reportError(text.error());
  const store::BakedRegion region{opened.region, levels->first, levels->second, opened.settings.finest_cell};
  if (const Result<void> good = store::check(region); !good) return reportError(good.error());

  const Result<std::unique_ptr<JobSystem>> jobs = makeThreadPool(options.threads);
  if (!jobs) return reportError(jobs.error());
  const Result<std::unique_ptr<Backend>> backend = backendOf(options, **jobs);
  if (!backend) return reportError(backend.error());
  if (!(*backend)->capabilities().exact) return reportError(Exit::backend, kNotExact);
  const WorldField world(opened.settings, std::pmr::new_delete_resource());
  if (const Result<void> here = store::checkHere(options.out); !here) return reportError(here.error());
  const store::Folder folder(options.out);
  Result<store::Bakery> bakery =
      store::bakeryOf(world, **backend, **jobs, region, options.sharp, folder, std::pmr::new_delete_resource());
  if (!bakery) return reportError(bakery.error());
  bakery->unfinished = &unfinished_files;
  if (const Result<void> made = options.merge ? folder.check() : folder.make(); !made) return reportError(made.error());
  Report report;
  const auto finish = [&] {
    report.seconds = watch.seconds();
    print(options, report, store::nameOf(bakery->key));
    return Exit::done;
  };
  const auto isThere = [&]() -> Result<bool> {
    const Result<bool> baked = store::isBaked(folder, *bakery);
    report.there_before = baked && *baked;
    return baked;
  };
  if (const Result<bool> there = isThere(); !there || *there) return there ? finish() : reportError(there.error());

  if (!options.merge) {
    if (const Result<void> made = store::makeFolder(bakery->folder); !made) return reportError(made.error());
    const std::vector<store::TileKey> tiles = store::tilesOf(region);
    const Result<std::vector<uint64_t>> costs = [&] {
      ProgressBar bar("planning");
      return store::planOf(*bakery, tiles, [&](uint64_t done, uint64_t total) {
        bar.show(done, total);
        return true;
      });
    }();
    if (!costs) return reportError(costs.error());
    if (options.slurm != 0) return bakeBySlurm(options, store::nameOf(bakery->job), isThere);
    const auto [first, last] = store::tilesOfShard(*costs, shard->first, shard->second);
    const Result<Report> baked = bakeTiles(*bakery, tiles, *costs, first, last);
    if (!baked) {
      // It is not an error if another process has meanwhile baked and merged the same tiles.
      const Result<bool> there = isThere();
      return there && *there ? finish() : reportError(baked.error());
    }
    report = *baked;
    if (!options.shard.empty()) return finish();
  }
  const store::Manifest manifest = [&](const store::WorldSummary& baked) {
    return manifestOf(options, opened, *text, region, baked).text() + "\n";
  };
  const Result<store::Merged> merged = inTurn(folder, [&](auto patience) {
    ProgressBar bar("merging");
    const auto progress = [&](uint64_t done, uint64_t total) {
      bar.show(done, total);
      return true;
    };
    return store::merge(folder, *bakery, manifest, progress, patience);
  });
  if (!merged) return reportError(merged.error());
  for (const std::string& warning : merged->warnings) fmt::print(stderr, "sgm: warning: {}\n", warning);
  report.there_before = merged->there_before;
  report.merged = *merged;
  report.tiles = merged->world.tiles;
  std::error_code error;
  report.index_bytes = fs::file_size(folder.world(bakery->key), error);
  return finish();
}

}  // namespace sgm::cli
