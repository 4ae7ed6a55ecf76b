#include "asset/least_squares_solver.h"

#include <algorithm>
#include <cmath>

namespace sgm::asset {

namespace {

/// If all coefficients of a hard constraint are at most this large after elimination by earlier constraints, they are
/// rounding errors of the file's floats: the constraint then depends on the earlier ones. Assumes coefficients of about
/// 1.
constexpr double kNothing = 1e-5;

/// Solves the symmetric, positive semidefinite system a x = b in place, by Cholesky decomposition; b becomes x.
/// Unknowns that the system does not determine become 0.
void solvePositive(std::vector<double>& a, std::vector<double>& b) {
  const size_t n = b.size();
  double largest = 0;
  for (size_t i = 0; i < n; ++i) largest = std::max(largest, a[i * n + i]);
  std::vector<bool> silent(n, false);
  for (size_t i = 0; i < n; ++i) {
    for (size_t j = 0; j <= i; ++j) {
      double sum = a[i * n + j];
      for (size_t k = 0; k < j; ++k) sum -= a[i * n + k] * a[j * n + k];
      if (j < i) {
        a[i * n + j] = silent[j] ? 0 : sum / a[j * n + j];
      } else {
        silent[i] = !(sum > 1e-14 * largest);
        a[i * n + i] = silent[i] ? 1 : std::sqrt(sum);
      }
    }
  }
  for (size_t i = 0; i < n; ++i) {
    for (size_t k = 0; k < i; ++k) b[i] -= a[i * n + k] * b[k];
    b[i] = silent[i] ? 0 : b[i] / a[i * n + i];
  }
  for (size_t i = n; i-- > 0;) {
    for (size_t k = i + 1; k < n; ++k) b[i] -= a[k * n + i] * b[k];
    b[i] = silent[i] ? 0 : b[i] / a[i * n + i];
  }
}

}  // namespace

LeastSquares::LeastSquares(size_t unknowns) : count_(unknowns), squares_(unknowns * unknowns, 0), right_(unknowns, 0) {}

bool LeastSquares::addHardConstraint(const LinearForm& form, double value, double tolerance) {
  Row row{0, std::vector<double>(count_, 0), value};
  for (const auto& [unknown, coefficient] : form) row.coefficients[unknown] += coefficient;
  for (const Row& known : rows_) {
    const double times = row.coefficients[known.pivot];
    if (times == 0) continue;
    for (size_t i = 0; i < count_; ++i) row.coefficients[i] -= times * known.coefficients[i];
    row.coefficients[known.pivot] = 0;
    row.value -= times * known.value;
  }
  for (size_t i = 0; i < count_; ++i)
    if (std::fabs(row.coefficients[i]) > std::fabs(row.coefficients[row.pivot])) row.pivot = i;
  const double most = row.coefficients.empty() ? 0 : row.coefficients[row.pivot];
  if (std::fabs(most) <= kNothing) return std::fabs(row.value) <= tolerance;
  for (double& c : row.coefficients) c /= most;
  row.coefficients[row.pivot] = 1;
  row.value /= most;
  for (Row& known : rows_) {
    const double times = known.coefficients[row.pivot];
    if (times == 0) continue;
    for (size_t i = 0; i < count_; ++i) known.coefficients[i] -= times * row.coefficients[i];
    known.coefficients[row.pivot] = 0;
    known.value -= times * row.value;
  }
  rows_.push_back(std::move(row));
  return true;
}

void LeastSquares::addSoftConstraint(const LinearForm& form, double value, double weight) {
  for (const auto& [i, a] : form) {
    for (const auto& [j, b] : form) squares_[i * count_ + j] += weight * a * b;
    right_[i] += weight * a * value;
  }
}

std::vector<double> LeastSquares::solve() const {
  std::vector<bool> bound(count_, false);
  for (const Row& row : rows_) bound[row.pivot] = true;
  std::vector<size_t> free;
  for (size_t i = 0; i < count_; ++i)
    if (!bound[i]) free.push_back(i);
  // All solutions of the hard constraints have the form x = start + basis * y, where y are the free unknowns.
  const size_t n = free.size();
  std::vector<double> start(count_, 0), basis(count_ * n, 0);
  for (size_t k = 0; k < n; ++k) basis[free[k] * n + k] = 1;
  for (const Row& row : rows_) {
    start[row.pivot] = row.value;
    for (size_t k = 0; k < n; ++k) basis[row.pivot * n + k] = -row.coefficients[free[k]];
  }
  std::vector<double> left(count_ * n, 0), residual = right_, reduced(n * n, 0), y(n, 0);
  for (size_t i = 0; i < count_; ++i)
    for (size_t j = 0; j < count_; ++j) {
      const double square = squares_[i * count_ + j];
      if (square == 0) continue;
      residual[i] -= square * start[j];
      for (size_t k = 0; k < n; ++k) left[i * n + k] += square * basis[j * n + k];
    }
  for (size_t i = 0; i < count_; ++i)
    for (size_t k = 0; k < n; ++k) {
      const double b = basis[i * n + k];
      if (b == 0) continue;
      y[k] += b * residual[i];
      for (size_t l = 0; l <= k; ++l) reduced[k * n + l] += b * left[i * n + l];
    }
  solvePositive(reduced, y);
  std::vector<double> x = start;
  for (size_t i = 0; i < count_; ++i)
    for (size_t k = 0; k < n; ++k) x[i] += basis[i * n + k] * y[k];
  return x;
}

}  // namespace sgm::asset
