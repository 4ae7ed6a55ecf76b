#include <algorithm>
#include <numeric>

#include "backend/cpu/mesh_chunk.h"
#include "query/query_sampler.h"

namespace sgm {

namespace {

constexpr int64_t kMaxWalkChunks = 4096;

/// The samples over a box in vertical columns, one cell apart, and the floors in them on which a walker can stand.
class WalkGrid {
 public:
  WalkGrid(const QueryField& field, const IntBox& box, const Walker& walker)
      : field_(field),
        cell_(field.finest_cell),
        box_(box),
        walker_(walker),
        solid_(field.memory),
        floors_(field.memory) {
    // The largest rise of a floor, per unit of horizontal distance, that the walker's slope allows.
    const double flat = walker.slope * walker.slope;
    rise_ = flat > 0 ? std::sqrt((1 - flat) / flat) : 1e9;
    const auto margin = static_cast<int64_t>(std::ceil(walker.radius)) + cell_;
    const std::array<int64_t, 3> below{margin, cell_, margin};
    const std::array<int64_t, 3> above{margin, static_cast<int64_t>(std::ceil(walker.height)) + cell_, margin};
    for (size_t axis = 0; axis < 3; ++axis) {
      const int a = static_cast<int>(axis);
      first_[axis] = floorDiv(box.lo[a] - below[axis], cell_);
      count_[axis] = floorDiv(box.hi[a] + above[axis], cell_) - first_[axis] + 1;
    }
  }

  Result<WalkableArea> run() {
    const int64_t edge = int64_t{kChunkCells} * cell_;
    std::array<int64_t, 3> low{}, high{};
    int64_t chunks = 1;
    for (size_t axis = 0; axis < 3; ++axis) {
      low[axis] = floorDiv(first_[axis], kChunkCells);
      high[axis] = floorDiv(first_[axis] + count_[axis] - 1, kChunkCells);
      if (low[axis] * edge < INT32_MIN || (high[axis] + 1) * edge > INT32_MAX) {
        return Error{Code::range, "the box, with the walker's room around it, leaves the world"};
      }
      chunks = std::min(chunks * (high[axis] - low[axis] + 1), kMaxWalkChunks + 1);
    }
    if (chunks > kMaxWalkChunks) {
      return Error{Code::limit, "the box, with the walker's room around it, has more than " +
                                    std::to_string(kMaxWalkChunks) + " chunks of 32 cells; split the box"};
    }
    solid_.resize(static_cast<size_t>(count_[0] * count_[1] * count_[2]));
    ChunkScratch scratch(field_.memory);
    for (int64_t z = low[2]; z <= high[2]; ++z) {
      for (int64_t y = low[1]; y <= high[1]; ++y) {
        for (int64_t x = low[0]; x <= high[0]; ++x) {
          const auto at = [&](int64_t place) { return static_cast<int32_t>(place * edge); };
          if (Result<void> read = readChunk({{at(x), at(y), at(z)}, cell_, 0}, scratch); !read) return read.error();
        }
      }
    }
    std::erase_if(floors_, [&](const Floor& floor) { return !fits(floor); });
    return joined();
  }

 private:
  /// A floor: the upper end of a run of solid samples in a column.
  struct Floor {
    int32_t x = 0, z = 0;  ///< indices of the column, relative to first_
    int32_t y = 0;         ///< index of the solid sample under the floor, relative to first_
    double height = 0;     ///< height of the floor above the sample y, in units
  };

  size_t index(int64_t x, int64_t y, int64_t z) const {
    return static_cast<size_t>(y + count_[1] * (x + count_[0] * z));
  }

  Result<void> readChunk(const ChunkGrid& grid, ChunkScratch& scratch) {
    IntBox box{grid.origin, grid.origin};
    std::array<int64_t, 3> from{};
    for (int axis = 0; axis < 3; ++axis) {
      box.hi[axis] += kChunkCells * cell_;
      from[static_cast<size_t>(axis)] = grid.origin[axis] / cell_ - first_[static_cast<size_t>(axis)];
    }
    Result<std::shared_ptr<const FieldProgram>> program = field_.at(box);
    if (!program) return program.error();
    const bool mixed = sampleChunk(bestChunkKernels(), (*program)->view(), grid, scratch);
    std::pmr::vector<Floor> found(field_.memory);
    std::pmr::vector<int32_t> px(field_.memory), py(field_.memory), pz(field_.memory);
    for (int z = 0; z < kChunkCells; ++z) {
      for (int y = 0; y < kChunkCells; ++y) {
        const auto row = static_cast<size_t>(y + z * kChunkSamples);
        const uint64_t here = scratch.samples.signs[row], above = scratch.samples.signs[row + 1];
        for (int x = 0; x < kChunkCells; ++x) {
          const int64_t gx = from[0] + x, gy = from[1] + y, gz = from[2] + z;
          if (gx < 0 || gy < 0 || gz < 0 || gx >= count_[0] || gy >= count_[1] || gz >= count_[2]) continue;
          solid_[index(gx, gy, gz)] = here >> x & 1;
          if (!mixed || (here >> x & 1) == 0 || (above >> x & 1) != 0) continue;
          const size_t at = row * kChunkSamples + static_cast<size_t>(x);
          const uint32_t share = crossing(scratch.samples.q[at], scratch.samples.q[at + kChunkSamples]);
          const Int3 p{grid.origin.x + x * cell_,
                       grid.origin.y + y * cell_ + localUnits(static_cast<int32_t>(share), cell_),
                       grid.origin.z + z * cell_};
          if (!box_.contains(p)) continue;
          found.push_back({static_cast<int32_t>(gx), static_cast<int32_t>(gz), static_cast<int32_t>(gy),
                           static_cast<double>(share) * cell_ / kSubcell});
          px.push_back(p.x);
          py.push_back(p.y);
          pz.push_back(p.z);
        }
      }
    }
    std::pmr::vector<int16_t> nx(found.size(), field_.memory), ny(found.size(), field_.memory);
    Attributes attributes;
    attributes.normal_x = nx.data();
    attributes.normal_y = ny.data();
    bestKernels().attributes((*program)->view(), {px.data(), py.data(), pz.data(), found.size()}, scratch.evaluation,
                             attributes);
    for (size_t i = 0; i < found.size(); ++i) {
      if (unpackNormal(nx[i], ny[i])[1] >= walker_.slope) floors_.push_back(found[i]);
    }
    return {};
  }

  /// True if column (x, z) has no solid sample strictly between the heights `low` and `high` (in units) above the
  /// floor.
  bool clear(int64_t x, int64_t z, const Floor& floor, double low, double high) const {
    const auto first = static_cast<int64_t>(std::floor((floor.height + low) / cell_)) + floor.y + 1;
    const auto last = static_cast<int64_t>(std::ceil((floor.height + high) / cell_)) + floor.y - 1;
    for (int64_t y = std::max<int64_t>(first, 0); y <= std::min(last, count_[1] - 1); ++y) {
      if (solid_[index(x, y, z)]) return false;
    }
    return true;
  }

  bool fits(const Floor& floor) const {
    if (!clear(floor.x, floor.z, floor, 0, walker_.height)) return false;
    const auto reach = static_cast<int64_t>(std::floor(walker_.radius / cell_));
    for (int64_t dz = -reach; dz <= reach; ++dz) {
      for (int64_t dx = -reach; dx <= reach; ++dx) {
        const double away = std::sqrt(static_cast<double>(dx * dx + dz * dz)) * cell_;
        if (away > walker_.radius) continue;
        if (!clear(floor.x + dx, floor.z + dz, floor, walker_.step + away * rise_, walker_.height)) return false;
      }
    }
    return true;
  }

  WalkableArea joined() {
    const auto place = [](const Floor& f) { return std::tie(f.z, f.x, f.y); };
    std::sort(floors_.begin(), floors_.end(), [&](const Floor& a, const Floor& b) { return place(a) < place(b); });
    std::pmr::vector<size_t> parent(floors_.size(), field_.memory);
    std::iota(parent.begin(), parent.end(), size_t{0});
    const auto rootOf = [&](size_t i) {
      while (parent[i] != i) i = parent[i] = parent[parent[i]];
      return i;
    };
    const double climb = walker_.step + rise_ * cell_;
    const auto level = [&](const Floor& f) { return static_cast<double>(f.y) * cell_ + f.height; };
    for (size_t i = 0; i < floors_.size(); ++i) {
      const Floor& here = floors_[i];
      for (const auto& [dx, dz] : {std::array{1, 0}, std::array{0, 1}}) {
        const Floor column{here.x + dx, here.z + dz, 0, 0};
        auto next = std::lower_bound(floors_.begin(), floors_.end(), column,
                                     [&](const Floor& a, const Floor& b) { return place(a) < place(b); });
        for (; next != floors_.end() && next->x == column.x && next->z == column.z; ++next) {
          if (std::fabs(level(*next) - level(here)) > climb) continue;
          const size_t a = rootOf(i), b = rootOf(static_cast<size_t>(next - floors_.begin()));
          parent[std::max(a, b)] = std::min(a, b);
        }
      }
    }
    std::pmr::vector<size_t> sizes(floors_.size(), field_.memory);
    for (size_t i = 0; i < floors_.size(); ++i) ++sizes[rootOf(i)];
    const auto largest = std::max_element(sizes.begin(), sizes.end());
    WalkableArea area;
    if (floors_.empty()) return area;
    const double square = static_cast<double>(cell_) * cell_;
    area.standing = static_cast<double>(floors_.size()) * square;
    area.largest = static_cast<double>(*largest) * square;
    area.walkable = area.largest >= walker_.area;
    for (size_t i = 0; i < floors_.size(); ++i) {
      if (rootOf(i) == static_cast<size_t>(largest - sizes.begin())) area.sides |= sidesOf(floors_[i]);
    }
    return area;
  }

  /// Returns the side faces of the box that are within one cell of this floor's column.
  uint8_t sidesOf(const Floor& floor) const {
    const auto onAxis = [&](int axis, int64_t at) {
      const int64_t place = (first_[static_cast<size_t>(axis)] + at) * cell_;
      return (place - cell_ < box_.lo[axis] ? 1 : 0) | (place + cell_ > box_.hi[axis] ? 2 : 0);
    };
    return static_cast<uint8_t>(onAxis(0, floor.x) | onAxis(2, floor.z) << 4);
  }

  const QueryField& field_;
  const int32_t cell_;
  const IntBox box_;
  const Walker walker_;
  double rise_ = 0;
  /// first_: index of the lowest sample on each axis (its position divided by the cell edge); count_: number of samples
  /// on each axis
  std::array<int64_t, 3> first_{}, count_{};
  std::pmr::vector<bool> solid_;
  std::pmr::vector<Floor> floors_;
};

}  // namespace

Result<WalkableArea> isWalkable(const QueryField& field, const IntBox& box, const Walker& walker) {
  const double cell = field.finest_cell;
  if (box.empty()) return Error{Code::invalid_argument, "the box is empty"};
  if (!(walker.radius >= 0 && walker.radius <= 64 * cell))
    return Error{Code::invalid_argument, "the walker's radius is not a number from 0 to 64 cells"};
  if (!(walker.height > 0 && walker.height <= 256 * cell))
    return Error{Code::invalid_argument, "the walker's height is not a number above 0 and up to 256 cells"};
  if (!(walker.step >= 0 && walker.step < walker.height))
    return Error{Code::invalid_argument, "the walker's step is not a number from 0 to less than its height"};
  if (!(walker.slope >= 0 && walker.slope <= 1))
    return Error{Code::invalid_argument, "the walker's slope is not a cosine from 0 to 1"};
  if (!(walker.area >= 0)) return Error{Code::invalid_argument, "the walker's area is not a number of at least 0"};
  return WalkGrid(field, box, walker).run();
}

}  // namespace sgm
