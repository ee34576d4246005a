#include "core/hpgl/internal/pen.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

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

bool clip(const Window& window, Vec2& from, Vec2& to) {
    const Vec2 along = to - from;
    double enter = 0.0;
    double leave = 1.0;
    for (const int axis : {0, 1}) {
        const double below = window.lower[axis] - from[axis];
        const double above = window.upper[axis] - from[axis];
        const double d = along[axis];
        if (d > 0.0 || d < 0.0) {
            enter = std::max(enter, (d > 0.0 ? below : above) / d);
            leave = std::min(leave, (d > 0.0 ? above : below) / d);
        } else if (below > 0.0 || above < 0.0) {
            return false;
        }
    }
    if (!(enter <= leave)) {
        return false;
    }
    const Vec2 start = from;
    if (enter > 0.0) {
        from = start + enter * along;
    }
    if (leave < 1.0) {
        to = start + leave * along;
    }
    return true;
}

Pen::Pen(const HpglSettings& settings, const Problems& problems)
    : problems_(problems), unit_(settings.unit.x, settings.unit.y),
      farthest_(Vec2::Constant(settings.farthest).cwiseQuotient(unit_)), points_left_(settings.most_points) {}

void Pen::select(int number) {
    end_dot();
    last_.open = last_.open && number_ == number;
    number_ = number;
}

void Pen::put_away() {
    lift();
    number_.reset();
}

void Pen::lower() {
    dot_ = dot_ || (!down_ && !polygon_open_);
    down_ = true;
}

void Pen::lift() {
    end_dot();
    down_ = false;
    last_.open = false;
    line.restart();
}

void Pen::go(const Vec2& to) {
    if (lost_) {
        lost_ = stays_lost_;
        dot_ = false;
        move(to, false);
    } else {
        move(to, down_);
    }
}

void Pen::step(const Vec2& by) {
    move(at_ + by, down_ && !lost_);
}

void Pen::place(const Vec2& to) {
    move(to, false);
}

void Pen::draw(const Vec2& to) {
    move(to, !lost_);
}

bool Pen::would_close(const Vec2& to) const {
    return last_.open && down_ && !lost_ && !strokes_.empty() && strokes_.back().points.front() == mm(to);
}

bool Pen::is_near(const Vec2& place) {
    if (std::abs(place.x()) <= farthest_.x() && std::abs(place.y()) <= farthest_.y()) {
        return true;
    }
    constexpr double m = 1e-3;
    refuse(fmt::format("a position is {:.0f} m from the origin: two numbers may have run together",
                       m * mm(place).cwiseAbs().maxCoeff()));
    return false;
}

void Pen::refuse(std::string why) {
    if (!refusal_) {
        refusal_ = std::move(why);
    }
}

Pen::Mark Pen::mark() const {
    return {.strokes = strokes_.size(),
            .points = strokes_.empty() ? 0 : strokes_.back().points.size(),
            .points_left = points_left_,
            .at = at_,
            .down = down_,
            .number = number_};
}

void Pen::take_back(const Mark& mark) {
    strokes_.resize(mark.strokes);
    if (!strokes_.empty()) {
        strokes_.back().points.resize(mark.points);
    }
    points_left_ = mark.points_left;
    at_ = mark.at;
    down_ = mark.down;
    number_ = mark.number;
}

void Pen::move(const Vec2& to, bool drawn) {
    if (refusal_ || !is_near(to)) {
        return;
    }
    if (polygon_open_) {
        count_points(1);
        polygon_.back().push_back({to, drawn});
    } else if (drawn && number_) {
        draw_vector(at_, to);
        dot_ = false;
    } else {
        last_.open = false;
        line.restart();
    }
    at_ = to;
}

void Pen::lose() {
    lost_ = true;
    dot_ = false;
    last_.open = false;
}

// A pen that went down and up at one place, with no line from there, leaves a dot.
void Pen::end_dot() {
    if (std::exchange(dot_, false) && number_ && !lost_) {
        draw_clipped(at_, at_);
        last_.open = false;
    }
}

void Pen::draw_vector(const Vec2& from, const Vec2& to) {
    if (line.solid()) {
        draw_clipped(from, to);
        return;
    }
    line.apply(from, to, [this](const Vec2& a, const Vec2& b) {
        last_.open = last_.open && a == last_.tip;
        draw_clipped(a, b);
    });
}

void Pen::draw_clipped(Vec2 from, Vec2 to) {
    if (!window || clip(*window, from, to)) {
        append(from, to);
    } else {
        count_points(1); // or endless dashes outside of the window would take for ever
    }
}

void Pen::append(const Vec2& from, const Vec2& to) {
    if (!last_.open || from != last_.tip || strokes_.back().pen != *number_) {
        constexpr int points_of_a_stroke = 4; // its own memory beside them
        count_points(points_of_a_stroke);
        strokes_.push_back({.pen = *number_, .points = {mm(from)}, .byte = byte});
        last_.open = true;
    }
    if (to != from) {
        count_points(1);
        strokes_.back().points.push_back(mm(to));
    }
    last_.tip = to;
}

void Pen::count_points(int count) {
    points_left_ -= count;
    if (points_left_ < 0) {
        throw Error(
            problems_.at(byte, "the plot has more points than allowed", "check the file: it may be damaged"));
    }
}

void Pen::open_polygon() {
    end_dot();
    polygon_.assign(1, Outline{{at_, false}});
    polygon_open_ = true;
}

void Pen::next_outline() {
    polygon_.emplace_back();
}

void Pen::close_polygon() {
    polygon_open_ = false;
    at_ = polygon_.front().front().at;
    last_.open = false;
}

void Pen::finish(Plot& plot, std::int64_t at_byte) {
    byte = at_byte;
    lift();
    plot.strokes = std::move(strokes_);
    plot.end = mm(at_);
}

} // namespace millwright::hpgl::internal
