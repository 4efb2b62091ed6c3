// SPDX-License-Identifier: MIT
#include "protocol/event_log.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <stdexcept>
#include <string>

#include "protocol/limits.hpp"
#include "tests/protocol/raw_packet.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text_of.hpp"

namespace splash::protocol::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

class EventLog : public ::testing::Test {
 protected:
  [[nodiscard]] std::filesystem::path path() const { return folder_ / "test.osc"; }

  void write(const Raw& content) const {
    folder_.write("test.osc", {reinterpret_cast<const char*>(content.data()), content.size()});
  }

  [[nodiscard]] std::string refusal(const Raw& content) const {
    write(content);
    try {
      (void)read_log(path());
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "accepted";
  }

  const tests::TemporaryFolder folder_;
};

const Message kImpact = to_message(Impact{1, 0, 2.0F, 1.0F, {0.1F, 0.2F, 0.3F}, 0.5F});
const Message kFrame = to_message(Frame{9, 1, 2, 3.0F});

TEST_F(EventLog, ComesBack) {
  {
    LogWriter log(path());
    log.append(0.0, {});
    log.append(0.25, {kFrame, kImpact});
    log.append(3600.5, {kFrame});
  }
  const auto entries = read_log(path());
  ASSERT_EQ(entries.size(), 3U);
  EXPECT_EQ(entries[0].seconds, 0.0);
  EXPECT_TRUE(entries[0].messages.empty());
  EXPECT_EQ(entries[1].seconds, 0.25);
  EXPECT_EQ(entries[1].messages, (std::vector<Message>{kFrame, kImpact}));
  EXPECT_EQ(entries[2].seconds, 3600.5);
}

TEST_F(EventLog, FramedAsAScoreOfScsynth) {
  {
    LogWriter log(path());
    log.append(1.5, {{"/a", {7}}});
  }
  const Raw bundle = bundle_head(0x180000000ULL) + element(message("/a", ",i", word(7)));
  EXPECT_EQ(bytes(tests::text_of(path())), element(bundle));
}

TEST_F(EventLog, TimeNeverRunsBackwards) {
  {
    LogWriter log(path());
    log.append(2.0, {kFrame});
    log.append(1.0, {kFrame});
    log.append(std::numeric_limits<double>::quiet_NaN(), {kFrame});
    log.append(3.0, {kFrame});
  }
  const auto entries = read_log(path());
  ASSERT_EQ(entries.size(), 4U);
  EXPECT_EQ(entries[1].seconds, 2.0);
  EXPECT_EQ(entries[2].seconds, 2.0);
  EXPECT_EQ(entries[3].seconds, 3.0);
}

TEST_F(EventLog, EmptyLogIsALog) {
  { const LogWriter log(path()); }
  EXPECT_TRUE(read_log(path()).empty());
}

TEST_F(EventLog, ABundleThatIsNoneIsNotWritten) {
  {
    LogWriter log(path());
    EXPECT_THROW(log.append(0.0, std::vector<Message>(65, kFrame)), std::length_error);
    log.append(1.0, {kFrame});
  }
  EXPECT_EQ(read_log(path()).size(), 1U);
}

TEST_F(EventLog, RefusesEveryTruncation) {
  const Raw entry = element(bundle_head(1ULL << 32U) + element(message("/a", ",i", word(1))));
  const Raw whole = entry + entry;
  for (std::size_t size = 1; size < whole.size(); ++size) {
    if (size == entry.size()) continue;
    const auto reason = refusal(Raw(whole.begin(), whole.begin() + static_cast<long>(size)));
    EXPECT_THAT(reason, HasSubstr("the file ends inside a packet")) << size;
    EXPECT_THAT(reason, AllOf(HasSubstr(path().string()),
                              HasSubstr(size < entry.size() ? ", byte 0:" : ", byte 36:")));
  }
}

TEST_F(EventLog, RefusesHostileSizes) {
  const Raw head = bundle_head();
  for (const std::uint32_t size :
       {0U, 4U, 12U, 17U, 18U, 1476U, 0x7fffffffU, 0x80000000U, 0xfffffffcU, 0xffffffffU}) {
    EXPECT_THAT(refusal(word(size) + head),
                HasSubstr("byte 0: packet size " + std::to_string(size) + ", expected"));
  }
}

TEST_F(EventLog, RefusesWhatTheGateRefusesAndSaysWhere) {
  const Raw good = element(bundle_head());
  EXPECT_EQ(refusal(good + element(bundle_head() + word(0xfffffffc))),
            "event log '" + path().string() +
                "', byte 20: the packet is refused: bundle element's size is zero, no multiple of "
                "four or passes the end");
  EXPECT_THAT(refusal(good + element(message("/impact", ",iii", word(1) + word(2) + word(3)))),
              HasSubstr("byte 20: a bare message, expected a bundle"));
  EXPECT_THAT(refusal(element(bundle_head(2ULL << 32U)) + element(bundle_head(1ULL << 32U))),
              HasSubstr("byte 20: its time 1.000000 s lies before the 2.000000 s"));
}

TEST_F(EventLog, RefusesALogThatWouldFillTheMemory) {
  write(element(bundle_head()));
  std::filesystem::resize_file(path(), (256U << 20U) + 1);  // sparse
  EXPECT_THAT([&] { (void)read_log(path()); },
              ThrowsMessage<std::runtime_error>(HasSubstr("at most 268435456")));
}

TEST_F(EventLog, SaysWhyAFileCannotBeOpened) {
  EXPECT_THAT(
      [&] { (void)read_log(folder_ / "none.osc"); },
      ThrowsMessage<std::runtime_error>(AllOf(HasSubstr("none.osc"), HasSubstr("No such file"))));
  EXPECT_THAT([&] { const LogWriter log(folder_ / "no" / "folder.osc"); },
              ThrowsMessage<std::runtime_error>(
                  AllOf(HasSubstr("cannot create"), HasSubstr("No such file"))));
  EXPECT_THROW((void)read_log(folder_.path()), std::runtime_error);
}

TEST_F(EventLog, AFullDiskIsAnError) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  LogWriter log("/dev/full");
  EXPECT_THAT(
      [&] { log.append(0.0, {kFrame}); },
      ThrowsMessage<std::runtime_error>(AllOf(HasSubstr("/dev/full"), HasSubstr("No space left"))));
}

/// As on a small disk: files of this process may not grow beyond `bytes`.
class FileLimit {
 public:
  explicit FileLimit(rlim_t bytes) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
    old_ = std::signal(SIGXFSZ, SIG_IGN);
  }
  ~FileLimit() {
    setrlimit(RLIMIT_FSIZE, &before_);
    static_cast<void>(std::signal(SIGXFSZ, old_));
  }
  FileLimit(const FileLimit&) = delete;
  FileLimit& operator=(const FileLimit&) = delete;

 private:
  rlimit before_{};
  void (*old_)(int) = nullptr;
};

TEST_F(EventLog, ADiskThatFillsLeavesWholeBundles) {
  std::size_t written = 0;
  {
    const FileLimit limit(1000);  // in the midst of a bundle
    LogWriter log(path());
    EXPECT_THROW(for (; written < 100; ++written)
                     log.append(static_cast<double>(written), {kFrame, kImpact}),
                 std::runtime_error);
    EXPECT_THROW(log.append(1000.0, {kFrame}), std::runtime_error) << "it stays closed";
  }
  EXPECT_GT(written, 3U);
  EXPECT_LT(written, 100U);
  EXPECT_EQ(read_log(path()).size(), written);
}

}  // namespace
}  // namespace splash::protocol::test
