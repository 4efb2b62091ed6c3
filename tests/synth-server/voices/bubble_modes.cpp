// SPDX-License-Identifier: MIT
#include "tests/synth-server/voices/bubble_modes.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <numbers>

namespace splash::synth {

void add_alone(const BubbleTone& tone, double frequency, Spectrum& spectrum) {
  spectrum.add(tone.amplitude * tone.amplitude / (4.0 * tone.damping), frequency);
}

/// M y'' + C y' + K y = J delta(t) with y_i = v_i / sqrt(r_i), v_i a bubble's volume over 4 pi;
/// what is heard is the sum of the v_i''. J is such that the bubble alone has its amplitude.
void add_modes(const std::vector<CloudBubble>& bubbles, std::size_t first, Spectrum& spectrum) {
  const auto count = static_cast<Eigen::Index>(bubbles.size());
  const auto at = [&](Eigen::Index i) -> const CloudBubble& {
    return bubbles[static_cast<std::size_t>(i)];
  };
  Eigen::MatrixXd mass = Eigen::MatrixXd::Identity(count, count);
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(count, count);
  Eigen::VectorXd heard(count);
  Eigen::VectorXd damping(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const CloudBubble& a = at(i);
    for (Eigen::Index j = 0; j < i; ++j) {
      const CloudBubble& b = at(j);
      const double square =
          std::pow(a.x - b.x, 2) + std::pow(a.y - b.y, 2) + std::pow(a.z - b.z, 2);
      mass(i, j) = mass(j, i) = 1.0 / std::sqrt(square / (a.radius * b.radius) + 4.0);
    }
    stiffness(i, i) = std::pow(2.0 * std::numbers::pi * a.tone.frequency, 2);
    heard[i] = std::sqrt(a.radius);
    damping[i] = a.tone.damping;
  }
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solved(stiffness, mass);
  for (Eigen::Index k = 0; k < count; ++k) {
    const auto mode = solved.eigenvectors().col(k);
    const double turning = std::sqrt(solved.eigenvalues()[k]);
    const double falls = mode.cwiseProduct(mode).dot(damping);
    for (auto i = static_cast<Eigen::Index>(first); i < count; ++i) {
      const double pushed = at(i).tone.amplitude / (heard[i] * std::sqrt(stiffness(i, i)));
      const double amplitude = heard.dot(mode) * mode[i] * pushed * turning;
      spectrum.add(amplitude * amplitude / (4.0 * falls), turning / (2.0 * std::numbers::pi));
    }
  }
}

}  // namespace splash::synth
