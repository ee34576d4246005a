// Where the motion stands, and how to go elsewhere: first, back, play, step, last, speed, and a track over
// the whole path with its error and feed, on which one clicks or drags.
#pragma once

#include "ui/widgets/ui.h"

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

namespace millwright::widgets {

struct TimelineSeries {
    std::string_view label;
    std::string_view unit;
    std::span<const double> values; ///< at equal steps of path length from start to end
    Colour colour = 0;              ///< 0: the next of the palette's series
};

struct TimelineView {
    double fraction = 0.0; ///< of the path length, 0 to 1
    bool is_playing = false;
    double speed = 1.0;              ///< times real time; one of the speeds offered, else shown as it is
    std::string_view what = "Block"; ///< that is counted
    std::ptrdiff_t block = 0;
    std::ptrdiff_t blocks = 0;
    double time_s = 0.0;
    double total_s = 0.0;
    std::span<const TimelineSeries> series = {};
    Permission permission = {}; ///< such as "There is no program yet."
    float track_height = 0.0F;  ///< 0: all that is left below the buttons, at least 32 px at scale 1
};

struct TimelineAsk {
    enum class Kind { first, back, play, pause, step, last, scrub, speed };
    Kind kind = Kind::play;
    double value = 0.0; ///< scrub: the new fraction; speed: the new speed

    friend bool operator==(const TimelineAsk&, const TimelineAsk&) = default;
};

/// What was just asked for; paths below `id`: first, back, play, step, last, speed, track.
std::optional<TimelineAsk> timeline(Ui& ui, std::string_view id, const TimelineView& view);

} // namespace millwright::widgets
