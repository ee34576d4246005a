#include "app/plots/other_than_plot.h"

#include "core/base/error.h"
#include "core/gcode/language.h"
#include "core/gcode_programs/cut_program.h"
#include "core/plot/path_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <optional>
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

/// Other languages for machines; the plot itself and G-code are none. A line that is cut does not count.
std::optional<gcode::Language> other_language(std::string_view head) {
    head = head.substr(0, head.find('\0'));
    const std::size_t last = head.find_last_of("\r\n");
    const auto found = gcode::language_of_first_line(head.substr(0, std::min(last, head.size())));
    return found == gcode::Language::hpgl ? std::nullopt : found;
}

bool can_be_looked_at(const std::filesystem::path& file) {
    std::error_code none;
    return std::filesystem::is_regular_file(file, none);
}

} // namespace

void expect_no_other_than_plot(const std::filesystem::path& file) {
    if (!can_be_looked_at(file)) {
        return;
    }
    const std::string head = head_of(file);
    const std::string name = file.string();
    if (is_picture(head)) {
        throw Error(
            "this is a picture, not a plot",
            file,
            fmt::format(
                "make a path from it with 'millwright picture relief {0}', or with trace, carve or engrave",
                name));
    }
    if (plot::is_path_file(head)) {
        throw Error(
            "this is a path file, not a plot: it contains the tool positions",
            file,
            fmt::format("show it with 'millwright {0}', or send it to a table with 'millwright send {0}'",
                        name));
    }
    if (const auto language = other_language(head); language && !gcode::is_gcode(head)) {
        throw Error(fmt::format("this is {}, neither a plot nor G-code", name_of(*language)),
                    file,
                    std::string(advice_for(*language)));
    }
}

std::string head_of_file(const std::filesystem::path& file) {
    return can_be_looked_at(file) ? head_of(file) : std::string();
}

bool is_gcode_file(const std::filesystem::path& file) {
    return can_be_looked_at(file) && gcode::is_gcode(head_of(file));
}

} // namespace millwright::app
