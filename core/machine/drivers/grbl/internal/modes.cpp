#include "core/machine/drivers/grbl/internal/modes.h"

#include "core/base/text.h"

#include <charconv>

namespace millwright::machine::grbl {

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

} // namespace millwright::machine::grbl
