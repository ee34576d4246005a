#include "core/plot/work_time.h"

#include "core/base/error.h"
#include "core/base/text.h"

#include <fmt/format.h>

#include <cmath>

namespace millwright::plot {

namespace {

constexpr std::string_view no_hour = "00:"; // of clock_time

} // namespace

WorkTime work_time(const Strokes& strokes, const TimeModel& model, const Vec2& start, const Vec2& end) {
    const bool usable = model.cutting > 0.0 && model.travelling > 0.0 && model.lifting >= 0.0 &&
                        std::isfinite(model.cutting + model.travelling + model.lifting);
    if (!usable) {
        throw Error("a time needs speeds above 0");
    }
    WorkTime time;
    time.cut_length = draw_length(strokes);
    time.travel_length = air_length(strokes, start, end);
    time.runs = static_cast<int>(strokes.size());
    time.seconds =
        time.cut_length / model.cutting + time.travel_length / model.travelling + time.runs * model.lifting;
    return time;
}

std::string minutes_and_seconds(double seconds) {
    std::string text = clock_time(seconds);
    if (text.starts_with(no_hour)) {
        text.erase(0, no_hour.size());
    }
    return text.starts_with('0') ? text.substr(1) : text;
}

std::string_view minutes_or_hours(double seconds) {
    return clock_time(seconds).starts_with(no_hour) ? "min" : "h";
}

std::string time_for_people(double seconds) {
    return fmt::format("{} {}", minutes_and_seconds(seconds), minutes_or_hours(seconds));
}

} // namespace millwright::plot
