// SPDX-License-Identifier: MIT
// Eigenvectors and equations of small symmetric matrices: against their definitions.
#include "sim-server/scene/symmetric_matrix.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace splash::sim {
namespace {

constexpr double kRounding = 64.0 * std::numeric_limits<double>::epsilon();

template <std::size_t N>
double product(const std::array<double, N>& a, const std::array<double, N>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < N; ++i) sum += a[i] * b[i];
  return sum;
}

template <std::size_t N>
double largest(const Matrix<N>& m) {
  double most = 0.0;
  for (const auto& row : m) {
    for (const double value : row) most = std::max(most, std::abs(value));
  }
  return most;
}

/// m v = lambda v for each pair, and the vectors are orthonormal.
template <std::size_t N>
void expect_solved(const Matrix<N>& m) {
  const auto [values, vectors] = eigensystem(m);
  for (std::size_t i = 0; i < N; ++i) {
    for (std::size_t row = 0; row < N; ++row) {
      EXPECT_NEAR(product(m[row], vectors[i]), values[i] * vectors[i][row], kRounding * largest(m));
    }
    for (std::size_t j = 0; j < N; ++j) {
      EXPECT_NEAR(product(vectors[i], vectors[j]), i == j ? 1.0 : 0.0, kRounding);
    }
  }
}

template <std::size_t N>
Matrix<N> random_matrix(std::mt19937& random, double scale) {
  std::normal_distribution<double> normal(0.0, scale);
  Matrix<N> m = {};
  for (std::size_t i = 0; i < N; ++i) {
    for (std::size_t j = 0; j <= i; ++j) m[i][j] = m[j][i] = normal(random);
  }
  return m;
}

TEST(SymmetricMatrix, HasItsEigenvectors) {
  std::mt19937 random(1);
  for (const double scale : {1e-12, 1.0, 1e6}) {
    for (int i = 0; i < 200; ++i) {
      expect_solved(random_matrix<3>(random, scale));
      expect_solved(random_matrix<4>(random, scale));
    }
  }
}

TEST(SymmetricMatrix, HasEigenvectorsWhereValuesAreAlike) {
  expect_solved(Matrix<4>{});
  expect_solved(identity<4>());
  expect_solved(Matrix<3>{{{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}});
  expect_solved(Matrix<4>{{{0, 1, 0, 0}, {1, 0, 0, 0}, {0, 0, 0, 1e-300}, {0, 0, 1e-300, 0}}});
  auto values = eigensystem(Matrix<3>{{{2, 0, 0}, {0, 3, 4}, {0, 4, 9}}}).values;
  std::sort(values.begin(), values.end());
  EXPECT_NEAR(values[0], 1.0, kRounding);
  EXPECT_NEAR(values[1], 2.0, kRounding);
  EXPECT_NEAR(values[2], 11.0, 11.0 * kRounding);
}

TEST(SymmetricMatrix, SolvesItsEquations) {
  std::mt19937 random(2);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 200; ++trial) {
    const Matrix<3> root = random_matrix<3>(random, 1.0);
    Matrix<3> m = identity<3>();
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) m[i][j] += product(root[i], root[j]);
    }
    const std::array<double, 3> wanted = {normal(random), normal(random), normal(random)};
    std::array<double, 3> right = {};
    for (std::size_t i = 0; i < 3; ++i) right[i] = product(m[i], wanted);
    const auto found = solve(m, right);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(found[i], wanted[i], 1e-13);
  }
}

}  // namespace
}  // namespace splash::sim
