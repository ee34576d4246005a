#include "core/gcode_programs/internal/cut_program_builder.h"

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/gcode_programs/programmed_feed.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace millwright::gcode::internal {

namespace {

constexpr double same_height = 1e-6; // mm: of turned and scaled programs

/// The feed as it was programmed, without what dividing by the time left of it.
double speed_of(const program::Block& block) {
    constexpr double steps = 1e9; // a mm/min
    return from_mm_per_min(std::round(to_mm_per_min(block.feed) * steps) / steps);
}

bool moves_across(const Vec3& from, const Vec3& to) {
    return (to - from).head<2>().norm() > same_place;
}

} // namespace

CutProgramBuilder::CutProgramBuilder(const program::Program& program,
                                     std::filesystem::path file,
                                     const std::optional<double>& safe_height)
    : file_(std::move(file)), at_(program.start), height_was_given_(safe_height.has_value()) {
    find_safe_height(program, safe_height);
}

/// `tool`: that a change brings; 0: unknown.
void CutProgramBuilder::add(const program::Block& block, int tool) {
    switch (block.kind) {
    case program::BlockKind::rapid:
    case program::BlockKind::feed:
        return move(block);
    case program::BlockKind::pause:
        if (block.pause == program::PauseKind::tool_change) {
            return change_tool(tool);
        }
        return leave_out(block, "operator stops");
    case program::BlockKind::dwell:
        made_.dwell_time += block.duration;
        return leave_out(block, "dwells");
    case program::BlockKind::coolant_on:
        return leave_out(block, "coolant");
    case program::BlockKind::spindle_on:
        return turn_spindle(block);
    case program::BlockKind::coolant_off:
    case program::BlockKind::spindle_off:
    case program::BlockKind::comment:
    case program::BlockKind::end:
        return;
    }
}

CutProgram CutProgramBuilder::take() {
    close_stroke();
    std::ranges::for_each(strokes_, [this](const Stroke& stroke) { see_from_above(stroke); });
    made_.end = at_.head<2>();
    tell_travel();
    for (const auto& [what, first] : left_out_) {
        made_.notices.push_back(
            {.place = {.file = file_, .line = first.line},
             .message = fmt::format("a path cannot contain {}: ignored{}",
                                    what,
                                    first.count > 1 ? fmt::format(" {} times", first.count) : ""),
             .hint = {}});
    }
    return std::move(made_);
}

/// By the rapids across whose height is known. Nothing is in the air that would be all there is.
void CutProgramBuilder::find_safe_height(const program::Program& program,
                                         const std::optional<double>& given) {
    std::optional<double> travel;
    double lowest_feed = std::numeric_limits<double>::infinity();
    bool told = false;
    Vec3 from = program.start;
    for (const program::Block& block : program.blocks) {
        if (!block.moves()) {
            continue;
        }
        const Vec3 to = block.target;
        const double low = std::min(from.z(), to.z());
        const bool across = moves_across(from, to);
        if (block.kind == program::BlockKind::feed) {
            lowest_feed = std::min(lowest_feed, low);
        } else if (across && told) {
            travel = std::max(travel.value_or(low), low);
        }
        told = told || block.named.contains(2);
        from = to;
    }
    made_.safe_height = given ? given : travel && *travel > lowest_feed ? travel : std::nullopt;
}

bool CutProgramBuilder::in_the_air(double z) const {
    return made_.safe_height && z >= *made_.safe_height - same_place;
}

/// Where the tool is before the program is not known: the path begins where the program has named all three
/// axes, or cuts.
void CutProgramBuilder::move(const program::Block& block) {
    const Vec3 to = block.target;
    if (made_.path.empty()) {
        const bool height_is_known = named_.contains(2) || block.named.contains(2);
        if (block.kind == program::BlockKind::rapid || (height_is_known && in_the_air(to.z()))) {
            return approach(block);
        }
        begin(block);
    }
    if (!((to - at_).norm() > 0.0)) {
        return;
    }
    if (block.kind == program::BlockKind::rapid) {
        close_stroke();
        append(to, 0.0, plot::CutMove::rapid);
    } else {
        feed(to, block);
    }
    at_ = to;
}

void CutProgramBuilder::approach(const program::Block& block) {
    at_ = block.target;
    for (int axis = 0; axis < 3; ++axis) {
        if (block.named.contains(axis)) {
            named_.insert(axis);
        }
    }
    if (named_ == program::AxisSet::all(3)) {
        append(at_, 0.0, plot::CutMove::rapid);
    }
}

/// A cut from zero would be one that the program does not have.
void CutProgramBuilder::expect_known_place(const program::Block& first_feed) {
    std::string unknown;
    for (const auto& [axis, letter] : {std::pair(0, 'X'), std::pair(1, 'Y')}) {
        if (!named_.contains(axis)) {
            unknown += unknown.empty() ? "" : " and ";
            unknown += letter;
        }
    }
    if (!unknown.empty()) {
        made_.unplaced.push_back(
            {.place = {.file = file_, .line = first_feed.source_line},
             .message = fmt::format("this cut starts before the program has stated where {} {}",
                                    unknown,
                                    unknown.size() > 1 ? "are" : "is"),
             .hint = fmt::format("add a rapid move with {} before the first cut", unknown)});
    }
}

/// With the first feed; from above where the height has not been named.
void CutProgramBuilder::begin(const program::Block& first_feed) {
    expect_known_place(first_feed);
    if (named_.contains(2)) {
        return append(at_, 0.0, plot::CutMove::rapid);
    }
    made_.notices.push_back({.place = {.file = file_, .line = first_feed.source_line},
                             .message = fmt::format("no height is given before this feed move: {:.3f} mm is "
                                                    "assumed, and the tool is lowered to it from above",
                                                    at_.z()),
                             .hint = "give Z before the first cut"});
    made_.lowers_unasked = true;
    constexpr double usual = 5.0;
    append(
        {at_.x(), at_.y(), std::max(made_.safe_height.value_or(usual), at_.z())}, 0.0, plot::CutMove::rapid);
    append(at_, speed_of(first_feed), plot::CutMove::plunge);
}

void CutProgramBuilder::feed(const Vec3& to, const program::Block& block) {
    const double speed = speed_of(block);
    made_.feed_time += block.duration;
    const bool down = to.z() < at_.z();
    if (!moves_across(at_, to)) {
        close_stroke();
        append(to, speed, down ? plot::CutMove::plunge : plot::CutMove::retract);
        if (down) {
            stroke_ = Stroke{{to}, tool_, block.source_line, speed, speed};
        }
        return;
    }
    if (in_the_air(std::min(at_.z(), to.z()))) {
        return travel_at_feed(to, speed, block.source_line);
    }
    append(to, speed, plot::CutMove::cut);
    if (!stroke_) {
        stroke_ = Stroke{{at_}, tool_, block.source_line, speed, speed};
    } else if (stroke_->points.size() == 1) {
        stroke_->line = block.source_line;
        stroke_->cutting = speed;
    }
    stroke_->points.push_back(to);
}

void CutProgramBuilder::travel_at_feed(const Vec3& to, double speed, int line) {
    close_stroke();
    append(to, speed, plot::CutMove::rapid);
    first_air_ = air_at_feed_ > 0.0 ? first_air_ : line;
    air_at_feed_ += (to - at_).norm();
}

/// A way down that nothing follows is a dot; of several at a place the deepest.
void CutProgramBuilder::close_stroke() {
    if (!stroke_) {
        return;
    }
    Stroke stroke = std::move(*stroke_);
    stroke_.reset();
    if (stroke.points.size() > 1 || strokes_.empty()) {
        if (stroke.points.size() > 1 || !in_the_air(stroke.points.front().z())) {
            strokes_.push_back(std::move(stroke));
        }
        return;
    }
    const Vec3& at = stroke.points.front();
    Stroke& before = strokes_.back();
    const bool again =
        before.points.size() == 1 && before.tool == stroke.tool && !moves_across(before.points.front(), at);
    if (again) {
        before = before.points.front().z() > at.z() ? std::move(stroke) : before;
    } else if (!in_the_air(at.z())) {
        strokes_.push_back(std::move(stroke));
    }
}

void CutProgramBuilder::change_tool(int tool) {
    close_stroke();
    tool_ = tool > 0 ? tool : tool_;
    if (!made_.path.empty() && made_.path.back().tool != tool_) {
        append(at_, 0.0, plot::CutMove::tool_change);
    }
}

void CutProgramBuilder::turn_spindle(const program::Block& block) {
    if (!(block.spindle_rpm > 0.0 || block.spindle_rpm < 0.0)) {
        return;
    }
    if (!(made_.spindle_rpm > 0.0)) {
        made_.spindle_rpm = std::abs(block.spindle_rpm);
    }
    if (std::abs(block.spindle_rpm) > made_.spindle_rpm || std::abs(block.spindle_rpm) < made_.spindle_rpm) {
        leave_out(block, "a second spindle speed");
    }
    if (block.spindle_rpm < 0.0) {
        leave_out(block, "reverse spindle rotation");
    }
}

void CutProgramBuilder::leave_out(const program::Block& block, const char* what) {
    LeftOut& found = left_out_[what];
    found.line = found.count++ == 0 ? block.source_line : found.line;
}

void CutProgramBuilder::append(const Vec3& to, double speed, plot::CutMove move) {
    made_.path.push_back({.at = to, .speed = speed, .move = move, .tool = tool_});
}

/// The pen of a tool and a height, in millionths of a millimetre; without one of all that has none.
int CutProgramBuilder::pen_of(const Stroke& stroke, const std::optional<double>& z) {
    constexpr double steps = 1e6;
    const auto key = std::pair(stroke.tool, z ? std::optional(std::llround(*z * steps)) : std::nullopt);
    const auto [found, is_new] = pens_.try_emplace(key, static_cast<int>(pens_.size()) + 1);
    if (is_new) {
        made_.levels.push_back({found->second, stroke.tool, z, stroke.cutting, stroke.plunging});
    }
    return found->second;
}

/// Of a program that cuts at the height of its rapids, too, these feeds may be cuts.
void CutProgramBuilder::tell_travel() {
    if (height_was_given_ || !(air_at_feed_ > 0.0)) {
        return;
    }
    made_.notices.push_back(
        {.place = {.file = file_, .line = first_air_},
         .message = fmt::format("{:.3f} mm of feed moves at or above z {:.3f} mm, where the program also "
                                "moves across at rapid, are treated as travel",
                                air_at_feed_,
                                made_.safe_height.value_or(0.0)),
         .hint = "set the height from which feed moves do not cut with --safe-height"});
}

void CutProgramBuilder::see_from_above(const Stroke& stroke) {
    const auto [low, high] =
        std::ranges::minmax(stroke.points, {}, [](const Vec3& point) { return point.z(); });
    std::optional<double> z = low.z();
    if (high.z() - low.z() > same_height) {
        z.reset();
        if (!made_.uneven) {
            made_.uneven =
                Diagnostic{.place = {.file = file_, .line = stroke.line},
                           .message = fmt::format(
                               "this cut changes height from z {:.3f} to {:.3f} mm", high.z(), low.z()),
                           .hint = {}};
        }
    }
    plot::Stroke drawn;
    drawn.pen = pen_of(stroke, z);
    for (const Vec3& point : stroke.points) {
        drawn.points.emplace_back(point.head<2>());
    }
    made_.strokes.push_back(std::move(drawn));
}

} // namespace millwright::gcode::internal
