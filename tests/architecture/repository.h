// The repository as text, for tests that judge how it is built. A rule is a function from files to findings,
// so that a test can first show on made-up files that the rule bites.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <string_view>
#include <vector>

namespace millwright::architecture {

struct TextFile {
    std::string path; ///< from the repository's root, with slashes: core/grid/grid.h
    std::string text;
};

struct Finding {
    std::string path;
    int line = 0; ///< from 1; 0 where the whole file is meant
    std::string sentence;

    friend bool operator==(const Finding&, const Finding&) = default;
};
std::ostream& operator<<(std::ostream& out, const Finding& finding);

/// A line with its number from 1.
struct Line {
    int number = 0;
    std::string_view text;
};

/// The lines of `text`, without their ends. The views live as long as `text`.
[[nodiscard]] std::vector<Line> lines_of(std::string_view text);

/// The words of `text`, separated by white space. The views live as long as `text`.
[[nodiscard]] std::vector<std::string_view> words_of(std::string_view text);

/// The folder of a path, empty at the root.
[[nodiscard]] std::string folder_of(std::string_view path);

[[nodiscard]] bool is_source(std::string_view path); ///< .cpp or .h
[[nodiscard]] bool is_header(std::string_view path); ///< .h

/// Whether `path` is `folder` or lies in it. Everything lies in the empty folder.
[[nodiscard]] bool is_inside(std::string_view path, std::string_view folder);

/// Every text file of the repository that the rules know: sources, CMakeLists.txt and Markdown, sorted by
/// path. Build results, hidden folders and outside text are left out.
[[nodiscard]] std::vector<TextFile> read_repository(const std::filesystem::path& root);

} // namespace millwright::architecture
