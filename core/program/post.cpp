#include "core/program/post.h"

#include "core/base/error.h"
#include "core/kinematics/forward.h"
#include "core/kinematics/inverse.h"
#include "core/program/internal/clearance.h"
#include "core/program/number_format.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace millwright::program {

namespace {

using kinematics::AxisPositions;
using kinematics::MachineModel;
using toolpath::AxisPath;
using toolpath::Toolpath;

/// Length of the way of the tip on the part while the axes go straight from `a` to `b`.
double tip_way(const MachineModel& machine, const AxisPositions& a, const AxisPositions& b) {
    constexpr int chords = 8; // of an arc of 30 deg they miss 1e-4 of its length
    double length = 0.0;
    Vec3 last = kinematics::forward(machine, a).tip;
    for (int k = 1; k <= chords; ++k) {
        const Vec3 tip = kinematics::forward(machine, a + static_cast<double>(k) / chords * (b - a)).tip;
        length += (tip - last).norm();
        last = tip;
    }
    return length;
}

double shortest_duration(const MachineModel& machine, const AxisPositions& a, const AxisPositions& b) {
    double duration = 0.0;
    for (int n = 0; n < machine.axis_count(); ++n) {
        duration = std::max(duration, std::abs(b[n] - a[n]) / machine.axis(n).max_velocity);
    }
    return duration;
}

/// Where axes are taken to stand before a program: at zero, or at the limit nearest to it.
AxisPositions rest_position(const MachineModel& machine) {
    AxisPositions rest = AxisPositions::Zero(machine.axis_count());
    for (int n = 0; n < machine.axis_count(); ++n) {
        rest[n] = std::clamp(0.0, machine.axis(n).min, machine.axis(n).max);
    }
    return rest;
}

class Poster {
public:
    Poster(const MachineModel& machine,
           const Toolpath& toolpath,
           const AxisPath& axes,
           const ProgramSettings& settings)
        : machine_(machine), toolpath_(toolpath), axes_(axes), settings_(settings),
          clearance_(toolpath, settings.link_clearance / 2.0), all_(AxisSet::all(machine.axis_count())) {
        Program& program = result_.program;
        program.machine = machine.name();
        for (const kinematics::MachineAxis& axis : machine.axes()) {
            program.axes.push_back({axis.letter, axis.kind});
        }
        program.start = written(machine, rest_position(machine), digits_of(settings), -1);
    }

    void comment(std::string text) { add(BlockKind::comment).text = std::move(text); }

    void switch_on() {
        if (settings_.spindle_rpm > 0.0) {
            add(BlockKind::spindle_on).spindle_rpm = settings_.spindle_rpm;
        }
        if (settings_.coolant) {
            add(BlockKind::coolant_on);
        }
    }

    void switch_off() {
        if (settings_.coolant) {
            add(BlockKind::coolant_off);
        }
        if (settings_.spindle_rpm > 0.0) {
            add(BlockKind::spindle_off);
        }
    }

    void approach() {
        const AxisPositions above = lifted(0, settings_.approach_clearance);
        rapid(retracted(machine_, here(), settings_),
              MoveRole::approach,
              AxisSet::only(retract_axis(machine_).axis));
        descend_from_safety(0, above, MoveRole::approach);
    }

    void tracks(const Progress& progress) {
        const auto tracks =
            std::count_if(toolpath_.points.begin(), toolpath_.points.end(), [](const auto& p) {
                return p.reached_by != toolpath::MoveKind::track;
            });
        int track = 1;
        comment(fmt::format("track {} of {}", track, tracks));
        for (int n = 1; n < std::ssize(toolpath_.points); ++n) {
            progress.check();
            if (toolpath_.points[static_cast<std::size_t>(n)].reached_by == toolpath::MoveKind::track) {
                cut(n);
                continue;
            }
            comment(fmt::format("track {} of {}", ++track, tracks));
            link(n);
        }
    }

    void retract() {
        const int last = static_cast<int>(toolpath_.points.size()) - 1;
        rapid(lifted(last, settings_.approach_clearance), MoveRole::retract, all_);
        rapid(retracted(machine_, here(), settings_),
              MoveRole::retract,
              AxisSet::only(retract_axis(machine_).axis));
    }

    PostResult take() {
        add(BlockKind::end);
        const bool exact = !(settings_.path_tolerance > 0.0);
        for (Block& block : result_.program.blocks) {
            if (block.moves()) {
                block.path = {exact ? PathMode::exact_path : PathMode::continuous, settings_.path_tolerance};
            }
        }
        return std::move(result_);
    }

private:
    const MachineModel& machine_;
    const Toolpath& toolpath_;
    const AxisPath& axes_;
    const ProgramSettings& settings_;
    internal::Clearance clearance_;
    AxisSet all_;
    PostResult result_;

    [[nodiscard]] const AxisPositions& here() const {
        return position_before(result_.program, result_.program.block_count());
    }

    Block& add(BlockKind kind) {
        const AxisPositions where = here();
        Block& block = result_.program.blocks.emplace_back();
        block.kind = kind;
        block.target = where;
        return block;
    }

    /// The target as it will be written; nothing if the axes are there already.
    std::optional<AxisPositions> new_target(const AxisPositions& target) const {
        const AxisPositions rounded =
            written(machine_, target, digits_of(settings_), result_.program.block_count());
        const bool same = (rounded - here()).cwiseAbs().maxCoeff() <= 0.0;
        return same ? std::nullopt : std::optional(rounded);
    }

    void rapid(const AxisPositions& target, MoveRole role, AxisSet named) {
        const AxisPositions rounded =
            written(machine_, target, digits_of(settings_), result_.program.block_count());
        Block& block = add(BlockKind::rapid);
        block.role = role;
        block.named = named;
        block.target = rounded;
    }

    /// The tip moves at `speed` on average, or as fast as the axes can. Returns the length of its way.
    double feed(const AxisPositions& target, MoveRole role, double speed, int path_point) {
        const std::optional<AxisPositions> rounded = new_target(target);
        if (!rounded) {
            return 0.0;
        }
        const double way = tip_way(machine_, here(), *rounded);
        const double shortest = shortest_duration(machine_, here(), *rounded);
        const double duration = written_duration(std::max(way / speed, shortest));
        result_.notes.slowed_moves += shortest > way / speed ? 1 : 0;
        Block& block = add(BlockKind::feed);
        block.role = role;
        block.named = all_;
        block.target = *rounded;
        block.duration = duration;
        block.feed = way / duration;
        block.path_point = path_point;
        return way;
    }

    [[nodiscard]] const AxisPositions& at(int n) const {
        return axes_.positions[static_cast<std::size_t>(n)];
    }

    /// Above point `n` along the tool's axis, rotary axes as in `n`.
    [[nodiscard]] AxisPositions lifted(int n, double height) const {
        const geometry::ToolPose& pose = toolpath_.points[static_cast<std::size_t>(n)].pose;
        return kinematics::with_tip_at(machine_, at(n), pose.tip + height * pose.axis);
    }

    void cut(int n) {
        ++result_.notes.cut_moves;
        result_.notes.cut_length += feed(at(n), MoveRole::cut, settings_.cutting_feed, n);
    }

    void link(int n) {
        ++result_.notes.links;
        const bool lifts =
            toolpath_.points[static_cast<std::size_t>(n)].reached_by == toolpath::MoveKind::over;
        if (settings_.link == LinkKind::on_surface && !lifts) {
            feed(at(n), MoveRole::link, settings_.cutting_feed, n);
            return;
        }
        constexpr int most_doublings = 4;
        double height = settings_.link_clearance;
        for (int doublings = 0; doublings <= most_doublings; ++doublings, height *= 2.0) {
            const AxisPositions up = lifted(n - 1, height);
            const AxisPositions above = lifted(n, height);
            if (inside_limits(machine_, up) && inside_limits(machine_, above) &&
                clearance_.clear(machine_, up, above)) {
                result_.notes.raised_links += doublings > 0 ? 1 : 0;
                rapid(up, MoveRole::link, all_);
                rapid(above, MoveRole::link, all_);
                plunge(n);
                return;
            }
        }
        ++result_.notes.safe_height_links;
        rapid(retracted(machine_, here(), settings_), MoveRole::link, all_);
        descend_from_safety(n, lifted(n, settings_.link_clearance), MoveRole::link);
    }

    /// From the safe position, wherever the other axes are, to `above`, then down to point `n`.
    void descend_from_safety(int n, const AxisPositions& above, MoveRole role) {
        const RetractAxis retract = retract_axis(machine_);
        const AxisPositions over = retracted(machine_, above, settings_);
        if (retract.sense * (over[retract.axis] - above[retract.axis]) < 0.0) {
            throw Error(
                fmt::format("the safe position {:.3f} of axis {} is below the approach to path point {} at "
                            "{:.3f}",
                            over[retract.axis],
                            machine_.axis(retract.axis).letter,
                            n,
                            above[retract.axis]),
                {},
                "retract further, lower the clearances, or move the part on the table");
        }
        if (!clearance_.clear(machine_, here(), over) || !clearance_.clear(machine_, over, above)) {
            throw Error(
                fmt::format("no path from the safe position to path point {} is clear of the part", n),
                {},
                "retract further, or move the part on the table");
        }
        rapid(over, role, all_);
        rapid(above, role, all_);
        plunge(n);
    }

    void plunge(int n) { feed(at(n), MoveRole::plunge, settings_.plunge_feed, n); }
};

} // namespace

PostResult post(const MachineModel& machine,
                const Toolpath& toolpath,
                const AxisPath& axes,
                const ProgramSettings& settings,
                const std::vector<HeaderLine>& header,
                const Progress& progress) {
    expects(!toolpath.points.empty(), "a program is made of a tool path with points");
    expects(toolpath.points.size() == axes.positions.size(), "axis positions belong to their tool path");
    check(settings);
    Poster poster(machine, toolpath, axes, settings);
    for (const HeaderLine& line : header) {
        poster.comment(line.label + ": " + line.text);
    }
    poster.switch_on();
    poster.approach();
    poster.tracks(progress);
    poster.retract();
    poster.switch_off();
    return poster.take();
}

} // namespace millwright::program
