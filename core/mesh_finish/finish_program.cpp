#include "core/mesh_finish/finish_program.h"

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/kinematics/forward.h"
#include "core/kinematics/inverse.h"
#include "core/program/number_format.h"
#include "core/program/retract.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace millwright::mesh_finish {

namespace {

using kinematics::AxisPositions;
using kinematics::MachineModel;
using program::Block;
using program::BlockKind;
using program::MoveRole;

/// Where axes are taken to stand before a program: at zero, or at the limit nearest to it.
AxisPositions rest_position(const MachineModel& machine) {
    AxisPositions rest = AxisPositions::Zero(machine.axis_count());
    for (int n = 0; n < machine.axis_count(); ++n) {
        rest[n] = std::clamp(0.0, machine.axis(n).min, machine.axis(n).max);
    }
    return rest;
}

[[noreturn]] void throw_unreachable(const MachineModel& machine, const Vec3& axis, const std::string& why) {
    throw Error(fmt::format("{} cannot hold the tool along {:.4f} {:.4f} {:.4f}{}",
                            machine.name(),
                            axis.x(),
                            axis.y(),
                            axis.z(),
                            why.empty() ? why : ": " + why),
                {},
                "choose another --axis or another machine");
}

/// The axes with the rotary ones as the path needs them, at its first tip.
AxisPositions axes_at(const MachineModel& machine, const FinishPath& path) {
    const Vec3& tip = path.passes.front().tips.front();
    if (!kinematics::has_inverse(machine)) {
        throw_unreachable(machine, path.axis, "it has neither two rotary axes nor none");
    }
    if (machine.rotary_axes().empty()) {
        const AxisPositions rest = kinematics::with_tip_at(machine, rest_position(machine), tip);
        constexpr double aligned = 1e-9; // rad
        if (angle_between(kinematics::forward(machine, rest).axis, path.axis) > aligned) {
            throw_unreachable(machine, path.axis, "it has no rotary axes");
        }
        return rest;
    }
    const auto found = kinematics::inverse(machine, {tip, path.axis}, rest_position(machine));
    if (found.branches.empty()) {
        throw_unreachable(machine, path.axis, found.why);
    }
    const auto travel = [&](const AxisPositions& branch) {
        double sum = 0.0;
        for (const int rotary : machine.rotary_axes()) {
            sum += std::abs(branch[rotary]);
        }
        return sum;
    };
    return *std::min_element(found.branches.begin(), found.branches.end(), [&](const auto& a, const auto& b) {
        return travel(a) < travel(b);
    });
}

class Writer {
public:
    Writer(const MachineModel& machine, const FinishPath& path, const program::ProgramSettings& settings)
        : machine_(machine), path_(path), settings_(settings), axes_(axes_at(machine, path)),
          map_(kinematics::linear_map(machine, axes_)), inverse_columns_(map_.columns.inverse()),
          all_(program::AxisSet::all(machine.axis_count())) {
        program_.machine = machine.name();
        for (const kinematics::MachineAxis& axis : machine.axes()) {
            program_.axes.push_back({axis.letter, axis.kind});
        }
        program_.start = rounded(rest_position(machine));
    }

    void comment(std::string text) { add(BlockKind::comment).text = std::move(text); }

    void switched(bool on) {
        if (settings_.spindle_rpm > 0.0) {
            add(on ? BlockKind::spindle_on : BlockKind::spindle_off).spindle_rpm =
                on ? settings_.spindle_rpm : 0.0;
        }
        if (settings_.coolant) {
            add(on ? BlockKind::coolant_on : BlockKind::coolant_off);
        }
    }

    /// To above the first tip: the axis that pulls off first, then all others, then down.
    void approach() {
        const Vec3& tip = path_.passes.front().tips.front();
        const AxisPositions above = at(lifted(tip, path_.safe_level));
        const program::RetractAxis retract = program::retract_axis(machine_);
        const AxisPositions over = program::retracted(machine_, above, settings_);
        if (retract.sense * (over[retract.axis] - above[retract.axis]) < 0.0) {
            throw Error(fmt::format("the safe position {:.3f} of axis {} is below the top of the mesh, where "
                                    "it would be at {:.3f}",
                                    over[retract.axis],
                                    machine_.axis(retract.axis).letter,
                                    above[retract.axis]),
                        {},
                        "move the mesh on the table with --shift");
        }
        rapid(program::retracted(machine_, here(), settings_),
              MoveRole::approach,
              program::AxisSet::only(retract.axis));
        rapid(over, MoveRole::approach, all_);
        rapid(above, MoveRole::approach, all_);
        descend(tip, path_.passes.front().plunge_level, MoveRole::approach);
    }

    void pass(std::size_t n) {
        const FinishPass& pass = path_.passes[n];
        if (n > 0) {
            const FinishPass& before = path_.passes[n - 1];
            rapid(at(lifted(before.tips.back(), pass.link_level)), MoveRole::link, all_);
            const Vec3 over = lifted(pass.tips.front(), pass.link_level);
            if (path_.knows_material || pass.link_level >= path_.safe_level) {
                rapid(at(over), MoveRole::link, all_);
                descend(pass.tips.front(), pass.plunge_level, MoveRole::link);
            } else {
                feed(over, MoveRole::link, settings_.cutting_feed);
            }
        }
        feed(pass.tips.front(), MoveRole::plunge, settings_.plunge_feed);
        for (std::size_t k = 1; k < pass.tips.size(); ++k) {
            feed(pass.tips[k], MoveRole::cut, settings_.cutting_feed);
        }
    }

    void retract() {
        rapid(at(lifted(path_.passes.back().tips.back(), path_.safe_level)), MoveRole::retract, all_);
        rapid(program::retracted(machine_, here(), settings_),
              MoveRole::retract,
              program::AxisSet::only(program::retract_axis(machine_).axis));
    }

    program::Program take() {
        add(BlockKind::end);
        const bool exact = !(settings_.path_tolerance > 0.0);
        for (Block& block : program_.blocks) {
            if (block.moves()) {
                block.path = {exact ? program::PathMode::exact_path : program::PathMode::continuous,
                              settings_.path_tolerance};
            }
        }
        return std::move(program_);
    }

private:
    /// Straight down to above the material, where its thickness is known.
    void descend(const Vec3& tip, double level, MoveRole role) {
        const AxisPositions to = at(lifted(tip, level));
        if (path_.knows_material && (rounded(to) - here()).cwiseAbs().maxCoeff() > 0.0) {
            rapid(to, role, all_);
        }
    }
    [[nodiscard]] Vec3 lifted(const Vec3& tip, double level) const {
        return tip + (level - tip.dot(path_.axis)) * path_.axis;
    }
    [[nodiscard]] AxisPositions at(const Vec3& tip) const {
        AxisPositions positions = axes_;
        const Vec3 linear = inverse_columns_ * (tip - map_.tip_at_zero);
        for (int k = 0; k < 3; ++k) {
            positions[machine_.linear_axes()[static_cast<std::size_t>(k)]] = linear[k];
        }
        return positions;
    }
    [[nodiscard]] AxisPositions rounded(const AxisPositions& positions) const {
        return program::written(machine_, positions, program::digits_of(settings_), program_.block_count());
    }
    [[nodiscard]] const AxisPositions& here() const {
        return program::position_before(program_, program_.block_count());
    }
    Block& add(BlockKind kind) {
        const AxisPositions where = here();
        Block& block = program_.blocks.emplace_back();
        block.kind = kind;
        block.target = where;
        return block;
    }
    void rapid(const AxisPositions& target, MoveRole role, program::AxisSet named) {
        const AxisPositions to = rounded(target);
        Block& block = add(BlockKind::rapid);
        block.role = role;
        block.named = named;
        block.target = to;
    }
    void feed(const Vec3& tip, MoveRole role, double speed) {
        const AxisPositions to = rounded(at(tip));
        const AxisPositions from = here();
        if ((to - from).cwiseAbs().maxCoeff() <= 0.0) {
            return;
        }
        double shortest = 0.0;
        Vec3 way = Vec3::Zero();
        for (int k = 0; k < 3; ++k) {
            const int n = machine_.linear_axes()[static_cast<std::size_t>(k)];
            way += (to[n] - from[n]) * map_.columns.col(k);
            shortest = std::max(shortest, std::abs(to[n] - from[n]) / machine_.axis(n).max_velocity);
        }
        Block& block = add(BlockKind::feed);
        block.role = role;
        block.named = all_;
        block.target = to;
        block.duration = program::written_duration(std::max(way.norm() / speed, shortest));
        block.feed = way.norm() / block.duration;
    }

    const MachineModel& machine_;
    const FinishPath& path_;
    const program::ProgramSettings& settings_;
    AxisPositions axes_;
    kinematics::LinearMap map_;
    Mat3 inverse_columns_;
    program::AxisSet all_;
    program::Program program_;
};

} // namespace

program::Program finish_program(const MachineModel& machine,
                                const FinishPath& path,
                                const program::ProgramSettings& settings,
                                const std::vector<std::string>& comments,
                                const Progress& progress) {
    expects(!path.passes.empty(), "a program is made of a path with passes");
    program::check(settings);
    Writer writer(machine, path, settings);
    for (const std::string& text : comments) {
        writer.comment(text);
    }
    writer.switched(true);
    writer.approach();
    for (std::size_t n = 0; n < path.passes.size(); ++n) {
        progress.check();
        writer.pass(n);
    }
    writer.retract();
    writer.switched(false);
    return writer.take();
}

} // namespace millwright::mesh_finish
