#pragma once
// The numbers nearest to what many linear wishes say, among those that linear demands allow. Dense, in a fixed order,
// by
// + - * / and sqrt alone: the same bits on every machine.

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace sgm::asset {

/// Coefficients by unknown, few of which are not 0.
using LinearForm = std::vector<std::pair<size_t, double>>;

class LeastSquares {
 public:
  explicit LeastSquares(size_t unknowns);

  /// form = value exactly. False where that contradicts what has been demanded before, by more than `tolerance`.
  bool demand(const LinearForm& form, double value, double tolerance);
  /// weight * (form - value)^2 is to be small.
  void wish(const LinearForm& form, double value, double weight);
  /// The unknowns; those that nothing is said about are 0.
  std::vector<double> solve() const;

 private:
  struct Row {
    size_t pivot = 0;
    std::vector<double> coefficients;  ///< 1 at the pivot, 0 at those of other rows
    double value = 0;
  };

  size_t count_;
  std::vector<Row> rows_;
  std::vector<double> squares_;  ///< of the wishes: count_ x count_
  std::vector<double> right_;
};

}  // namespace sgm::asset
