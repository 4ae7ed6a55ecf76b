// `sgm store`: lists and verifies a store of baked worlds, compares two baked worlds, and removes unused files.

#include <fmt/core.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "base/file_reader.h"
#include "base/json.h"
#include "store/verify.h"
#include "tools/cli/bake/commands.h"
#include "tools/cli/bake/store_turn.h"
#include "tools/support/console.h"
#include "tools/support/region.h"

namespace sgm::cli {
namespace {

namespace fs = std::filesystem;

std::string chunkName(const ChunkKey& chunk) {
  return fmt::format("{} {} {} {}", chunk.level, chunk.at.x, chunk.at.y, chunk.at.z);
}

double megabytes(uint64_t bytes) { return static_cast<double>(bytes) / 1e6; }

Result<void> checkFolder(const store::Folder& folder) {
  if (Result<void> here = store::checkHere(folder.root().string()); !here) return here;
  return folder.check();
}

/// Opens the worlds whose names begin with `name` (all worlds if `name` is empty); the result contains an error for
/// each world that cannot be read.
Result<std::vector<Result<store::WorldFile>>> openWorlds(const store::Folder& folder, const std::string& name) {
  if (Result<void> can = store::available(); !can) return can.error();
  if (Result<void> good = checkFolder(folder); !good) return good.error();
  const Result<std::vector<fs::path>> paths = store::worldsOf(folder);
  if (!paths) return paths.error();
  std::vector<Result<store::WorldFile>> worlds;
  for (const fs::path& path : *paths) {
    if (path.stem().string().rfind(name, 0) == 0) worlds.push_back(store::WorldFile::open(path));
  }
  if (name.empty() || worlds.size() == 1) return worlds;
  return Error{Code::invalid_argument,
               fmt::format("'{}' has {} worlds whose name begins with {}: list them with sgm store info",
                           folder.root().string(), worlds.size(), name)};
}

/// The only world whose name begins with `name`. It is an error if there are none or several.
Result<store::WorldFile> worldOf(const store::Folder& folder, const std::string& name) {
  Result<std::vector<Result<store::WorldFile>>> worlds = openWorlds(folder, name);
  if (!worlds) return worlds.error();
  if (worlds->size() == 1) return std::move(worlds->front());
  return Error{Code::invalid_argument,
               fmt::format("'{}' has {} worlds: choose one with --from or --to (sgm store info lists them)",
                           folder.root().string(), worlds->size())};
}

/// Prints each problem to stderr.
void tell(const store::Problems& problems) {
  for (const std::string& problem : problems.told) fmt::print(stderr, "sgm: error: {}\n", problem);
  if (problems.count > problems.told.size())
    fmt::print(stderr, "sgm: error: and {} more\n", problems.count - problems.told.size());
}

Json boxJson(const IntBox& box) { return {metresJson(box.lo), metresJson(box.hi)}; }

/// The origin of a stored world for the report: grammar, seed, settings and parameters, read from the world's manifest;
/// nullopt if the manifest cannot be read.
std::optional<Json> originOf(const fs::path& manifest) {
  constexpr uint64_t kMaxManifest = uint64_t{64} << 20;
  const Result<std::string> text = readFile(manifest, kMaxManifest);
  if (!text) return std::nullopt;
  const nlohmann::json json = nlohmann::json::parse(*text, nullptr, false);
  if (!json.is_object()) return std::nullopt;
  Json origin = Json::object();
  const auto take = [&](const char* name, const nlohmann::json& from, const char* key) {
    const auto value = from.is_object() ? from.find(key) : from.end();
    if (!from.is_object() || value == from.end()) return;
    if (value->is_string()) origin[name] = value->get<std::string>();
    if (value->is_boolean()) origin[name] = value->get<bool>();
    if (value->is_number_unsigned()) origin[name] = value->get<uint64_t>();
    if (value->is_number_float()) origin[name] = value->get<double>();
  };
  take("grammar", json.value("grammar", nlohmann::json()), "file");
  for (const char* key : {"seed", "sharp", "library", "meshing"}) take(key, json, key);
  Json& parameters = origin["parameters"] = Json::object();
  const nlohmann::json values = json.value("parameters", nlohmann::json::object());
  for (const auto& [name, value] : values.items()) {
    if (value.is_number()) parameters[name] = value.get<double>();
  }
  return origin;
}

/// Bakes again some chunks of the world that the options describe, and compares them with the stored chunks. Adds the
/// result to `json`.
Exit bakeAgain(const StoreVerifyOptions& options, const store::Folder& folder, Json& json) {
  const OpenedWorld opened = openWorld(options);
  if (opened.program == nullptr) return opened.status;
  const Result<std::unique_ptr<JobSystem>> jobs = makeThreadPool(options.threads);
  if (!jobs) return reportError(jobs.error());
  const Result<std::unique_ptr<Backend>> backend = backendOf(options, **jobs);
  if (!backend) return reportError(backend.error());
  if (!(*backend)->capabilities().exact) return reportError(Exit::backend, kNotExact);
  std::pmr::memory_resource* memory = std::pmr::new_delete_resource();
  const WorldField world(opened.settings, memory);
  const Result<store::ContentId> key = store::worldKey(folder, world, options.sharp);
  if (!key) return reportError(key.error());
  std::error_code error;
  if (!fs::exists(folder.world(*key), error)) {
    return reportError(
        Exit::input,
        fmt::format(
            "'{}' has no bake of '{}' with this seed, these parameters and cells: sgm store info lists its bakes",
            options.store, options.file));
  }
  const Result<store::WorldFile> file = store::WorldFile::open(folder.world(*key));
  if (!file) return reportError(file.error());
  const Result<store::Bakery> bakery =
      store::bakeryOf(world, **backend, **jobs, file->index.region, options.sharp, folder, memory);
  if (!bakery) return reportError(bakery.error());
  const Result<store::Compared> compared = store::compareWithBaking(*bakery, *file, options.samples, options.draw);
  if (!compared) return reportError(compared.error());
  tell(compared->problems);
  json["baked_again"] = {{"chunks", compared->chunks}, {"problems", compared->problems.count}};
  if (!options.json) {
    fmt::print("{}: {} chunks baked again, {} parts differ\n", store::nameOf(*key), compared->chunks,
               compared->problems.count);
  }
  return compared->problems.count == 0 ? Exit::done : Exit::input;
}

}  // namespace

Exit storeInfo(const StoreOptions& options) {
  const store::Folder folder(options.store);
  const Result<std::vector<Result<store::WorldFile>>> worlds = openWorlds(folder, options.world);
  if (!worlds) return reportError(worlds.error());
  Json all = Json::array();
  Exit status = Exit::done;
  for (const Result<store::WorldFile>& world : *worlds) {
    const Result<store::WorldSummary> summary =
        world ? store::summaryOf(*world, std::pmr::new_delete_resource()) : Result<store::WorldSummary>(world.error());
    if (!summary) {
      status = reportError(summary.error());
      continue;
    }
    const store::BakedRegion& region = world->index.region;
    const std::string name = store::nameOf(world->index.world);
    const std::optional<Json> read = originOf(folder.manifest(world->index.world));
    const bool has_origin = read.has_value();
    const Json origin = read.value_or(Json());
    all.push_back({{"world", name},
                   {"manifest", folder.manifest(world->index.world).string()},
                   {"from", origin},
                   {"region", boxJson(region.box)},
                   {"levels", {region.first_level, region.last_level}},
                   {"cell_units", region.finest_cell},
                   {"tiles", summary->tiles},
                   {"chunks", summary->chunks},
                   {"triangles", summary->measured.triangles},
                   {"contents", summary->contents},
                   {"packs", summary->packs},
                   {"pack_bytes", summary->pack_bytes}});
    if (options.json) continue;
    fmt::print("{}\n", name);
    fmt::print("  from     {}\n", has_origin ? origin.line() : "unknown: the manifest cannot be read");
    fmt::print("  region   {},{},{} to {},{},{} m, levels {} to {}, cells of {} m\n", metres(region.box.lo.x),
               metres(region.box.lo.y), metres(region.box.lo.z), metres(region.box.hi.x), metres(region.box.hi.y),
               metres(region.box.hi.z), region.first_level, region.last_level, metres(region.finest_cell));
    fmt::print("  chunks   {} in {} tiles, {} triangles\n", summary->chunks, summary->tiles,
               summary->measured.triangles);
    fmt::print("  files    {} packs, {:.1f} MB\n", summary->packs, megabytes(summary->pack_bytes));
  }
  if (options.json) fmt::print("{}\n", Json{{"worlds", all}}.text());
  if (!options.json && worlds->empty()) fmt::print("'{}' has no worlds yet\n", options.store);
  return status;
}

Exit storeVerify(const StoreVerifyOptions& options) {
  const store::Folder folder(options.store);
  const Result<std::vector<Result<store::WorldFile>>> worlds = openWorlds(folder, options.world);
  if (!worlds) return reportError(worlds.error());
  if (worlds->empty()) {
    return reportError(
        Exit::input,
        fmt::format("'{}' has no worlds to verify: bake one with sgm bake, or merge shards with sgm bake --merge",
                    options.store));
  }
  Exit status = Exit::done;
  Json json = Json::object();
  // Bake again first, so that wrong options are reported before the whole store is read.
  if (!options.file.empty()) status = bakeAgain(options, folder, json);
  if (status == Exit::usage || status == Exit::backend) return status;
  Json all = Json::array();
  for (const Result<store::WorldFile>& world : *worlds) {
    if (!world) {
      status = reportError(world.error());
      continue;
    }
    const store::Verified found = [&] {
      ProgressBar bar("verifying");
      return store::verify(folder, *world, [&](uint64_t done, uint64_t total) {
        bar.show(done, total);
        return true;
      });
    }();
    tell(found.problems);
    if (found.problems.count != 0) status = Exit::input;
    all.push_back({{"world", store::nameOf(world->index.world)},
                   {"tiles", found.tiles},
                   {"chunks", found.chunks},
                   {"contents", found.contents},
                   {"packs", found.packs},
                   {"bytes", found.bytes},
                   {"borders", found.borders},
                   {"problems", found.problems.count}});
    if (!options.json) {
      fmt::print("{}: {} chunks in {} tiles, {} contents in {} packs ({:.1f} MB), {} borders between chunks: {}\n",
                 store::nameOf(world->index.world), found.chunks, found.tiles, found.contents, found.packs,
                 megabytes(found.bytes), found.borders,
                 found.problems.count == 0 ? "complete and closed" : fmt::format("{} problems", found.problems.count));
    }
  }
  json["worlds"] = std::move(all);
  if (options.json) fmt::print("{}\n", json.text());
  return status;
}

Exit storeDiff(const StoreDiffOptions& options) {
  const store::Folder from(options.store), to(options.other);
  const Result<store::WorldFile> before = worldOf(from, options.from), after = worldOf(to, options.to);
  if (!before) return reportError(before.error());
  if (!after) return reportError(after.error());
  if (before->index.region.finest_cell != after->index.region.finest_cell) {
    return reportError(Exit::input,
                       fmt::format("the worlds have cells of {} and {} m: only worlds with equal cells can be compared",
                                   metres(before->index.region.finest_cell), metres(after->index.region.finest_cell)));
  }
  std::pmr::memory_resource* memory = std::pmr::new_delete_resource();
  std::set<store::ContentId> had;
  for (const store::TileEntry& tile : before->index.tiles) {
    const Result<store::TileRecord> record = before->record(tile, memory);
    if (!record) return reportError(record.error());
    for (const store::StoredContent& content : record->contents) had.insert(content.id);
  }
  uint64_t changed = 0, added = 0, removed = 0, bytes = 0;
  Json chunks = Json::array();
  const auto tell = [&](const ChunkKey& chunk, const char* how) {
    if (options.json) {
      chunks.push_back({{"level", chunk.level}, {"at", {chunk.at.x, chunk.at.y, chunk.at.z}}, {"how", how}});
    } else if (options.list) {
      fmt::print("{} {}\n", how, chunkName(chunk));
    }
  };
  std::set<store::TileKey> tiles;
  for (const store::WorldFile* world : {&*before, &*after}) {
    for (const store::TileEntry& tile : world->index.tiles) tiles.insert(tile.key);
  }
  for (const store::TileKey& tile : tiles) {
    const auto recordOf = [&](const store::WorldFile& world) -> Result<store::TileRecord> {
      const store::TileEntry* entry = world.index.find(tile);
      if (entry == nullptr) return store::TileRecord{};
      return world.record(*entry, memory);
    };
    const Result<store::TileRecord> old = recordOf(*before), now = recordOf(*after);
    if (!old) return reportError(old.error());
    if (!now) return reportError(now.error());
    for (const store::StoredContent& content : now->contents) {
      if (had.insert(content.id).second) bytes += content.stored;
    }
    for (size_t chunk = 0; chunk < store::kTileChunks; ++chunk) {
      const bool was = old->contentOf(chunk, 0) != nullptr, is = now->contentOf(chunk, 0) != nullptr;
      bool differs = false;
      for (int part = 0; was && is && part < kChunkParts; ++part) {
        const store::StoredContent *one = old->contentOf(chunk, part), *other = now->contentOf(chunk, part);
        differs |= one == nullptr || other == nullptr ? one != other : one->id != other->id;
      }
      changed += differs;
      added += is && !was;
      removed += was && !is;
      if (differs || was != is) tell(store::chunkOf(tile, chunk), differs ? "changed" : is ? "added" : "removed");
    }
  }
  if (options.json) {
    fmt::print("{}\n",
               Json{{"changed", changed}, {"added", added}, {"removed", removed}, {"bytes", bytes}, {"chunks", chunks}}
                   .text());
  } else {
    fmt::print("{} chunks changed, {} added, {} removed; {:.2f} MB of contents are new\n", changed, added, removed,
               megabytes(bytes));
  }
  return Exit::done;
}

Exit storeClean(const StoreOptions& options) {
  const store::Folder folder(options.store);
  if (const Result<void> can = store::available(); !can) return reportError(can.error());
  if (const Result<void> good = checkFolder(folder); !good) return reportError(good.error());
  const Result<store::Cleaned> cleaned =
      inTurn(folder, [&](auto patience) { return store::clean(folder, std::pmr::new_delete_resource(), patience); });
  if (!cleaned) return reportError(cleaned.error());
  if (options.json) {
    fmt::print("{}\n",
               Json{{"packs", cleaned->packs}, {"bytes", cleaned->bytes}, {"unfinished", cleaned->unfinished}}.text());
    return Exit::done;
  }
  fmt::print("{} packs removed, {:.1f} MB\n", cleaned->packs, megabytes(cleaned->bytes));
  if (cleaned->unfinished != 0)
    fmt::print("{} bakes are not merged yet: finish them, or remove '{}'\n", cleaned->unfinished,
               (folder.root() / "baking").string());
  return Exit::done;
}

}  // namespace sgm::cli
