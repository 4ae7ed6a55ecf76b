#pragma once
// The scale of a chart's axis: maps values to places, and chooses its marks.

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace sgm::cli {

struct AxisStyle {
  std::string title;
  bool logarithmic = false;
  bool from_zero = false;  ///< of a linear axis: include 0
  /// Fixed ends; otherwise the ends of the values, widened to the next mark on a linear axis.
  std::optional<double> low, high;
  std::vector<double> marks{};  ///< ascending places of marks, if there is room; empty: round numbers
};

struct Mark {
  double value = 0;
  std::string label;
};

class Axis {
 public:
  /// values: to be included, except those that the axis cannot show (not finite, or not above 0 on a logarithmic axis).
  /// most: maximum of marks, at least 2.
  Axis(const AxisStyle& style, std::span<const double> values, int most);

  bool shows(double value) const;
  /// 0 at its low end to 1 at its high one, clamped. Contract: shows(value).
  double place(double value) const;
  /// Ascending, inside the axis.
  const std::vector<Mark>& marks() const { return marks_; }

 private:
  void markLinear(int most, bool widen_low, bool widen_high);
  void markLogarithmic(int most);

  bool logarithmic_;
  double low_ = 0, high_ = 1;
  std::vector<Mark> marks_;
};

/// A readable number with that many significant digits, without an exponent from a thousandth to ten million.
std::string shortNumber(double value, int digits = 4);

}  // namespace sgm::cli
