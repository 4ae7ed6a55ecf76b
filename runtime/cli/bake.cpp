// sgm bake: a region of a world at some levels, meshed ahead of time into a store that worlds stream from.

#include <fmt/core.h>

#include <charconv>
#include <filesystem>

#include "cli/bake_slurm.h"
#include "cli/commands.h"
#include "cli/json.h"
#include "cli/region.h"
#include "cli/source.h"
#include "sgm/sgm.h"
#include "store/merge.h"
#include "store/plan.h"
#include "store/verify.h"
#include "store/world_file.h"
#include "stream/chunk_codec.h"

namespace sgm::cli {
namespace {

namespace fs = std::filesystem;

struct Report {
  size_t tiles = 0, made = 0, made_before = 0;  ///< of this shard
  std::optional<store::Merged> merged;
  bool there_before = false;
  double seconds = 0;
};

double perTriangle(uint64_t bytes, uint64_t triangles) {
  return triangles == 0 ? 0 : static_cast<double>(bytes) / static_cast<double>(triangles);
}

Json manifestOf(const BakeOptions& options, const OpenedWorld& world, const std::string& text,
                const store::BakedRegion& region, const store::Merged& merged) {
  Json parameters = Json::object();
  for (size_t i = 0; i < world.program->params.size(); ++i)
    parameters[world.program->text(world.program->params[i].name)] = world.settings.parameters.values[i];
  const measure::SurfaceSums& sums = merged.measured;
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
          {"tiles", merged.tiles},
          {"chunks", merged.chunks},
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
      const store::Merged& m = *report.merged;
      json.update({{"chunks", m.chunks},
                   {"contents", m.contents},
                   {"triangles", m.measured.triangles},
                   {"packs", m.packs},
                   {"pack_bytes", m.pack_bytes},
                   {"index_bytes", m.index_bytes},
                   {"bytes_per_triangle", perTriangle(m.pack_bytes + m.index_bytes, m.measured.triangles)},
                   {"sound", m.measured.sound()}});
    }
    fmt::print("{}\n", json.text());
    return;
  }
  if (report.there_before) {
    fmt::print("{}: is baked already (world {})\n", options.out, world);
    return;
  }
  fmt::print("{}: {} tiles, {} of them made before, {:.1f} s\n", options.out, report.tiles, report.made_before,
             report.seconds);
  if (!report.merged) {
    fmt::print("  The world is in the store when all shards are done: then sgm bake --merge\n");
    return;
  }
  const store::Merged& m = *report.merged;
  fmt::print("  world    {}\n", world);
  fmt::print("  chunks   {}, {} triangles; {} contents that differ\n", m.chunks, m.measured.triangles, m.contents);
  fmt::print("  files    {:.1f} MB of {} packs have come, an index of {:.2f} MB: {:.2f} bytes a triangle\n",
             static_cast<double>(m.pack_bytes) / 1e6, m.packs, static_cast<double>(m.index_bytes) / 1e6,
             perTriangle(m.pack_bytes + m.index_bytes, m.measured.triangles));
  fmt::print("  measured {:.1f} m2 on all levels, {}\n", m.measured.area,
             m.measured.sound() ? "no defect" : "with defects: see the manifest");
}

/// Whether just this is in the store already, whole as far as sizes tell.
bool isThere(const store::Folder& folder, const store::ContentId& key, const store::BakedRegion& region) {
  std::error_code error;
  if (!fs::exists(folder.manifest(key), error)) return false;
  const Result<store::WorldFile> world = store::WorldFile::open(folder.world(key));
  if (!world || store::jobKey(key, world->index.region) != store::jobKey(key, region)) return false;
  const Result<bool> packs = store::hasPacks(folder, *world);
  return packs && *packs;
}

/// Bakes the tiles; those that are done already count as done.
Result<Report> bakeTiles(const store::Bakery& bakery, const std::vector<store::TileKey>& tiles,
                         const std::vector<uint64_t>& costs, size_t first, size_t last) {
  Report report;
  report.tiles = last - first;
  uint64_t all = 0, done = 0;
  for (size_t i = first; i < last; ++i) all += costs[i] + 1;
  ProgressBar bar("baking");
  for (size_t i = first; i < last; ++i) {
    if (store::madeBefore(bakery, tiles[i])) {
      ++report.made_before;
    } else {
      const Result<store::TileRecord> record = store::bakeTile(bakery, tiles[i], [&](uint64_t chunks, uint64_t of) {
        bar.show(done + (costs[i] + 1) * chunks / (of + 1), all);
        return true;
      });
      if (!record) return record.error();
      ++report.made;
    }
    done += costs[i] + 1;
    bar.show(done, all);
  }
  return report;
}

}  // namespace

Exit bake(const BakeOptions& options) {
  const Stopwatch watch;
  if (const Result<void> can = store::available(); !can) return complain(can.error());
  const std::optional<std::pair<int, int>> levels = readLevels(options.levels);
  const std::optional<std::pair<uint64_t, uint64_t>> shard = readShard(options.shard.empty() ? "0/1" : options.shard);
  const OpenedWorld opened = openWorld(options);
  if (opened.program == nullptr) return opened.status;
  const Result<std::string> text = readGrammarText(options.file);
  if (!text) return complain(text.error());
  const store::BakedRegion region{opened.region, levels->first, levels->second, opened.settings.finest_cell};
  if (const Result<void> good = store::check(region); !good) return complain(good.error());

  const Result<std::unique_ptr<JobSystem>> jobs = makeThreadPool(options.threads);
  if (!jobs) return complain(jobs.error());
  const Result<std::unique_ptr<Backend>> backend = backendOf(options, **jobs);
  if (!backend) return complain(backend.error());
  if (!(*backend)->capabilities().exact)
    return complain(Exit::backend, "this device's meshes are not those of every other: bake with --backend cpu");
  const WorldField world(opened.settings, std::pmr::new_delete_resource());
  const Result<store::ContentId> key = store::worldKey(world, options.sharp);
  if (!key) return complain(key.error());

  const store::Folder folder(options.out);
  if (const Result<void> made = folder.make(); !made) return complain(made.error());
  Report report;
  const auto finish = [&] {
    report.seconds = watch.seconds();
    print(options, report, store::nameOf(*key));
    return Exit::done;
  };
  if (isThere(folder, *key, region)) {
    report.there_before = true;
    return finish();
  }
  const store::Bakery bakery{world,
                             **backend,
                             **jobs,
                             region,
                             options.sharp,
                             folder.baking(store::jobKey(*key, region)),
                             &unfinished_files,
                             std::pmr::new_delete_resource()};
  if (const Result<void> made = store::makeFolder(bakery.folder); !made) return complain(made.error());

  if (!options.merge) {
    const std::vector<store::TileKey> tiles = store::tilesOf(region);
    const Result<std::vector<uint64_t>> costs = [&] {
      ProgressBar bar("planning");
      return store::planOf(bakery, tiles, [&](uint64_t done, uint64_t total) {
        bar.show(done, total);
        return true;
      });
    }();
    if (!costs) return complain(costs.error());
    if (options.slurm != 0)
      return bakeBySlurm(options, slurmBakeOf(options, store::nameOf(store::jobKey(*key, region))));
    const auto [first, last] = store::tilesOfShard(*costs, shard->first, shard->second);
    Result<Report> baked = bakeTiles(bakery, tiles, *costs, first, last);
    if (!baked) return complain(baked.error());
    report = *baked;
    if (!options.shard.empty()) return finish();
  }
  const Result<store::Merged> merged = [&] {
    ProgressBar bar("merging");
    return store::merge(folder, bakery, [&](uint64_t done, uint64_t total) {
      bar.show(done, total);
      return true;
    });
  }();
  if (!merged) return complain(merged.error());
  report.merged = *merged;
  report.tiles = merged->tiles;
  const std::string manifest = manifestOf(options, opened, *text, region, *merged).text() + "\n";
  if (const Result<void> written =
          store::writeFile(folder.manifest(*key), std::as_bytes(std::span(manifest)), &unfinished_files);
      !written)
    return complain(written.error());
  return finish();
}

}  // namespace sgm::cli
