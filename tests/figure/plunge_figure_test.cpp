// SPDX-License-Identifier: MIT
#include "synth-server/figure/plunge_figure.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "synth-server/figure/gnuplot.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text_of.hpp"

namespace splash::synth {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;
using ::testing::ThrowsMessage;

Components decaying_sines() {
  Components components{8000.0, 0.0, 1, {}, {}, {}};
  for (int i = 0; i < 8000; ++i) {
    const double t = i / 8000.0;
    components.impact.push_back(static_cast<float>(std::exp(-20.0 * t) * std::sin(2000.0 * t)));
    components.bubble.push_back(static_cast<float>(0.2 * std::sin(4000.0 * t)));
    components.cavity.push_back(static_cast<float>(0.4 * std::sin(200.0 * t)));
  }
  return components;
}

TEST(PlungeFigure, DrawsAPngOfTheStatedSize) {
  const tests::TemporaryFolder folder;
  FigureSettings settings;
  settings.title = "a \"quoted\" title with a \\backslash";
  draw_plunge(decaying_sines(), settings, folder / "a.png");
  const std::string bytes = tests::text_of(folder / "a.png");
  EXPECT_THAT(bytes, StartsWith("\x89PNG"));
  ASSERT_GT(bytes.size(), 20000U);  // an empty frame is smaller
  EXPECT_EQ(bytes.substr(16, 8), std::string("\0\0\x05\xDC\0\0\x04\x24", 8));  // 1500 x 1060
}

TEST(PlungeFigure, SilenceIsDrawnToo) {
  const tests::TemporaryFolder folder;
  const std::vector<float> silence(4000, 0.0F);
  draw_plunge({8000.0, 0.0, 1, silence, silence, silence}, {}, folder / "a.png");
  EXPECT_THAT(tests::text_of(folder / "a.png"), StartsWith("\x89PNG"));
}

TEST(PlungeFigure, SaysThatThePictureCannotBeWritten) {
  EXPECT_THROW(draw_plunge(decaying_sines(), {}, "/nonexistent/folder/a.png"), GnuplotError);
}

TEST(Gnuplot, SaysWhatIsMissing) {
  const ScratchFolder folder;
  EXPECT_THAT([&] { run_gnuplot(folder.path() / "a.gp", "gnuplot-that-is-not-there"); },
              ThrowsMessage<GnuplotError>(
                  AllOf(HasSubstr("not installed"), HasSubstr("apt-get install gnuplot-nox"))));
}

TEST(Gnuplot, ReportsWhatItsScriptDidWrong) {
  const tests::TemporaryFolder folder;
  folder.write("bad.gp", "plot nonsense(\n");
  EXPECT_THAT([&] { run_gnuplot(folder / "bad.gp"); },
              ThrowsMessage<GnuplotError>(HasSubstr("bad.gp")));
}

TEST(Gnuplot, ScratchFolderIsRemoved) {
  std::filesystem::path path;
  {
    const ScratchFolder folder;
    path = folder.path();
    std::ofstream(path / "a") << "content";
    EXPECT_TRUE(std::filesystem::exists(path / "a"));
  }
  EXPECT_FALSE(std::filesystem::exists(path));
}

TEST(Envelope, NoPeakIsLost) {
  std::vector<float> signal(10007, 0.0F);
  signal[5003] = 0.9F;
  signal[10006] = -0.4F;
  const auto extents = envelope(signal, 1000.0, 50);
  ASSERT_EQ(extents.size(), 50U);
  float highest = 0.0F;
  double when = 0.0;
  for (const Extent& extent : extents) {
    if (extent.highest > highest) {
      highest = extent.highest;
      when = extent.time;
    }
  }
  EXPECT_EQ(highest, 0.9F);
  EXPECT_NEAR(when, 5.003, 0.11);  // half a column, and the shared sample
  EXPECT_EQ(extents.back().lowest, -0.4F);
}

TEST(Envelope, ShortSignalsKeepTheirSamples) {
  const auto extents = envelope(std::vector<float>{0.25F, 0.5F, -0.5F}, 10.0, 100);
  ASSERT_EQ(extents.size(), 3U);
  EXPECT_DOUBLE_EQ(extents[1].time, 0.1);
  EXPECT_EQ(extents[2].lowest, -0.5F);
  EXPECT_EQ(extents[2].highest, -0.5F);
  EXPECT_TRUE(envelope(std::vector<float>{}, 10.0, 100).empty());
}

}  // namespace
}  // namespace splash::synth
