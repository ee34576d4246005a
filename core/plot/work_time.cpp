#include "core/plot/work_time.h"

#include "core/base/error.h"

#include <fmt/format.h>

#include <cmath>

namespace millwright::plot {

namespace {

constexpr long long an_hour = 3600; // s

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
    const long long whole = std::llround(seconds);
    const long long hours = whole / an_hour;
    return hours > 0 ? fmt::format("{}:{:02}:{:02}", hours, whole / 60 % 60, whole % 60)
                     : fmt::format("{}:{:02}", whole / 60, whole % 60);
}

std::string_view minutes_or_hours(double seconds) {
    return std::llround(seconds) < an_hour ? "min" : "h";
}

std::string time_for_people(double seconds) {
    return fmt::format("{} {}", minutes_and_seconds(seconds), minutes_or_hours(seconds));
}

} // namespace millwright::plot
