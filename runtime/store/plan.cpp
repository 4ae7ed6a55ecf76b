#include "store/plan.h"

#include <algorithm>
#include <mutex>
#include <numeric>
#include <optional>

#include "base/bytes.h"
#include "base/file_reader.h"
#include "chunk/mesh_chunks.h"
#include "field/prune.h"

namespace sgm::store {
namespace {

constexpr uint32_t kPlanMagic = 0x4C4D4753;  // "SGML"
constexpr uint32_t kPlanVersion = 1;
constexpr uint64_t kMaxPlan = uint64_t{1} << 28;

// Costs, in microseconds of one thread, measured with samples/grammars (tests/bench/README.md). A chunk that is proven
// empty or solid costs kUniform. Any other chunk, with its seams, costs kSampled plus kInstruction for each instruction
// of its pruned field program.
constexpr double kUniform = 28, kSampled = 740, kInstruction = 6;

std::vector<std::byte> encodePlan(const ContentId& job, std::span<const uint64_t> costs) {
  std::vector<std::byte> bytes;
  ByteWriter out(bytes);
  out.put(kPlanMagic);
  out.put(kPlanVersion);
  putId(job, out);
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
    // Clamps the box to the world's coordinate range: a block of chunks may extend beyond it, although no chunks exist
    // there.
    constexpr int64_t kLow = std::numeric_limits<int32_t>::min(), kHigh = std::numeric_limits<int32_t>::max();
    box.lo[axis] = static_cast<int32_t>(std::clamp(lo, kLow, kHigh));
    box.hi[axis] = static_cast<int32_t>(std::clamp(lo + chunks * edge, kLow, kHigh));
  }
  return box;
}

/// Estimates the cost of a tile: prunes the field's program to cubes of at most 4 x 4 x 4 chunks, and counts the
/// instructions that are left.
class Estimate {
 public:
  Estimate(const Bakery& bakery, const TileKey& tile)
      : bakery_(bakery), tile_(tile), wanted_(kTileChunks), scratch_(bakery.memory) {
    for (const size_t number : chunksIn(bakery.region, tile)) wanted_[number] = true;
  }

  Result<double> cost() {
    CachedCells cached_cells;
    for (int block = 0; block < 8; ++block) {
      const ChunkKey first = neighbourOf(chunkOf(tile_, 0), 4 * (block & 1), 4 * (block >> 1 & 1), 4 * (block >> 2));
      if (count(first, 4) == 0) continue;
      const IntBox box = boxOf(bakery_.region, first, 4);
      const Result<std::shared_ptr<const FieldProgram>> program =
          bakery_.world.compile(box, tile_.level, nullptr, &cached_cells);
      if (!program) return program.error();
      look((*program)->view(), first, 4);
    }
    return cost_;
  }

 private:
  /// Counts the chunks of a cube that belong to the tile and to the region. first: the cube's lowest chunk; edge: its
  /// edge in chunks.
  size_t count(const ChunkKey& first, int edge) const {
    size_t chunks = 0;
    for (int i = 0; i < edge * edge * edge; ++i)
      chunks += wanted_[numberInTile(neighbourOf(first, i % edge, i / edge % edge, i / edge / edge))];
    return chunks;
  }

  void look(const ProgramView& field, const ChunkKey& first, int edge) {
    const size_t chunks = count(first, edge);
    if (chunks == 0) return;
    PrunedProgram left(bakery_.memory);
    prune(field, boxOf(bakery_.region, first, edge), scratch_, left);
    if (left.solid() || left.empty()) {
      cost_ += kUniform * static_cast<double>(chunks);
    } else if (edge == 1) {
      cost_ += kSampled + kInstruction * static_cast<double>(left.instrs.size());
    } else {
      const int half = edge / 2;
      for (int part = 0; part < 8; ++part)
        look(left.view(), neighbourOf(first, half * (part & 1), half * (part >> 1 & 1), half * (part >> 2)), half);
    }
  }

  const Bakery& bakery_;
  const TileKey tile_;
  std::vector<bool> wanted_;
  PruneScratch scratch_;
  double cost_ = 0;
};

}  // namespace

Result<std::vector<uint64_t>> planOf(const Bakery& bakery, std::span<const TileKey> tiles, const Progress& progress) {
  const std::filesystem::path file = bakery.folder / "plan";
  if (const auto bytes = readFile(file, kMaxPlan)) {
    if (std::optional<std::vector<uint64_t>> costs =
            decodePlan(bakery.job, std::as_bytes(std::span(*bytes)), tiles.size()))
      return std::move(*costs);
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
    const Result<double> cost = Estimate(bakery, tiles[i]).cost();
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
  if (Result<void> written = writeFile(file, encodePlan(bakery.job, costs), bakery.unfinished); !written)
    return written.error();
  return costs;
}

std::pair<size_t, size_t> tilesOfShard(std::span<const uint64_t> costs, size_t shard, size_t shards) {
  // Lays the tiles' costs end to end on a line, and divides the line into equal parts, one per shard. A tile belongs to
  // the shard whose part contains the middle of the tile's interval. 1 is added to each cost, so that no interval is
  // empty.
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
