#include "app/other_than_plot.h"

#include "core/base/error.h"
#include "core/plot/path_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <string>
#include <string_view>
#include <system_error>

namespace millwright::app {

namespace {

std::string head_of(const std::filesystem::path& file) {
    constexpr std::streamsize enough = 4096;
    std::ifstream stream(file, std::ios::binary);
    std::string head(enough, '\0');
    stream.read(head.data(), enough);
    head.resize(static_cast<std::size_t>(stream.gcount()));
    return head;
}

/// As the pictures begin that can be read: PNG, JPEG, BMP, PGM and PPM.
bool is_picture(std::string_view text) {
    constexpr std::array<std::string_view, 5> beginnings{"\x89PNG", "\xff\xd8", "BM", "P5", "P6"};
    return std::ranges::any_of(beginnings, [&](std::string_view begin) { return text.starts_with(begin); });
}

/// A word of G-code is a letter and a number. Commands of HPGL have two letters.
bool begins_with_word(std::string_view line) {
    constexpr std::string_view letters = "NGMTFSOXYZ";
    if (line.empty() || letters.find(static_cast<char>(std::toupper(static_cast<unsigned char>(line[0])))) ==
                            std::string_view::npos) {
        return false;
    }
    const auto number = line.find_first_not_of(" \t", 1);
    return number != std::string_view::npos &&
           std::string_view("0123456789.+-#[<").find(line[number]) != std::string_view::npos;
}

/// The first line that is no comment and no percent sign.
bool is_gcode(std::string_view text) {
    while (!text.empty()) {
        const auto end = std::min(text.find_first_of("\r\n"), text.size());
        std::string_view line = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        const auto first = line.find_first_not_of(" \t/");
        line.remove_prefix(std::min(first, line.size()));
        if (!line.empty() && line != "%" && line.front() != ';' && line.front() != '(') {
            return begins_with_word(line);
        }
    }
    return false;
}

} // namespace

void expect_no_other_than_plot(const std::filesystem::path& file) {
    std::error_code none;
    if (!std::filesystem::is_regular_file(file, none)) {
        return;
    }
    const std::string head = head_of(file);
    const std::string name = file.string();
    if (is_picture(head)) {
        throw Error(
            "this is a picture, no plot",
            file,
            fmt::format("'millwright picture relief {0}', trace or engrave makes a path of it", name));
    }
    if (plot::is_path_file(head)) {
        throw Error(
            "this is a path file, no plot: where the tool goes stands in it",
            file,
            fmt::format("'millwright {0}' shows it, 'millwright send {0}' sends it to a table", name));
    }
    if (is_gcode(head)) {
        throw Error(
            "this is a G-code program, no plot: where the tool goes stands in it",
            file,
            fmt::format("'millwright gcode time {0}' tells its way and time, 'millwright {0}' shows it, "
                        "'millwright send {0}' sends it, to a table with '--driver records' a move a "
                        "record, with '--driver stream' a point a period",
                        name));
    }
}

} // namespace millwright::app
