// How long a plot takes to cut, and how far the tool goes, before anything is sent. mm, mm/s, s.
#pragma once

#include "core/plot/cut_path.h"
#include "core/plot_strokes/strokes.h"

#include <string>
#include <string_view>
#include <vector>

namespace millwright::plot {

/// Speeds of the machine without acceleration. The values explain the two jobs of the KMITL master's thesis
/// of 2006 whose geometry is known: 214 s for a square of 412 mm, 193 s for a circle of 323.58 mm.
struct TimeModel {
    double cutting = 2.0;     ///< > 0
    double travelling = 10.0; ///< pen up, > 0
    double lifting = 6.0;     ///< going down and up once, s, >= 0
};

struct WorkTime {
    double cut_length = 0.0;
    double travel_length = 0.0;
    int runs = 0; ///< times the tool goes down
    double seconds = 0.0;
    double seconds_at_feeds =
        0.0; ///< by the feeds of the levels in place of TimeModel::cutting; 0 without levels

    /// The distance that the thesis shows: all but up and down.
    [[nodiscard]] double distance() const { return cut_length + travel_length; }
};

/// From `start` through the strokes in their order and back to `end`. Throws Error for an invalid speed.
[[nodiscard]] WorkTime
work_time(const Strokes& strokes, const TimeModel& model, const Vec2& start, const Vec2& end);

/// The same of what cut_path() cuts: level by level, each pass of each stroke counted, those that are off and
/// pens without a level not. Ways to a change of tools are no part of it.
[[nodiscard]] WorkTime work_time(const Strokes& strokes,
                                 const std::vector<Level>& levels,
                                 const TimeModel& model,
                                 const Vec2& start,
                                 const Vec2& end);

/// m:ss, or h:mm:ss from an hour on; whole seconds as clock_time has them.
[[nodiscard]] std::string minutes_and_seconds(double seconds);
/// What stands behind it: min, or h.
[[nodiscard]] std::string_view minutes_or_hours(double seconds);
/// Both, as "24:56 min" or "1:10:59 h".
[[nodiscard]] std::string time_for_people(double seconds);

} // namespace millwright::plot
