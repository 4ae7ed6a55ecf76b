#pragma once
// One axis of a chart: maps values to positions, and chooses tick marks.

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace sgm::cli {

struct AxisStyle {
  std::string title;
  bool logarithmic = false;
  bool from_zero = false;  ///< linear axis only: the axis includes 0
  /// Ends of the axis. nullopt: the smallest or largest shown value; on a linear axis, this value is extended to the
  /// next tick.
  std::optional<double> low, high;
  /// Preferred tick values, in ascending order; some are skipped if there is not enough room. Empty: round numbers are
  /// chosen.
  std::vector<double> marks{};
};

struct Mark {
  double value = 0;
  std::string label;
};

class Axis {
 public:
  /// values: the values to show. The axis covers all of them except those that it cannot show (not finite, or not above
  /// 0 on a logarithmic axis). most: maximum number of ticks, at least 2.
  Axis(const AxisStyle& style, std::span<const double> values, int most);

  bool shows(double value) const;
  /// Position of a value, from 0 at the low end of the axis to 1 at its high end; clamped to this range. Contract:
  /// shows(value).
  double place(double value) const;
  /// All ticks, in ascending order of their values.
  const std::vector<Mark>& marks() const { return marks_; }

 private:
  void markLinear(int most, bool widen_low, bool widen_high);
  void markLogarithmic(int most);

  bool logarithmic_;
  double low_ = 0, high_ = 1;
  std::vector<Mark> marks_;
};

/// Formats a number readably, with about `digits` significant digits. Magnitudes from 1e-3 to below 1e7 are written
/// without an exponent.
std::string shortNumber(double value, int digits = 4);

}  // namespace sgm::cli
