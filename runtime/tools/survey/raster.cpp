#include "tools/survey/raster.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace sgm::survey {
namespace {

constexpr int kScans = 4;  // scan lines per row of pixels in filled areas

/// The share of each pixel, 0..1, that a mark covers, in a rectangle of the picture.
struct Coverage {
  int left = 0, top = 0, width = 0, height = 0;
  std::vector<float> values;

  float& at(int x, int y) {
    return values[static_cast<size_t>(y - top) * static_cast<size_t>(width) + static_cast<size_t>(x - left)];
  }
};

/// A zero-filled Coverage for the bounding rectangle of all lines plus a margin, clipped to the picture.
Coverage roomFor(const Image& image, const std::vector<Line>& lines, double margin) {
  double x0 = 1e9, y0 = 1e9, x1 = -1e9, y1 = -1e9;
  for (const Line& line : lines) {
    for (const Point& p : line) {
      x0 = std::min(x0, p.x), x1 = std::max(x1, p.x);
      y0 = std::min(y0, p.y), y1 = std::max(y1, p.y);
    }
  }
  const auto clipped = [](double value, int most) { return static_cast<int>(std::clamp<double>(value, 0, most)); };
  Coverage room;
  room.left = clipped(std::floor(x0 - margin), image.width);
  room.top = clipped(std::floor(y0 - margin), image.height);
  room.width = clipped(std::ceil(x1 + margin), image.width) - room.left;
  room.height = clipped(std::ceil(y1 + margin), image.height) - room.top;
  if (room.width <= 0 || room.height <= 0) return {};
  room.values.assign(static_cast<size_t>(room.width) * static_cast<size_t>(room.height), 0);
  return room;
}

/// Covers the pixels of a line segment drawn with a round pen. The distance of a pixel's centre from the segment
/// determines the covered share.
void cover(Coverage& room, Point a, Point b, double width) {
  const double reach = width / 2 + 0.5, dx = b.x - a.x, dy = b.y - a.y, square = dx * dx + dy * dy;
  const int x0 = std::max(room.left, static_cast<int>(std::floor(std::min(a.x, b.x) - reach)));
  const int x1 = std::min(room.left + room.width - 1, static_cast<int>(std::floor(std::max(a.x, b.x) + reach)));
  const int y0 = std::max(room.top, static_cast<int>(std::floor(std::min(a.y, b.y) - reach)));
  const int y1 = std::min(room.top + room.height - 1, static_cast<int>(std::floor(std::max(a.y, b.y) + reach)));
  for (int y = y0; y <= y1; ++y) {
    for (int x = x0; x <= x1; ++x) {
      const double px = x + 0.5 - a.x, py = y + 0.5 - a.y;
      const double along = square > 0 ? std::clamp((px * dx + py * dy) / square, 0.0, 1.0) : 0;
      const double ox = px - along * dx, oy = py - along * dy;
      const double covered = std::clamp(reach - std::sqrt(ox * ox + oy * oy), 0.0, std::min(1.0, width));
      float& value = room.at(x, y);
      value = std::max(value, static_cast<float>(covered));
    }
  }
}

void coverLines(Coverage& room, const Mark& mark) {
  for (const Line& whole : mark.lines) {
    for (const Line& line : dashed(whole, mark.dashes)) {
      if (line.size() == 1) cover(room, line[0], line[0], mark.width);
      for (size_t i = 1; i < line.size(); ++i) cover(room, line[i - 1], line[i], mark.width);
    }
  }
}

/// Covers areas by the even-odd rule: on each scan line, the spans from the first to the second crossing, from the
/// third to the fourth, and so on.
void coverAreas(Coverage& room, const Mark& mark) {
  std::vector<double> crossings;
  for (int scan = room.top * kScans; scan < (room.top + room.height) * kScans; ++scan) {
    const double y = (scan + 0.5) / kScans;
    crossings.clear();
    for (const Line& ring : mark.lines) {
      for (size_t i = 0; i < ring.size(); ++i) {
        const Point &a = ring[i], &b = ring[i + 1 < ring.size() ? i + 1 : 0];
        if ((a.y <= y) != (b.y <= y)) crossings.push_back(a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x));
      }
    }
    std::ranges::sort(crossings);
    for (size_t i = 0; i + 1 < crossings.size(); i += 2) {
      const double from = std::max<double>(crossings[i], room.left),
                   to = std::min<double>(crossings[i + 1], room.left + room.width);
      for (int x = static_cast<int>(std::floor(from)); x < to; ++x) {
        const double part = std::min<double>(to, x + 1) - std::max<double>(from, x);
        if (part > 0) room.at(x, scan / kScans) += static_cast<float>(part / kScans);
      }
    }
  }
}

void drawMark(Image& image, const Mark& mark) {
  Coverage room = roomFor(image, mark.lines, mark.filled ? 1 : mark.width / 2 + 1);
  if (room.values.empty()) return;
  mark.filled ? coverAreas(room, mark) : coverLines(room, mark);
  const std::array<uint8_t, 3> ink{mark.ink.r, mark.ink.g, mark.ink.b};
  for (int y = room.top; y < room.top + room.height; ++y) {
    for (int x = room.left; x < room.left + room.width; ++x) {
      const float covered = std::min(room.at(x, y), 1.0f);
      if (covered <= 0) continue;
      uint8_t* pixel =
          &image.rgba[4 * (static_cast<size_t>(y) * static_cast<size_t>(image.width) + static_cast<size_t>(x))];
      for (size_t i = 0; i < ink.size(); ++i) {
        const float below = pixel[i], over = ink[i];
        pixel[i] = static_cast<uint8_t>(std::lround(below + covered * (over - below)));
      }
    }
  }
}

}  // namespace

std::vector<Line> dashed(const Line& line, const std::vector<double>& dashes) {
  if (dashes.empty() || line.size() < 2) return {line};
  std::vector<Line> parts;
  size_t turn = 0;
  double left = dashes[0];
  Line part{line[0]};
  for (size_t i = 1; i < line.size(); ++i) {
    Point from = line[i - 1];
    const Point to = line[i];
    double length = std::hypot(to.x - from.x, to.y - from.y);
    while (length > left) {
      const double share = left / length;
      from = {from.x + share * (to.x - from.x), from.y + share * (to.y - from.y)};
      length -= left;
      if (turn % 2 == 0) {
        part.push_back(from);
        parts.push_back(std::move(part));
      }
      part = {from};
      left = dashes[++turn % dashes.size()];
    }
    left -= length;
    part.push_back(to);
  }
  if (turn % 2 == 0) parts.push_back(std::move(part));
  return parts;
}

void drawOnto(Image& image, const std::vector<Mark>& marks) {
  for (const Mark& mark : marks) drawMark(image, mark);
}

Image rasterise(const Drawing& drawing) {
  Image image{drawing.width, drawing.height, {}};
  image.rgba.assign(size_t{4} * static_cast<size_t>(drawing.width) * static_cast<size_t>(drawing.height), 255);
  drawOnto(image, drawing.marks);
  return image;
}

}  // namespace sgm::survey
