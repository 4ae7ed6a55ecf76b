#pragma once
// The scale of a chart's axis: maps values to positions on the axis, and chooses its tick marks.

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace sgm::cli {

struct AxisStyle {
  std::string title;
  bool logarithmic = false;
  bool from_zero = false;  ///< for a linear axis: includes 0
  /// Ends of the axis. Without a value, the smallest and largest shown value, widened to the next tick on a linear
  /// axis.
  std::optional<double> low, high;
  /// Values of ticks, ascending, used if there is room for them; empty: round numbers are chosen.
  std::vector<double> marks{};
};

struct Mark {
  double value = 0;
  std::string label;
};

class Axis {
 public:
  /// values: the axis includes them, except those that it cannot show (not finite, or not above 0 on a logarithmic
  /// axis). most: maximum number of ticks, at least 2.
  Axis(const AxisStyle& style, std::span<const double> values, int most);

  bool shows(double value) const;
  /// Position of a value: 0 at the low end of the axis to 1 at its high end, clamped. Contract: shows(value).
  double place(double value) const;
  /// Ticks in ascending order, inside the axis.
  const std::vector<Mark>& marks() const { return marks_; }

 private:
  void markLinear(int most, bool widen_low, bool widen_high);
  void markLogarithmic(int most);

  bool logarithmic_;
  double low_ = 0, high_ = 1;
  std::vector<Mark> marks_;
};

/// A readable number with that many significant digits. It has no exponent between a thousandth and ten million.
std::string shortNumber(double value, int digits = 4);

}  // namespace sgm::cli
