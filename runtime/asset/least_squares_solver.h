#pragma once
// Linear least squares with soft constraints, subject to hard linear constraints. It uses dense matrices, a fixed order
// of operations, and + - * / and sqrt alone, so that every machine computes the same bits.

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace sgm::asset {

/// A linear combination of unknowns: pairs (index of the unknown, coefficient). All other coefficients are 0.
using LinearForm = std::vector<std::pair<size_t, double>>;

class LeastSquares {
 public:
  explicit LeastSquares(size_t unknowns);

  /// Adds the hard constraint form = value. Returns false if it contradicts earlier ones by more than `tolerance`.
  bool addHardConstraint(const LinearForm& form, double value, double tolerance);
  /// Adds the soft constraint weight * (form - value)^2.
  void addSoftConstraint(const LinearForm& form, double value, double weight);
  /// Returns the values of the unknowns; the value is 0 for an unknown that no constraint determines.
  std::vector<double> solve() const;

 private:
  struct Row {
    size_t pivot = 0;
    /// coefficient of each unknown: 1 at the row's pivot, 0 at the pivots of other rows
    std::vector<double> coefficients;
    double value = 0;
  };

  size_t count_;
  std::vector<Row> rows_;
  std::vector<double> squares_;  ///< normal matrix of the soft constraints, with count_ rows and columns
  std::vector<double> right_;
};

}  // namespace sgm::asset
