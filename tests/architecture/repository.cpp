#include "tests/architecture/repository.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <ostream>
#include <sstream>

namespace millwright::architecture {
namespace {

constexpr std::array folders = {
    "app", "assets", "bench", "core", "docs", "scripts", "shaders", "tests", "third_party", "ui"};

bool is_known(const std::filesystem::path& file) {
    const auto extension = file.extension();
    return extension == ".cpp" || extension == ".h" || extension == ".md" ||
           file.filename() == "CMakeLists.txt";
}

TextFile read(const std::filesystem::path& root, const std::filesystem::path& file) {
    std::ostringstream text;
    text << std::ifstream(file, std::ios::binary).rdbuf();
    return {.path = file.lexically_relative(root).generic_string(), .text = text.str()};
}

} // namespace

std::ostream& operator<<(std::ostream& out, const Finding& finding) {
    return out << finding.path << ':' << finding.line << ": " << finding.sentence;
}

std::vector<Line> lines_of(std::string_view text) {
    std::vector<Line> lines;
    while (!text.empty()) {
        const auto end = text.find('\n');
        lines.push_back({.number = static_cast<int>(lines.size()) + 1, .text = text.substr(0, end)});
        text = end == std::string_view::npos ? std::string_view{} : text.substr(end + 1);
    }
    return lines;
}

std::vector<std::string_view> words_of(std::string_view text) {
    constexpr std::string_view white = " \t\r\n";
    std::vector<std::string_view> words;
    for (auto begin = text.find_first_not_of(white); begin != std::string_view::npos;) {
        const auto end = std::min(text.find_first_of(white, begin), text.size());
        words.push_back(text.substr(begin, end - begin));
        begin = text.find_first_not_of(white, end);
    }
    return words;
}

std::string folder_of(std::string_view path) {
    const auto slash = path.rfind('/');
    return slash == std::string_view::npos ? std::string() : std::string(path.substr(0, slash));
}

bool is_header(std::string_view path) {
    return path.ends_with(".h");
}

bool is_source(std::string_view path) {
    return is_header(path) || path.ends_with(".cpp");
}

bool is_inside(std::string_view path, std::string_view folder) {
    return folder.empty() || path == folder ||
           (path.starts_with(folder) && path.substr(folder.size()).starts_with('/'));
}

std::vector<TextFile> read_repository(const std::filesystem::path& root) {
    std::vector<TextFile> files;
    for (const auto& entry : std::filesystem::directory_iterator(root)) {
        if (entry.is_regular_file() && is_known(entry.path())) {
            files.push_back(read(root, entry.path()));
        }
    }
    for (const char* folder : folders) {
        if (!std::filesystem::is_directory(root / folder)) {
            continue;
        }
        for (const auto& entry : std::filesystem::recursive_directory_iterator(root / folder)) {
            if (entry.is_regular_file() && is_known(entry.path())) {
                files.push_back(read(root, entry.path()));
            }
        }
    }
    std::ranges::sort(files, {}, &TextFile::path);
    return files;
}

} // namespace millwright::architecture
