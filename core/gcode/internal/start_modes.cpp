#include "core/gcode/internal/start_modes.h"

#include "core/gcode/internal/codes.h"
#include "core/gcode/internal/execute.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <string>

namespace millwright::gcode::internal {

namespace {

std::optional<double> mode_value(std::string_view word) {
    double value = 0.0;
    const char* const end = word.data() + word.size();
    const auto read = std::from_chars(word.data() + 1, end, value, std::chars_format::fixed);
    return read.ec == std::errc{} && read.ptr == end ? std::optional(value) : std::nullopt;
}

bool is_of_the_path(int code) {
    const int group = group_of_g(code);
    constexpr std::array groups = {GGroup::plane,
                                   GGroup::distance,
                                   GGroup::arc_distance,
                                   GGroup::feed_mode,
                                   GGroup::units,
                                   GGroup::coordinate_system};
    return std::ranges::any_of(groups, [group](GGroup one) { return static_cast<int>(one) == group; });
}

} // namespace

void take_modes(Run& run, std::string_view modes) {
    std::string codes;
    double feed_mm = 0.0;
    while (!modes.empty()) {
        const std::size_t end = std::min(modes.find(' '), modes.size());
        const std::string_view word = modes.substr(0, end);
        modes.remove_prefix(std::min(end + 1, modes.size()));
        const auto value = word.size() > 1 ? mode_value(word) : std::nullopt;
        constexpr double most = 100.0;
        if (!value || (word.front() != 'F' && !(*value >= 0.0 && *value < most))) {
            continue;
        }
        const int code = static_cast<int>(std::lround(std::min(*value, most) * 10.0));
        if (word.front() == 'F') {
            feed_mm = *value;
        } else if (word.front() == 'G' && group_of_g(code) == static_cast<int>(GGroup::motion)) {
            run.state.motion = code; // which is in force without its words
        } else if ((word.front() == 'G' && is_of_the_path(code)) || word == "M3" || word == "M4") {
            codes += word;
        }
    }
    execute_text(run, codes);
    if (run.state.feed_mode == FeedMode::per_minute) {
        run.state.feed_rate = run.state.unit == LengthUnit::mm ? feed_mm : feed_mm / mm_per_inch;
    }
}

} // namespace millwright::gcode::internal
