#include "core/plot/work_time.h"

#include "core/base/error.h"
#include "core/base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace millwright::plot {

namespace {

constexpr std::string_view no_hour = "00:"; // of clock_time

void expect_usable(const TimeModel& model) {
    const bool usable = model.cutting > 0.0 && model.travelling > 0.0 && model.lifting >= 0.0 &&
                        std::isfinite(model.cutting + model.travelling + model.lifting);
    if (!usable) {
        throw Error("a time estimate needs speeds above 0");
    }
}

double seconds_of(const WorkTime& time, const TimeModel& model) {
    return time.cut_length / model.cutting + time.travel_length / model.travelling +
           time.runs * model.lifting;
}

/// By pen, as they stand.
std::map<int, std::vector<const Stroke*>> strokes_of_pens(const Strokes& strokes) {
    std::map<int, std::vector<const Stroke*>> pens;
    for (const Stroke& stroke : strokes) {
        pens[stroke.pen].push_back(&stroke);
    }
    return pens;
}

} // namespace

WorkTime work_time(const Strokes& strokes, const TimeModel& model, const Vec2& start, const Vec2& end) {
    expect_usable(model);
    WorkTime time;
    time.cut_length = draw_length(strokes);
    time.travel_length = air_length(strokes, start, end);
    time.runs = static_cast<int>(strokes.size());
    time.seconds = seconds_of(time, model);
    return time;
}

WorkTime work_time(const Strokes& strokes,
                   const std::vector<Level>& levels,
                   const TimeModel& model,
                   const Vec2& start,
                   const Vec2& end) {
    expect_usable(model);
    const auto pens = strokes_of_pens(strokes);
    std::vector<Level> in_order = levels;
    std::ranges::stable_sort(in_order, {}, &Level::order);
    WorkTime time;
    double cutting = 0.0; // s, at the feeds of the levels
    Vec2 at = start;
    for (const Level& level : in_order) {
        const auto drawn = pens.find(level.pen);
        if (!level.enabled || drawn == pens.end()) {
            continue;
        }
        for (int pass = 0; pass < level.passes; ++pass) {
            for (const Stroke* stroke : drawn->second) {
                time.travel_length += (stroke->points.front() - at).norm();
                time.cut_length += length(*stroke);
                cutting += length(*stroke) / level.cutting;
                ++time.runs;
                at = stroke->points.back();
            }
        }
    }
    time.travel_length += (end - at).norm();
    time.seconds = seconds_of(time, model);
    time.seconds_at_feeds = cutting + time.travel_length / model.travelling + time.runs * model.lifting;
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
