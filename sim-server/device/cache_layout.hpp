// SPDX-License-Identifier: MIT
// How PoCL lays out its cache: two capital letters / the rest of the source's hash / program.bc,
// kernels/.../*.so.
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

namespace splash::sim {

/// A file of each program that PoCL touches at every start that asks for it.
constexpr std::string_view kLastAccessed = "last_accessed";
/// How the names of drafts begin: PoCL leaves one, empty, at every start.
constexpr std::string_view kDraft = "tempfile_";

/// The folders of compiled programs, relative to PoCL's cache `folder`.
[[nodiscard]] std::vector<std::filesystem::path> programs_in(const std::filesystem::path& folder);

}  // namespace splash::sim
