#include "core/hpgl/internal/line_type.h"

#include <algorithm>
#include <cmath>

namespace millwright::hpgl::internal {

const std::array<Pattern, 8>& initial_patterns() {
    static const std::array<Pattern, 8> patterns = {
        Pattern{0, 100},
        Pattern{50, 50},
        Pattern{70, 30},
        Pattern{80, 10, 0, 10},
        Pattern{70, 10, 10, 10},
        Pattern{50, 10, 10, 10, 10, 10},
        Pattern{70, 10, 0, 10, 0, 10},
        Pattern{50, 10, 0, 10, 10, 10, 0, 10},
    };
    return patterns;
}

void LineType::set_solid() {
    kind_ = Kind::solid;
}

void LineType::set_dots() {
    kind_ = Kind::dots;
}

void LineType::set_pattern(const Pattern& pattern, double length) {
    double sum = 0.0;
    for (const double part : pattern) {
        sum += part;
    }
    kind_ = Kind::pattern;
    pattern_.clear();
    for (const double part : pattern) {
        pattern_.push_back(part / sum);
    }
    length_ = length;
    phase_ = 0.0;
}

void LineType::set_adaptive(const Pattern& pattern, double length) {
    set_pattern(pattern, length);
    kind_ = Kind::adaptive;
}

void LineType::apply(const Vec2& from,
                     const Vec2& to,
                     const std::function<void(const Vec2&, const Vec2&)>& draw) {
    const double distance = (to - from).norm();
    if (kind_ == Kind::dots) {
        draw(to, to);
        return;
    }
    if (kind_ == Kind::solid || !(distance > 0.0)) {
        draw(from, to);
        return;
    }
    const bool adaptive = kind_ == Kind::adaptive;
    const double period = adaptive ? distance / std::ceil(distance / length_) : length_;
    const double begin = adaptive ? 0.5 * pattern_.front() * period : phase_;
    const Vec2 along = (to - from) / distance;
    const auto at = [&](double s) { return Vec2(from + std::clamp(s, 0.0, distance) * along); };

    // s counts from the start of the vector; the first period began before it. Periods are counted, not added
    // up.
    const double first = std::floor(begin / period);
    for (double n = first; n * period - begin < distance; n += 1.0) {
        double s = n * period - begin;
        for (std::size_t part = 0; part < pattern_.size(); ++part) {
            const double end = s + pattern_[part] * period;
            const bool drawn = part % 2 == 0;
            const bool dot = drawn && !(pattern_[part] > 0.0) && s >= 0.0 && s < distance;
            if (dot || (drawn && end > 0.0 && s < distance && end > s)) {
                draw(at(s), at(end));
            }
            s = end;
        }
    }
    if (!adaptive) {
        phase_ = std::fmod(phase_ + distance, length_);
    }
}

} // namespace millwright::hpgl::internal
