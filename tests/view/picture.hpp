// SPDX-License-Identifier: MIT
// The page's picture of the scene, as a test looks at it.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/view/chromium.hpp"

namespace splash::tests {

using Json = nlohmann::json;

/// Skips its tests where there is no browser.
class InABrowser : public testing::Test {
 protected:
  void SetUp() override {
    if (!Chromium::is_there()) GTEST_SKIP() << "there is no chromium: apt-get install chromium";
  }
};

inline constexpr double kTimeout = 60.0;  ///< [s]

/// Loads the page and waits for pictures, with nothing else in them. `words`: what it says
/// when it shows none.
void show_page(Chromium& browser, const std::string& url,
               const std::function<std::string()>& words = {});

/// Where places of the scene are in the picture [CSS pixels].
Json seen(Chromium& browser, const Json& places);
/// The colours of places of the water's canvas in the next picture, red, green and blue each, from
/// 0 to 255. `places`: [[x, y], ...] [CSS pixels]. Quicker than a screenshot, and without what lies
/// over the canvas.
Json drawn(Chromium& browser, const Json& places);
/// A way of 0.3 m from the waiting disc down into the water, in the plane that faces the eye: where
/// it begins and ends in the picture [CSS pixels].
Json way_down(Chromium& browser);
/// Water is turquoise, the ground is grey.
[[nodiscard]] double turquoise(const Json& colour);

}  // namespace splash::tests
