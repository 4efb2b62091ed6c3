// SPDX-License-Identifier: MIT
// What a person keeps: pictures and films.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/view/stage.hpp"

namespace splash::tests {
namespace {

using testing::IsEmpty;

class Keeping : public InABrowser {};

/// What the page saves goes to `saved` instead of a file: its name, its kind and its bytes.
constexpr const char* kKeep = R"js({
  window.saved = [];
  const blobs = new Map();
  const make = URL.createObjectURL;
  URL.createObjectURL = (blob) => {
    const url = make(blob);
    blobs.set(url, blob);
    return url;
  };
  HTMLAnchorElement.prototype.click = async function () {
    const bytes = new Uint8Array(await blobs.get(this.href).arrayBuffer());
    saved.push({ name: this.download, bytes });
  };
})js";

/// The pictures in a WebM file (Matroska, RFC 9559): its blocks of track 1, in clusters of a
/// segment.
constexpr const char* kPictures = R"js((bytes) => {
  const number = (at, marked) => { // EBML's variable size (RFC 8794, section 4)
    const length = Math.clz32(bytes[at]) - 23;
    let value = marked ? bytes[at] : bytes[at] & (0xff >> length);
    for (let i = 1; i < length; ++i) value = 256 * value + bytes[at + i];
    return { value, next: at + length };
  };
  const INSIDE = [0x18538067, 0x1f43b675, 0xa0]; // segment, cluster, group of a block
  const BLOCKS = [0xa3, 0xa1];
  let pictures = 0;
  for (let at = 0; at < bytes.length;) {
    const id = number(at, true);
    const size = number(id.next, false);
    if (BLOCKS.includes(id.value) && number(size.next, false).value === 1) pictures += 1;
    at = INSIDE.includes(id.value) ? size.next : size.next + size.value;
  }
  return pictures;
})js";

TEST_F(Keeping, APictureAndAFilmAreSaved) {
  Stage stage(plunging(), "?points", "420,300");
  Chromium& browser = stage.browser();
  browser.evaluate(kKeep);
  browser.press("p");
  ASSERT_TRUE(browser.wait_for("saved.length === 1", kTimeout));
  EXPECT_EQ(browser.evaluate("/^small-.*\\.png$/.test(saved[0].name)"), true)
      << browser.evaluate("saved[0].name");
  EXPECT_EQ(browser.evaluate("[...saved[0].bytes.slice(0, 4)]"), Json({0x89, 'P', 'N', 'G'}));
  EXPECT_TRUE(browser.evaluate(R"js((async () => {
    const image = await createImageBitmap(new Blob([saved[0].bytes]));
    return image.width === document.getElementById('water').width;
  })())js"));

  browser.press("f");
  EXPECT_TRUE(browser.wait_for("document.getElementById('film').ariaPressed === 'true'", kTimeout));
  const int begun = browser.evaluate("splash.pictures()");
  // The encoder skips pictures until it has begun, which takes longer than ten of them.
  browser.evaluate("window.begun = performance.now()");
  EXPECT_TRUE(browser.wait_for(
      "performance.now() > begun + 2000 && splash.pictures() > " + std::to_string(begun + 10),
      kTimeout));
  browser.press("f");
  ASSERT_TRUE(browser.wait_for("saved.length === 2", kTimeout));
  EXPECT_EQ(browser.evaluate("/^small-.*\\.webm$/.test(saved[1].name)"), true)
      << browser.evaluate("saved[1].name");
  EXPECT_EQ(browser.evaluate("[...saved[1].bytes.slice(0, 4)]"), Json({0x1a, 0x45, 0xdf, 0xa3}));
  EXPECT_GT(browser.evaluate("(" + std::string(kPictures) + ")(saved[1].bytes)").get<int>(), 1);
  EXPECT_EQ(browser.evaluate("document.getElementById('film').ariaPressed"), "false");
  EXPECT_THAT(browser.errors(), IsEmpty());
}

}  // namespace
}  // namespace splash::tests
