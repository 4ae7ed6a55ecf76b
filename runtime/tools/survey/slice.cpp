#include "tools/survey/slice.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <mutex>

namespace sgm::survey {
namespace {

constexpr int kBlock = 32;  // samples along an edge of a block; one field program is compiled for each block
constexpr float kDeepest = 2;
constexpr double kWorldEnd = 2'097'151;  // metres, maximum coordinate of the world on each axis

/// The part of a line within the horizontal extent of the columns; nullopt if the line misses it.
std::optional<CutLine> clippedTo(const Columns& columns, const CutLine& line) {
  double from = 0, to = 1;
  const double starts[] = {line.x0, line.z0}, ways[] = {line.x1 - line.x0, line.z1 - line.z0};
  const double lows[] = {metres(columns.extent.lo.x), metres(columns.extent.lo.z)};
  const double highs[] = {metres(columns.extent.hi.x), metres(columns.extent.hi.z)};
  for (int axis = 0; axis < 2; ++axis) {
    if (ways[axis] == 0) {
      if (starts[axis] < lows[axis] || starts[axis] > highs[axis]) return std::nullopt;
      continue;
    }
    const double a = (lows[axis] - starts[axis]) / ways[axis], b = (highs[axis] - starts[axis]) / ways[axis];
    from = std::max(from, std::min(a, b));
    to = std::min(to, std::max(a, b));
  }
  if (!(from < to)) return std::nullopt;
  return CutLine{starts[0] + from * ways[0], starts[1] + from * ways[1], starts[0] + to * ways[0],
                 starts[1] + to * ways[1]};
}

/// Projects the subject (the void or the solid that is drawn) in all columns onto the plane of the cut, and stores the
/// result in Slice::beyond.
void lookBeyond(const Columns& columns, Slice& slice) {
  slice.beyond = Grid(slice.depth.width, slice.depth.height, -1);
  const double length = slice.line.length();
  const double ux = (slice.line.x1 - slice.line.x0) / length, uz = (slice.line.z1 - slice.line.z0) / length;
  for (int z = 0; z < columns.widest.height; ++z) {
    for (int x = 0; x < columns.widest.width; ++x) {
      const double along = ((columns.xAt(x) - slice.line.x0) * ux + (columns.zAt(z) - slice.line.z0) * uz) / slice.step;
      const int s = static_cast<int>(std::lround(along));
      if (s < 0 || s >= slice.beyond.width) continue;
      const size_t column = columns.widest.index(x, z);
      for (uint32_t i = columns.first[column]; i < columns.first[column + 1]; ++i) {
        const Stretch& stretch = columns.stretches[i];
        const auto row = [&](float height) {
          return std::clamp(static_cast<int>(std::lround((slice.top - static_cast<double>(height)) / slice.step)), 0,
                            slice.beyond.height - 1);
        };
        for (int y = row(stretch.top); y <= row(stretch.bottom); ++y) slice.beyond.at(s, y) = 1;
      }
    }
  }
}

Result<void> readBlock(const WorldField& world, int level, int left, int top, Slice& slice) {
  const int width = std::min(kBlock, slice.depth.width - left), height = std::min(kBlock, slice.depth.height - top);
  const double length = slice.line.length();
  std::vector<Int3> points;
  IntBox box;
  for (int y = top; y < top + height; ++y) {
    for (int s = left; s < left + width; ++s) {
      const double share = std::min(1.0, s * slice.step / length);
      const auto units = [](double value) { return static_cast<int32_t>(std::lround(value * kUnitsPerMetre)); };
      const Int3 p{units(slice.line.x0 + share * (slice.line.x1 - slice.line.x0)), units(slice.heightAt(y)),
                   units(slice.line.z0 + share * (slice.line.z1 - slice.line.z0))};
      points.push_back(p);
      box = box.joined({p, p});
    }
  }
  std::vector<uint32_t> labels;
  const Result<std::vector<float>> values = valuesAt(world, level, box, points, &labels);
  if (!values) return values.error();
  const auto step = static_cast<float>(slice.step * kUnitsPerMetre);
  size_t i = 0;
  for (int y = top; y < top + height; ++y) {
    for (int s = left; s < left + width; ++s, ++i) {
      const float value = (*values)[i] / step;
      slice.depth.at(s, y) = std::clamp(slice.subject == Subject::hollow ? value : -value, -kDeepest, kDeepest);
      if (value < 0) slice.label[slice.depth.index(s, y)] = labels[i];
    }
  }
  return {};
}

/// Finds the first run of consecutive areas that are nearly as large as the largest area, and returns the index in the
/// middle of this run. Areas near both ends of the list do not count: there, the region's border may cut a passage
/// lengthwise.
double middleOfBest(const std::vector<double>& areas) {
  constexpr double kAsGood = 0.97;
  const size_t edge = areas.size() / 12, end = areas.size() - edge;
  double most = 0;
  for (size_t i = edge; i < end; ++i) most = std::max(most, areas[i]);
  size_t first = edge;
  while (first + 1 < end && areas[first] < kAsGood * most) ++first;
  size_t last = first;
  while (last + 1 < end && areas[last + 1] >= kAsGood * most) ++last;
  return static_cast<double>(first + last) / 2;
}

}  // namespace

double CutLine::length() const { return std::hypot(x1 - x0, z1 - z0); }

std::optional<CutLine> readCutLine(std::string_view text) {
  CutLine line;
  const char *at = text.data(), *end = text.data() + text.size();
  constexpr std::string_view kBetween = ",:,";
  size_t number = 0;
  for (double* value : {&line.x0, &line.z0, &line.x1, &line.z1}) {
    if (number > 0 && (at == end || *at++ != kBetween[number - 1])) return std::nullopt;
    ++number;
    const auto [rest, why] = std::from_chars(at, end, *value);
    if (why != std::errc() || !(std::fabs(*value) < kWorldEnd)) return std::nullopt;
    at = rest;
  }
  if (at != end || line.length() == 0) return std::nullopt;
  return line;
}

CutLine longestCut(const Columns& columns) {
  const int width = columns.widest.width, height = columns.widest.height;
  const bool along_x = width >= height;
  std::vector<double> areas(static_cast<size_t>(along_x ? height : width));
  for (int z = 0; z < height; ++z) {
    for (int x = 0; x < width; ++x) {
      const size_t column = columns.widest.index(x, z);
      for (uint32_t i = columns.first[column]; i < columns.first[column + 1]; ++i)
        areas[static_cast<size_t>(along_x ? z : x)] += static_cast<double>(columns.stretches[i].height());
    }
  }
  const double best = middleOfBest(areas);
  const double x0 = columns.xAt(0), x1 = columns.xAt(width - 1), z0 = columns.zAt(0), z1 = columns.zAt(height - 1);
  if (along_x) return {x0, columns.zAt(best), x1, columns.zAt(best)};
  return {columns.xAt(best), z0, columns.xAt(best), z1};
}

Result<Slice> sampleSlice(const WorldField& world, const Columns& columns, int level, const CutLine& line,
                          JobSystem& jobs) {
  const std::optional<CutLine> within = clippedTo(columns, line);
  if (!within)
    return Error{Code::invalid_argument,
                 "--section: the line does not meet the region: choose another line, or a --region that contains it"};
  Slice slice;
  slice.line = *within;
  slice.subject = columns.subject;
  slice.step = metres(columns.step);
  slice.top = metres(columns.extent.hi.y);
  const int samples = std::max(2, static_cast<int>(std::ceil(within->length() / slice.step)) + 1);
  slice.depth = Grid(samples, (columns.extent.hi.y - columns.extent.lo.y) / columns.step + 1, -kDeepest);
  slice.label.resize(slice.depth.values.size());
  const int across = (slice.depth.width + kBlock - 1) / kBlock, down = (slice.depth.height + kBlock - 1) / kBlock;
  std::mutex mutex;
  std::optional<Error> error;
  parallelFor(jobs, static_cast<size_t>(across) * static_cast<size_t>(down), [&](size_t block) {
    const int left = static_cast<int>(block) % across * kBlock, top = static_cast<int>(block) / across * kBlock;
    const Result<void> read = readBlock(world, level, left, top, slice);
    const std::lock_guard lock(mutex);
    if (!read && !error) error = read.error();
  });
  if (error) return *error;
  lookBeyond(columns, slice);
  return slice;
}

}  // namespace sgm::survey
