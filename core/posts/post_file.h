// Post files: JSON, described field by field in docs/reference/post-file.md.
#pragma once

#include "core/posts/post_format.h"

#include <filesystem>
#include <string_view>

namespace millwright::posts {

/// Throws Error with file, line and field for anything wrong in it.
[[nodiscard]] PostFormat read_post(const std::filesystem::path& file);

/// The same of a text, which is called `file` in diagnostics.
[[nodiscard]] PostFormat parse_post(std::string_view text, const std::filesystem::path& file);

/// Whether texts in `post` say how closely corners are followed: some line of their head has {path}.
[[nodiscard]] bool says_path_mode(const PostFormat& post);

} // namespace millwright::posts
