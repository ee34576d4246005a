#include "core/motion/internal/profile.h"

#include "core/base/numbers.h"

#include <algorithm>

namespace millwright::motion::internal {

namespace {

/// A piece of a zone, with the least value that is known for it.
struct ZonePiece {
    double from = 0.0, to = 0.0;
    double value = 0.0;
    Cause cause;
    double own_value = 0.0; ///< of its zone
    Cause own_cause;
    double reach = 0.0;
    bool rests = false; ///< at its end
};

struct Active {
    double value = 0.0;
    double until = 0.0;
    Cause cause;
};

/// The zones behind that still hold. Of two that hold equally long only the lower one counts, so both value
/// and end rise through the list.
class Staircase {
public:
    void add(const Active& zone) {
        auto place = steps_.end();
        while (place != begin() && (place - 1)->value >= zone.value) {
            --place;
        }
        if (place != begin() && (place - 1)->until >= zone.until) {
            return;
        }
        auto beyond = place;
        while (beyond != steps_.end() && beyond->until <= zone.until) {
            ++beyond;
        }
        if (beyond == place) {
            steps_.insert(place, zone);
        } else {
            *place = zone;
            steps_.erase(place + 1, beyond);
        }
    }

    void clear() {
        steps_.clear();
        first_ = 0;
    }

    void pass(double position) {
        while (first_ < steps_.size() && !(steps_[first_].until > position)) {
            ++first_;
        }
        if (first_ == steps_.size()) {
            clear();
        }
    }

    [[nodiscard]] std::vector<Active>::iterator begin() {
        return steps_.begin() + static_cast<std::ptrdiff_t>(first_);
    }
    [[nodiscard]] std::vector<Active>::iterator end() { return steps_.end(); }

private:
    std::vector<Active> steps_;
    std::size_t first_ = 0; ///< those before it are passed
};

/// Each zone's limit also on what comes after it, as far as it reaches, and no rest comes between. `turned`:
/// the pieces are in reverse, and rest at their begin.
std::vector<ZonePiece> carried_on(const std::vector<ZonePiece>& stretches, bool turned) {
    std::vector<ZonePiece> result;
    result.reserve(stretches.size() + stretches.size() / 2);
    Staircase active;
    for (const ZonePiece& stretch : stretches) {
        if (turned && stretch.rests) {
            active.clear();
        }
        active.pass(stretch.from);
        double from = stretch.from;
        for (const Active& zone : active) {
            if (!(zone.value < stretch.value) || !(from < stretch.to)) {
                break;
            }
            ZonePiece part = stretch;
            part.from = from;
            part.to = std::min(zone.until, stretch.to);
            part.value = zone.value;
            part.cause = zone.cause;
            part.rests = stretch.rests && (turned ? !(from > stretch.from) : !(part.to < stretch.to));
            from = part.to;
            result.push_back(part);
        }
        if (from < stretch.to || !(stretch.from < stretch.to)) {
            ZonePiece rest = stretch;
            rest.from = from;
            rest.rests = stretch.rests && !(turned && from > stretch.from);
            result.push_back(rest);
        }
        active.add({stretch.own_value, stretch.to + stretch.reach, stretch.own_cause});
        if (!turned && stretch.rests) {
            active.clear();
        }
    }
    return result;
}

void turn_round(std::vector<ZonePiece>& stretches) {
    std::ranges::reverse(stretches);
    for (ZonePiece& stretch : stretches) {
        const double from = stretch.from;
        stretch.from = -stretch.to;
        stretch.to = -from;
    }
}

bool same(const Step& a, double value, const Cause& cause) {
    return exactly_equal(a.value, value) && a.cause == cause;
}

void append(Profile& profile, double end, double value, const Cause& cause) {
    if (!profile.empty() && same(profile.back(), value, cause)) {
        profile.back().end = end;
    } else {
        profile.push_back({end, value, cause});
    }
}

} // namespace

Profile profile_of(const std::vector<Zone>& zones, double begin) {
    Profile profile;
    profile.reserve(zones.size());
    if (std::ranges::all_of(zones, [](const Zone& zone) { return !(zone.reach > 0.0); })) {
        for (const Zone& zone : zones) {
            append(profile, zone.end, zone.value, zone.cause);
        }
        return profile;
    }
    std::vector<ZonePiece> stretches;
    stretches.reserve(zones.size());
    double from = begin;
    for (const Zone& zone : zones) {
        stretches.push_back(
            {from, zone.end, zone.value, zone.cause, zone.value, zone.cause, zone.reach, zone.rests});
        from = zone.end;
    }
    stretches = carried_on(stretches, false);
    turn_round(stretches);
    stretches = carried_on(stretches, true);
    turn_round(stretches);
    for (const ZonePiece& stretch : stretches) {
        append(profile, stretch.to, stretch.value, stretch.cause);
    }
    return profile;
}

} // namespace millwright::motion::internal
