// SPDX-License-Identifier: MIT
// Small symmetric matrices: their eigenvectors by Jacobi's rotations, and systems of equations.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace splash::sim {

template <std::size_t N>
using Matrix = std::array<std::array<double, N>, N>;  ///< rows

template <std::size_t N>
[[nodiscard]] constexpr Matrix<N> identity() noexcept {
  Matrix<N> matrix = {};
  for (std::size_t i = 0; i < N; ++i) matrix[i][i] = 1.0;
  return matrix;
}

template <std::size_t N>
struct Eigensystem {
  std::array<double, N> values = {};
  Matrix<N> vectors = {};  ///< of unit length, one a row; right-handed
};

/// Turns the axes p and q of a symmetric matrix so that it has nothing between them.
template <std::size_t N>
void rotate_pair(Matrix<N>& m, Matrix<N>& axes, std::size_t p, std::size_t q) noexcept {
  if (m[p][q] == 0.0) return;
  const double part = (m[q][q] - m[p][p]) / (2.0 * m[p][q]);
  const double tangent = (part < 0.0 ? -1.0 : 1.0) / (std::abs(part) + std::hypot(part, 1.0));
  const double c = 1.0 / std::hypot(tangent, 1.0);
  const double s = tangent * c;
  for (std::size_t k = 0; k < N; ++k) {
    const double left = m[k][p];
    m[k][p] = c * left - s * m[k][q];
    m[k][q] = s * left + c * m[k][q];
  }
  for (std::size_t k = 0; k < N; ++k) {
    const double left = m[p][k];
    m[p][k] = c * left - s * m[q][k];
    m[q][k] = s * left + c * m[q][k];
    const double row = axes[p][k];
    axes[p][k] = c * row - s * axes[q][k];
    axes[q][k] = s * row + c * axes[q][k];
  }
}

/// Of a symmetric matrix, in no order (cyclic Jacobi; Golub and Van Loan, section 8.5).
template <std::size_t N>
[[nodiscard]] Eigensystem<N> eigensystem(Matrix<N> m) noexcept {
  constexpr int kSweeps = 12;  // each squares what is left; five are enough for doubles
  Eigensystem<N> found;
  found.vectors = identity<N>();
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (std::size_t p = 0; p < N; ++p) {
      for (std::size_t q = p + 1; q < N; ++q) rotate_pair(m, found.vectors, p, q);
    }
  }
  for (std::size_t i = 0; i < N; ++i) found.values[i] = m[i][i];
  return found;
}

/// The x of m x = b for a symmetric, positive definite m, whose lower half is read (m = L D L^T).
template <std::size_t N>
[[nodiscard]] std::array<double, N> solve(Matrix<N> m, std::array<double, N> b) noexcept {
  // Below the diagonal m becomes L; D stays on the diagonal.
  for (std::size_t j = 0; j < N; ++j) {
    for (std::size_t i = j + 1; i < N; ++i) {
      const double factor = m[i][j] / m[j][j];
      for (std::size_t k = j + 1; k <= i; ++k) m[i][k] -= factor * m[k][j];
    }
    for (std::size_t i = j + 1; i < N; ++i) {
      m[i][j] /= m[j][j];
      b[i] -= m[i][j] * b[j];
    }
  }
  for (std::size_t i = N; i-- > 0;) {
    b[i] /= m[i][i];
    for (std::size_t k = i + 1; k < N; ++k) b[i] -= m[k][i] * b[k];
  }
  return b;
}

}  // namespace splash::sim
