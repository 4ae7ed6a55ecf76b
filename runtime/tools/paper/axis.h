#pragma once
// The scale of one axis of a chart: how values become places along it, and where its marks stand.

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace sgm::cli {

struct AxisStyle {
  std::string title;
  bool logarithmic = false;
  bool from_zero = false;  ///< of a linear axis: 0 belongs to it
  /// Ends that are kept to; without them the values' own, which are widened to the next mark where it is linear.
  std::optional<double> low, high;
  std::vector<double> marks{};  ///< where marks stand, rising, as far as there is room; none: at round numbers
};

struct Mark {
  double value = 0;
  std::string label;
};

class Axis {
 public:
  /// values: that it must hold; those that it cannot show (not finite, or on a logarithmic axis not above 0) do not
  /// count. most: marks that there is room for, at least 2.
  Axis(const AxisStyle& style, std::span<const double> values, int most);

  bool shows(double value) const;
  /// 0 at its low end to 1 at its high one; of what lies beyond the nearer end. Contract: shows(value).
  double place(double value) const;
  /// Rising, inside the axis.
  const std::vector<Mark>& marks() const { return marks_; }

 private:
  void markLinear(int most, bool widen_low, bool widen_high);
  void markLogarithmic(int most);

  bool logarithmic_;
  double low_ = 0, high_ = 1;
  std::vector<Mark> marks_;
};

/// A number as a reader likes it: so many digits that count, no exponent from a thousandth to ten million.
std::string shortNumber(double value, int digits = 4);

}  // namespace sgm::cli
