// SPDX-License-Identifier: MIT
// Pitches in clouds, closed form against the modes: on the recorded logs, on random clouds, and
// where the modes are known.
#include "synth-server/voices/cloud.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "protocol/event_log.hpp"
#include "synth-server/voices/bubble_tone.hpp"

namespace splash::synth {
namespace {

struct CloudBubble {
  BubbleTone tone;  ///< as it would sound alone
  double radius = 0.0;
  double x = 0.0, y = 0.0, z = 0.0;  ///< [m]
};

/// Powers and their mean frequency.
struct Spectrum {
  double power = 0.0;   ///< energy of the decaying sines [m^2 s]
  double moment = 0.0;  ///< times their frequencies [m^2]
  void add(double energy, double frequency) {
    power += energy;
    moment += energy * frequency;
  }
  [[nodiscard]] double centroid() const { return moment / power; }  ///< [Hz]
};

/// The part of one bubble alone.
void add_alone(const BubbleTone& tone, double frequency, Spectrum& spectrum) {
  spectrum.add(tone.amplitude * tone.amplitude / (4.0 * tone.damping), frequency);
}

/// All modes of the bubbles, of which those from `first` on were set off, each at a time of its
/// own, by their eigenvalue problem in double precision: M y'' + C y' + K y = J delta(t) with y_i =
/// v_i / sqrt(r_i), v_i a bubble's volume over 4 pi; what is heard is the sum of the v_i''. J is
/// such that the bubble alone has its amplitude.
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

constexpr double kRate = 48000.0;
constexpr CloudSound kCoupled{1.0, 0.05};
constexpr double kThirdOfOctave = 1.0 / 3.0;

struct Birth {
  CloudBubble bubble;
  std::int64_t sample = 0;
};

CloudBubble bubble_at(double radius, double epsilon, double x, double y, double z) {
  return {bubble_tone({}, radius, epsilon, 0.0), radius, x, y, z};
}

protocol::Vec3 place_of(const CloudBubble& b) {
  return {static_cast<float>(b.x), static_cast<float>(b.y), static_cast<float>(b.z)};
}

double enter(Cloud& cloud, const CloudBubble& b, std::int64_t sample,
             const CloudSound& sound = kCoupled) {
  return cloud.enter(sound, place_of(b), b.radius, b.tone.frequency, sample);
}

double octaves(double a, double b) {
  return std::log2(a / b);
}

std::vector<Birth> recorded(const std::string& name) {
  std::vector<Birth> births;
  const auto path = std::filesystem::path(SPLASH_SOURCE_DIR) / "tests/data" / (name + ".osc");
  for (const protocol::LogEntry& entry : protocol::read_log(path)) {
    for (const protocol::Message& message : entry.messages) {
      const auto event = protocol::to_event(message);
      if (!event || !protocol::is_bubble(*event)) continue;
      const auto& b = std::get<protocol::Bubble>(*event);
      const double seconds = entry.seconds + 1e-3 * static_cast<double>(b.offset_ms);
      births.push_back(
          {bubble_at(static_cast<double>(b.radius), static_cast<double>(b.epsilon),
                     static_cast<double>(b.position.x), static_cast<double>(b.position.y),
                     static_cast<double>(b.position.z)),
           std::llround(seconds * kRate)});
    }
  }
  std::stable_sort(births.begin(), births.end(),
                   [](const Birth& a, const Birth& b) { return a.sample < b.sample; });
  return births;
}

class RecordedClouds : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Scenes, RecordedClouds,
                         testing::Values("basin", "beach", "plunge", "pool"));

/// Every birth among those of the 50 ms before; of a flood every third, for the time it takes.
TEST_P(RecordedClouds, ComeDownAsTheirModesDo) {
  const std::vector<Birth> births = recorded(GetParam());
  const auto span = static_cast<std::int64_t>(kCoupled.company * kRate);
  const std::size_t every = births.size() > 500 ? 3 : 1;
  Cloud cloud(kRate);
  Spectrum alone;
  Spectrum closed;
  Spectrum modes;
  std::size_t most = 0;
  for (std::size_t i = 0; i < births.size(); ++i) {
    const Birth& birth = births[i];
    const double part = enter(cloud, birth.bubble, birth.sample);
    if (i % every != 0) continue;
    add_alone(birth.bubble.tone, birth.bubble.tone.frequency, alone);
    add_alone(birth.bubble.tone, part * birth.bubble.tone.frequency, closed);
    std::vector<CloudBubble> around;
    for (std::size_t j = 0; j < i; ++j) {
      if (birth.sample - births[j].sample <= span) around.push_back(births[j].bubble);
    }
    around.push_back(birth.bubble);
    most = std::max(most, around.size());
    add_modes(around, around.size() - 1, modes);
  }
  std::printf("%s: up to %zu bubbles; centroid alone %.0f Hz, modes %.0f Hz, closed form %.0f Hz\n",
              GetParam(), most, alone.centroid(), modes.centroid(), closed.centroid());
  EXPECT_LT(modes.centroid(), 0.9 * alone.centroid()) << "no cloud to speak of";
  EXPECT_LT(std::abs(octaves(closed.centroid(), modes.centroid())), kThirdOfOctave);
}

struct Ball {
  double size = 0.0;     ///< radius [m]
  double largest = 0.0;  ///< bubble [m]
};

std::vector<CloudBubble> random_cloud(const Ball& ball, int count, std::mt19937_64& random) {
  std::uniform_real_distribution<double> draw(0.0, 1.0);
  std::vector<CloudBubble> bubbles;
  while (static_cast<int>(bubbles.size()) < count) {
    const double x = 2.0 * draw(random) - 1.0;
    const double y = 2.0 * draw(random) - 1.0;
    const double z = 2.0 * draw(random) - 1.0;
    if (x * x + y * y + z * z > 1.0) continue;
    const double u = draw(random);  // r^-3 from 3 mm to the largest
    const double radius =
        1.0 / std::sqrt((1.0 - u) / (0.003 * 0.003) + u / (ball.largest * ball.largest));
    bubbles.push_back(bubble_at(radius, 0.01 * std::pow(10.0, draw(random)), x * ball.size,
                                y * ball.size, z * ball.size));
  }
  return bubbles;
}

class RandomClouds : public testing::TestWithParam<Ball> {};
INSTANTIATE_TEST_SUITE_P(Sizes, RandomClouds,
                         testing::Values(Ball{0.08, 0.03}, Ball{0.08, 0.006}, Ball{0.16, 0.03},
                                         Ball{0.16, 0.006}, Ball{0.32, 0.03}, Ball{0.32, 0.006}));

/// The denser, the darker, and as dark as the modes.
TEST_P(RandomClouds, ComeDownWithTheirDensityAsTheirModesDo) {
  std::mt19937_64 random(1);
  double last = 1e9;
  for (const int count : {4, 16, 64, 160}) {
    Spectrum alone;
    Spectrum closed;
    Spectrum modes;
    for (int again = 0; again < 2560 / count; ++again) {
      std::vector<CloudBubble> cloud = random_cloud(GetParam(), count, random);
      add_modes(cloud, 0, modes);
      for (std::size_t k = 0; k < cloud.size(); ++k) {  // each in turn is the last one born
        std::swap(cloud[k], cloud.back());
        Cloud closed_form(kRate);
        double part = 1.0;
        for (const CloudBubble& b : cloud) part = enter(closed_form, b, 0);
        const BubbleTone& tone = cloud.back().tone;
        add_alone(tone, tone.frequency, alone);
        add_alone(tone, part * tone.frequency, closed);
      }
    }
    const double off = octaves(closed.centroid(), modes.centroid());
    const double down = octaves(closed.centroid(), alone.centroid());
    std::printf("%3d bubbles: %.2f octaves down, modes %.2f\n", count, down, down - off);
    EXPECT_LT(std::abs(off), kThirdOfOctave) << count;
    EXPECT_LT(down, last) << count;
    last = down;
  }
}

TEST(Cloud, OfTwoEqualBubblesSoundsInThePitchOfTheirCommonMode) {
  const CloudBubble b = bubble_at(0.005, 0.05, 0.0, 0.0, 0.0);
  for (const double apart : {0.01, 0.03, 0.1, 1.0}) {
    const CloudBubble other = bubble_at(0.005, 0.05, apart, 0.0, 0.0);
    Cloud cloud(kRate);
    enter(cloud, b, 0);
    const double mode = 1.0 / std::sqrt(1.0 + 1.0 / std::sqrt(std::pow(apart / 0.005, 2) + 4.0));
    EXPECT_NEAR(enter(cloud, other, 0) / mode, 1.0, 0.01) << apart;
  }
}

TEST(Cloud, LeavesALonelyBubbleAlone) {
  Cloud cloud(kRate);
  const CloudBubble b = bubble_at(0.005, 0.05, 0.0, 0.0, 0.0);
  EXPECT_EQ(enter(cloud, b, 100), 1.0);
  const auto later = static_cast<std::int64_t>(kCoupled.company * kRate);
  EXPECT_LT(enter(cloud, b, 100 + later), 1.0);
  Cloud parted(kRate);
  enter(parted, b, 100);
  EXPECT_EQ(enter(parted, b, 101 + later), 1.0) << "the other one is gone";
}

TEST(Cloud, IsNoneWhereTheSoundHasNoCoupling) {
  Cloud cloud(kRate);
  const CloudBubble b = bubble_at(0.005, 0.05, 0.0, 0.0, 0.0);
  for (int i = 0; i < 20; ++i) EXPECT_EQ(enter(cloud, b, i, CloudSound{}), 1.0);
}

/// However many come, old ones make room, and the sum is that of the youngest.
TEST(Cloud, CountsTheYoungestWhenThereAreTooMany) {
  const auto count = static_cast<int>(Cloud::kMost);
  std::mt19937_64 random(3);
  const std::vector<CloudBubble> all = random_cloud({0.5, 0.03}, 2 * count + 100, random);
  Cloud cloud(kRate);
  double part = 0.0;
  for (const CloudBubble& b : all) part = enter(cloud, b, 0);
  double sum = 0.0;
  const CloudBubble& last = all.back();
  for (auto b = all.end() - 1 - count; b != all.end() - 1; ++b) {
    const protocol::Vec3 p = place_of(*b);
    const protocol::Vec3 q = place_of(last);
    const double square = std::pow(static_cast<double>(p.x) - static_cast<double>(q.x), 2) +
                          std::pow(static_cast<double>(p.y) - static_cast<double>(q.y), 2) +
                          std::pow(static_cast<double>(p.z) - static_cast<double>(q.z), 2);
    sum += b->radius * std::min(1.0, std::pow(b->tone.frequency / last.tone.frequency, 2)) /
           std::sqrt(square + 4.0 * b->radius * last.radius);
  }
  EXPECT_NEAR(part / lowered(sum), 1.0, 2e-6) << "in single precision";
}

}  // namespace
}  // namespace splash::synth
