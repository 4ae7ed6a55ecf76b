#include "store/plan.h"

#include <algorithm>
#include <mutex>
#include <numeric>
#include <optional>

#include "base/bytes.h"
#include "field/prune.h"
#include "store/folder.h"
#include "stream/mesh_chunks.h"

namespace sgm::store {
namespace {

constexpr uint32_t kPlanMagic = 0x4C4D4753;  // "SGML"
constexpr uint32_t kPlanVersion = 1;
constexpr uint64_t kMostPlan = uint64_t{1} << 28;

// Microseconds of one thread, as samples/grammars take (tests/bench/README.md): of a chunk proven uniform; of one that
// is sampled, with its seams; and of each instruction that is left there.
constexpr double kUniform = 20, kSampled = 900, kInstruction = 12;

std::vector<std::byte> encodePlan(const ContentId& job, std::span<const uint64_t> costs) {
  std::vector<std::byte> bytes;
  ByteWriter out(bytes);
  out.put(kPlanMagic);
  out.put(kPlanVersion);
  out.put(job.high);
  out.put(job.low);
  for (const uint64_t cost : costs) out.put(cost);
  out.put(checksumOf(bytes));
  return bytes;
}

std::optional<std::vector<uint64_t>> decodePlan(const ContentId& job, std::span<const std::byte> bytes, size_t tiles) {
  std::vector<uint64_t> costs(tiles);
  ByteReader in(bytes);
  for (size_t i = 0; i < 3; ++i) in.get<uint64_t>();
  for (uint64_t& cost : costs) cost = in.get<uint64_t>();
  const auto checksum = in.get<uint64_t>();
  if (in.failed() || in.left() != 0) return std::nullopt;
  const std::vector<std::byte> same = encodePlan(job, costs);
  if (!std::equal(same.begin(), same.end(), bytes.begin(), bytes.end()) ||
      checksum != checksumOf(bytes.first(bytes.size() - 8)))
    return std::nullopt;
  return costs;
}

IntBox boxOf(const BakedRegion& region, const ChunkKey& first, int chunks) {
  const int64_t edge = (int64_t{kChunkCells} * region.finest_cell) << first.level;
  IntBox box;
  for (int axis = 0; axis < 3; ++axis) {
    const int64_t lo = first.at[axis] * edge;
    box.lo[axis] = static_cast<int32_t>(lo);
    box.hi[axis] = static_cast<int32_t>(std::min<int64_t>(lo + chunks * edge, std::numeric_limits<int32_t>::max()));
  }
  return box;
}

/// A tile's chunks, two by two by two together: what is left of the field there tells what each will take.
Result<double> costOf(const Bakery& bakery, const TileKey& tile) {
  const std::vector<size_t> numbers = chunksIn(bakery.region, tile);
  std::vector<bool> wanted(kTileChunks);
  for (const size_t number : numbers) wanted[number] = true;
  CellsAtHand at_hand;
  PruneScratch scratch(bakery.memory);
  PrunedProgram block(bakery.memory), chunk(bakery.memory);
  double cost = 0;
  for (int b = 0; b < 64; ++b) {
    const ChunkKey first = {
        tile.level, {8 * tile.at.x + 2 * (b % 4), 8 * tile.at.y + 2 * (b / 4 % 4), 8 * tile.at.z + 2 * (b / 16)}};
    std::vector<ChunkKey> chunks;
    for (int i = 0; i < 8; ++i) {
      const ChunkKey one = neighbourOf(first, i & 1, i >> 1 & 1, i >> 2 & 1);
      if (wanted[numberInTile(one)]) chunks.push_back(one);
    }
    if (chunks.empty()) continue;
    const IntBox box = boxOf(bakery.region, first, 2);
    const Result<std::shared_ptr<const FieldProgram>> program =
        bakery.world.compile(box, tile.level, nullptr, &at_hand);
    if (!program) return program.error();
    prune((*program)->view(), box, scratch, block);
    cost += kUniform * static_cast<double>(chunks.size());
    if (block.solid() || block.empty()) continue;
    for (const ChunkKey& one : chunks) {
      prune(block.view(), boxOf(bakery.region, one, 1), scratch, chunk);
      if (!chunk.solid() && !chunk.empty()) cost += kSampled + kInstruction * static_cast<double>(chunk.instrs.size());
    }
  }
  return cost;
}

}  // namespace

Result<std::vector<uint64_t>> planOf(const Bakery& bakery, std::span<const TileKey> tiles, const Progress& progress) {
  const Result<ContentId> world = worldKey(bakery.world, bakery.sharp);
  if (!world) return world.error();
  const ContentId job = jobKey(*world, bakery.region);
  const std::filesystem::path file = bakery.folder / "plan";
  if (const Result<std::vector<std::byte>> bytes = readFile(file, kMostPlan)) {
    if (std::optional<std::vector<uint64_t>> costs = decodePlan(job, *bytes, tiles.size())) return std::move(*costs);
  }
  std::vector<uint64_t> costs(tiles.size());
  std::mutex mutex;
  std::optional<Error> error;
  uint64_t done = 0;
  parallelFor(bakery.jobs, tiles.size(), [&](size_t i) {
    {
      const std::lock_guard lock(mutex);
      if (error) return;
    }
    const Result<double> cost = costOf(bakery, tiles[i]);
    const std::lock_guard lock(mutex);
    if (!cost) {
      error = cost.error();
      return;
    }
    costs[i] = static_cast<uint64_t>(*cost);
    if (progress && !progress(++done, tiles.size()) && done < tiles.size())
      error = Error{Code::cancelled, "planning was cancelled"};
  });
  if (error) return *error;
  if (Result<void> written = writeFile(file, encodePlan(job, costs), bakery.unfinished); !written)
    return written.error();
  return costs;
}

std::pair<size_t, size_t> tilesOfShard(std::span<const uint64_t> costs, size_t shard, size_t shards) {
  // A tile goes where its middle lies. One that costs nothing has a middle, too.
  const double all = static_cast<double>(std::accumulate(costs.begin(), costs.end(), uint64_t{0}) + costs.size());
  const auto firstOf = [&](size_t number) {
    if (number == shards) return costs.size();
    const double from = all * static_cast<double>(number) / static_cast<double>(shards);
    double before = 0;
    for (size_t i = 0; i < costs.size(); ++i) {
      const double cost = static_cast<double>(costs[i]) + 1;
      if (before + cost / 2 >= from) return i;
      before += cost;
    }
    return costs.size();
  };
  return {firstOf(shard), firstOf(shard + 1)};
}

}  // namespace sgm::store
