// SPDX-License-Identifier: MIT
// Each kind of error has one exit code, and no kind is taken for another.
#include "program/failure.hpp"

#include <gtest/gtest.h>

#include <cerrno>
#include <functional>
#include <type_traits>

#include "program/config.hpp"
#include "program/files.hpp"

namespace splash::program {
namespace {

/// An error of a device, as the rooms above define theirs.
class StandInError : public Failure {
 public:
  explicit StandInError(const std::string& text) : Failure(kExitUnavailable, text) {}
};

/// What a library throws: it is no kind of ours.
class LibraryError : public std::exception {
 public:
  [[nodiscard]] const char* what() const noexcept override { return "clFinish"; }
};

template <class A, class B>
constexpr bool kUnrelated = !std::is_base_of_v<A, B> && !std::is_base_of_v<B, A>;
static_assert(kUnrelated<ConfigError, WriteError> && kUnrelated<ConfigError, DataError> &&
              kUnrelated<ConfigError, StandInError> && kUnrelated<WriteError, DataError> &&
              kUnrelated<WriteError, StandInError> && kUnrelated<DataError, StandInError>);

TEST(Failure, EachKindHasItsExitCode) {
  EXPECT_EQ(exit_code_of("test", [] { throw ConfigError({.file = "a.yaml"}, "wrong"); }),
            kExitConfig);
  EXPECT_EQ(exit_code_of("test", [] { throw WriteError("cannot write", ENOSPC); }), kExitIo);
  EXPECT_EQ(exit_code_of("test", [] { throw DataError("no log"); }), kExitData);
  EXPECT_EQ(exit_code_of("test", [] { throw StandInError("no device"); }), kExitUnavailable);
  EXPECT_EQ(exit_code_of("test", [] { throw Failure(kExitUsage, "--what"); }), kExitUsage);
  EXPECT_EQ(exit_code_of("test", [] { throw LibraryError(); }), kExitInternal);
  EXPECT_EQ(exit_code_of("test", [] {}), kExitOk);
}

TEST(FailingWith, ChangesTheNamedKindAlone) {
  const auto code_of = [](const std::function<void()>& run) {
    return exit_code_of("test", [&] { failing_with<std::runtime_error>(kExitData, run); });
  };
  EXPECT_EQ(code_of([] { throw std::runtime_error("no WAV file"); }), kExitData);
  EXPECT_EQ(code_of([] { throw LibraryError(); }), kExitInternal) << "another kind";
  EXPECT_EQ(code_of([] { throw WriteError("cannot write", ENOSPC); }), kExitIo)
      << "ours keep theirs";
  EXPECT_EQ(code_of([] { throw StandInError("no device"); }), kExitUnavailable);
  EXPECT_EQ(failing_with<std::runtime_error>(kExitData, [] { return 7; }), 7);
}

}  // namespace
}  // namespace splash::program
