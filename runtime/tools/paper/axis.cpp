#include "tools/paper/axis.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace sgm::cli {
namespace {

/// Values of larger magnitude are not shown, because differences between them could overflow.
constexpr double kFarthest = 1e150;
constexpr double kLeast = 1e-150;

/// The smallest number that is at least `least` and equals 1, 2 or 5 times a power of ten.
double niceStep(double least) {
  const double power = std::pow(10, std::floor(std::log10(least)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= least) return factor * power;
  return 10 * power;
}

}  // namespace

std::string shortNumber(double value, int digits) {
  if (!std::isfinite(value)) return "-";
  const double size = std::abs(value);
  if (size != 0 && (size < 1e-3 || size >= 1e7)) return fmt::format("{:.{}g}", value, digits);
  const int before = size < 1 ? 1 : static_cast<int>(std::floor(std::log10(size))) + 1;
  const int leading = size != 0 && size < 1 ? static_cast<int>(-std::floor(std::log10(size))) - 1 : 0;
  const int after = std::max(0, digits - (size < 1 ? 0 : before) + leading);
  std::string text = fmt::format("{:.{}f}", value, after);
  if (text.find('.') != std::string::npos) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
  }
  return text == "-0" ? "0" : text;
}

Axis::Axis(const AxisStyle& style, std::span<const double> values, int most) : logarithmic_(style.logarithmic) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const double value : values) {
    if (!shows(value)) continue;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  if (style.low && shows(*style.low)) low = *style.low;
  if (style.high && shows(*style.high)) high = *style.high;
  if (low > high) low = high = logarithmic_ ? 1 : 0;
  if (!logarithmic_ && style.from_zero) {
    low = std::min(low, 0.0);
    high = std::max(high, 0.0);
  }
  // Widen the axis if it has no length, or is too short for the precision of its numbers.
  const double size = std::max(std::abs(low), std::abs(high));
  if (logarithmic_ && high < low * 1.001) {
    low /= 2;
    high *= 2;
  } else if (!logarithmic_ && high - low < 1e-9 * size + kLeast) {
    low -= size < kLeast ? 1 : size / 2;
    high += size < kLeast ? 1 : size / 2;
  }
  low_ = low;
  high_ = high;
  if (!style.marks.empty()) {
    const size_t every = (style.marks.size() - 1) / static_cast<size_t>(std::max(most, 2)) + 1;
    for (size_t i = 0; i < style.marks.size(); i += every) {
      const double value = style.marks[i];
      if (shows(value) && value >= low_ && value <= high_) marks_.push_back({value, shortNumber(value)});
    }
  } else if (logarithmic_) {
    markLogarithmic(std::max(most, 2));
  } else {
    markLinear(std::max(most, 2), !style.low, !style.high);
  }
}

void Axis::markLinear(int most, bool widen_low, bool widen_high) {
  // If the ends are extended to whole steps, there may be one tick more than fits. Then the next larger step is used.
  double step = niceStep((high_ - low_) / most);
  const auto first = [&] { return std::floor(low_ / step + 1e-9); };
  const auto last = [&] { return std::ceil(high_ / step - 1e-9); };
  while (last() - first() > most) step = niceStep(step * 1.5);
  if (widen_low) low_ = first() * step;
  if (widen_high) high_ = last() * step;
  for (double i = first(); i <= last(); ++i) {
    const double value = i * step;
    if (value < low_ - 1e-9 * step || value > high_ + 1e-9 * step) continue;
    marks_.push_back({std::clamp(value, low_, high_), shortNumber(value, 12)});
  }
}

void Axis::markLogarithmic(int most) {
  const double first = std::floor(std::log10(low_)), last = std::ceil(std::log10(high_));
  const auto markAt = [&](std::span<const double> factors, double every) {
    marks_.clear();
    for (double power = first; power <= last; power += every) {
      for (const double factor : factors) {
        const double value = factor * std::pow(10, power);
        if (value >= low_ * (1 - 1e-12) && value <= high_ * (1 + 1e-12))
          marks_.push_back({std::clamp(value, low_, high_), shortNumber(value, 4)});
      }
    }
  };
  static constexpr double kAll[] = {1, 2, 3, 4, 5, 6, 7, 8, 9}, kSome[] = {1, 2, 5}, kOne[] = {1};
  markAt(kSome, 1);
  if (marks_.size() < 2) markAt(kAll, 1);
  if (marks_.size() > static_cast<size_t>(most)) markAt(kOne, 1);
  for (double every = 2; marks_.size() > static_cast<size_t>(most); ++every) markAt(kOne, every);
  if (marks_.size() < 2) marks_ = {{low_, shortNumber(low_)}, {high_, shortNumber(high_)}};
}

bool Axis::shows(double value) const {
  if (!std::isfinite(value) || std::abs(value) > kFarthest) return false;
  return !logarithmic_ || value >= kLeast;
}

double Axis::place(double value) const {
  const double part = logarithmic_ ? std::log(value / low_) / std::log(high_ / low_) : (value - low_) / (high_ - low_);
  return std::clamp(part, 0.0, 1.0);
}

}  // namespace sgm::cli
