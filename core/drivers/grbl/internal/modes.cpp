#include "core/drivers/grbl/internal/modes.h"

#include "core/base/text.h"

#include <algorithm>
#include <array>
#include <charconv>

namespace millwright::drivers::grbl {

Modes read_modes(std::string_view text, double report_unit) {
    using gcode::SpindleTurning;
    Modes modes;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find(' '), text.size());
        const std::string_view word = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        const auto feed = word.starts_with('F') ? read_number(word.substr(1)) : std::nullopt;
        modes.text += modes.text.empty() ? "" : " ";
        modes.text += feed ? "F" + shortest(*feed * report_unit) : std::string(word);
        if (word.size() == 3 && word.starts_with("G5") && word[2] >= '4' && word[2] <= '9') {
            modes.work_system = word[2] - '4' + 1;
        } else if (word.size() == 5 && word.starts_with("G59.") && word[4] >= '1' && word[4] <= '3') {
            constexpr int plain_systems = 6; // G54 to G59
            modes.work_system = word[4] - '0' + plain_systems;
        } else if (word == "M3" || word == "M4") {
            modes.spindle = word == "M3" ? SpindleTurning::clockwise : SpindleTurning::counterclockwise;
        } else if (word == "M7") {
            modes.mist = true;
        } else if (word == "M8") {
            modes.flood = true;
        } else if (word.starts_with('T')) {
            (void)std::from_chars(word.data() + 1, word.data() + word.size(), modes.tool);
        }
    }
    return modes;
}

std::optional<Axes> read_offset(std::string_view text) {
    if (text.find(',') != std::string_view::npos) {
        return read_axes(text);
    }
    const auto along_z = read_number(text);
    return along_z ? std::optional<Axes>({0.0, 0.0, *along_z}) : std::nullopt;
}

std::string_view unfollowed_mode(std::string_view modes) {
    constexpr std::array<std::string_view, 2> unfollowed = {"G51", "G7"};
    while (!modes.empty()) {
        const std::string_view word = modes.substr(0, modes.find(' '));
        modes.remove_prefix(std::min(word.size() + 1, modes.size()));
        const auto* const found = std::ranges::find(unfollowed, word.substr(0, word.find(':')));
        if (found != unfollowed.end()) {
            return *found;
        }
    }
    return {};
}

} // namespace millwright::drivers::grbl
