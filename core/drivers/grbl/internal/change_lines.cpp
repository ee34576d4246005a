#include "core/drivers/grbl/internal/change_lines.h"

#include "core/base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace millwright::drivers::grbl {

namespace {

constexpr double mm_of_inch = 25.4;
constexpr double same_place = 0.0005; // mm or degrees: half of what Grbl reports

std::string word(char letter, double value) {
    constexpr int decimals = 4; // finer than any of these machines steps
    std::string number = fixed(value, decimals);
    number.erase(number.find_last_not_of('0') + 1);
    number += number.ends_with('.') ? "0" : "";
    return letter + number;
}

/// Down not faster than this, mm/min, however fast the program cuts.
double feed_down(const ModeWords& modes) {
    constexpr double fastest = 300.0;
    constexpr double without_feed = 100.0;
    const bool told = modes.feed_mode == "G94" && modes.feed > 0.0;
    return told ? std::min(modes.feed, fastest) : without_feed;
}

void start_spindle(const ModeWords& modes, double spin_up, ChangeLines& lines) {
    const bool turns = modes.spindle == "M3" || modes.spindle == "M4";
    lines.push_back((turns ? modes.spindle : "M5") + word('S', modes.speed));
    if (modes.mist) {
        lines.emplace_back("M7");
    }
    if (modes.flood) {
        lines.emplace_back("M8");
    }
    if (turns && spin_up > 0.0) {
        lines.push_back("G4" + word('P', spin_up));
    }
}

/// Motion last, alone: G1 without axis words needs a feed, which G93 does not keep.
void bring_modes_back(const ModeWords& modes, ChangeLines& lines) {
    const bool per_minute = modes.feed_mode == "G94";
    const double unit = modes.unit == "G20" ? mm_of_inch : 1.0;
    lines.push_back(modes.unit + (per_minute ? word('F', modes.feed / unit) : ""));
    const bool cannot_cut = modes.motion == "G1" && per_minute && !(modes.feed > 0.0);
    if (!modes.motion.empty() && !cannot_cut) {
        lines.push_back(modes.motion);
    }
    lines.push_back(modes.work_system + modes.plane + modes.distance + modes.feed_mode);
}

} // namespace

ModeWords mode_words(std::string_view modes) {
    ModeWords words;
    while (!modes.empty()) {
        const std::string code(modes.substr(0, modes.find(' ')));
        modes.remove_prefix(std::min(code.size() + 1, modes.size()));
        const auto is = [&code](std::initializer_list<std::string_view> codes) {
            return std::ranges::find(codes, code) != codes.end();
        };
        if (is({"G0", "G1", "G2", "G3", "G80"}) || code.starts_with("G38")) {
            words.motion = code;
        } else if (code.starts_with("G5") && code.size() > 2 && code[2] >= '4' && code[2] <= '9') {
            words.work_system = code;
        } else if (is({"G17", "G18", "G19"})) {
            words.plane = code;
        } else if (is({"G20", "G21"})) {
            words.unit = code;
        } else if (is({"G90", "G91"})) {
            words.distance = code;
        } else if (is({"G93", "G94", "G95"})) {
            words.feed_mode = code;
        } else if (is({"M3", "M4", "M5"})) {
            words.spindle = code;
        } else if (code.starts_with('F')) {
            words.feed = read_number(std::string_view(code).substr(1)).value_or(0.0);
        } else if (code.starts_with('S')) {
            words.speed = read_number(std::string_view(code).substr(1)).value_or(0.0);
        }
        words.mist = words.mist || code == "M7";
        words.flood = words.flood || code == "M8";
    }
    return words;
}

ChangeLines switched_off() {
    return {"M5", "M9"};
}

ChangeLines first_touch(const ToolSensor& sensor, double top) {
    return {"M5",
            "M9",
            "G21G90G94",
            "G53G0" + word('Z', top),
            "G53G0" + word('X', sensor.x) + word('Y', sensor.y),
            "G91G38.2" + word('Z', sensor.deepest_z - top) + word('F', sensor.feed),
            "G90"};
}

ChangeLines second_touch(const ToolSensor& sensor, double touched_z, double top) {
    constexpr double off = 2.0;     // mm: the switch opens
    constexpr double further = 1.0; // mm below the first touch
    constexpr double slower = 0.2;  // of the first feed
    const double from = std::min(touched_z + off, top);
    const double to = std::max(touched_z - further, sensor.deepest_z - same_place);
    return {"G90G53G0" + word('Z', from),
            "G91G38.2" + word('Z', to - from) + word('F', slower * sensor.feed),
            "G90"};
}

ChangeLines up_to(double top) {
    return {"G90G53G0" + word('Z', top)};
}

ChangeLines tool_length(double longer) {
    return {"G21G43.1" + word('Z', longer)};
}

ChangeLines way_back(const WayBack& way, const ModeWords& modes, double spin_up, std::string_view letters) {
    constexpr std::size_t z_axis = 2;
    ChangeLines lines = switched_off(); // a person may have used them
    lines.push_back("G21G90G94" + modes.work_system);
    if (way.moves) {
        if (way.top > way.from[z_axis] + same_place) {
            lines.push_back("G53G0" + word('Z', way.top));
        }
        std::string across;
        for (std::size_t n = 0; n < std::min(letters.size(), way.to.size()); ++n) {
            across += n == z_axis ? "" : word(letters[n], way.to[n]);
        }
        lines.push_back("G53G0" + across);
    }
    start_spindle(modes, spin_up, lines);
    if (way.moves && way.down) {
        lines.push_back("G53G1" + word('Z', way.to[z_axis]) + word('F', feed_down(modes)));
    }
    bring_modes_back(modes, lines);
    return lines;
}

} // namespace millwright::drivers::grbl
