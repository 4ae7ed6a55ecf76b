#pragma once
// Linear least squares with soft constraints (wishes), subject to hard linear constraints (demands). Dense, in a fixed
// order, by + - * / and sqrt alone: the same bits on every machine.

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace sgm::asset {

/// Pairs of an unknown and its coefficient; all other coefficients are 0.
using LinearForm = std::vector<std::pair<size_t, double>>;

class LeastSquares {
 public:
  explicit LeastSquares(size_t unknowns);

  /// Adds the hard constraint form = value. False if it contradicts earlier ones by more than `tolerance`.
  bool demand(const LinearForm& form, double value, double tolerance);
  /// Adds the soft constraint weight * (form - value)^2.
  void wish(const LinearForm& form, double value, double weight);
  /// Returns the unknowns; unconstrained ones are 0.
  std::vector<double> solve() const;

 private:
  struct Row {
    size_t pivot = 0;
    std::vector<double> coefficients;  ///< 1 at the pivot, 0 at those of other rows
    double value = 0;
  };

  size_t count_;
  std::vector<Row> rows_;
  std::vector<double> squares_;  ///< normal matrix of the wishes: count_ x count_
  std::vector<double> right_;
};

}  // namespace sgm::asset
