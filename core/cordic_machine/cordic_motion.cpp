#include "core/cordic_machine/cordic_motion.h"

#include "core/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace millwright::cordic_machine {
namespace {

using cordic::Commanded;
using cordic::Opcode;
using kinematics::AxisPositions;
using kinematics::MachineModel;

constexpr double seconds_per_microsecond = 1e-6;
constexpr int linear_axes = 3;

class SetPointMotion {
public:
    SetPointMotion(const cordic::Processor& processor,
                   const CordicProgram& made,
                   const MachineModel& machine,
                   const AxisPositions& start,
                   const std::filesystem::path& file,
                   double most_acceleration)
        : processor_(processor), made_(made), file_(file), most_acceleration_(most_acceleration) {
        program_.machine = machine.name();
        for (const kinematics::MachineAxis& axis : machine.axes()) {
            program_.axes.push_back({axis.letter, axis.kind});
        }
        for (std::size_t n = 0; n < axes_.size(); ++n) {
            axes_[n] = machine.axis_index(gcode::axis_letters[n]);
            if (axes_[n] < 0) {
                throw Error(
                    fmt::format("machine '{}' has no axis {}", machine.name(), gcode::axis_letters[n]));
            }
            named_.insert(axes_[n]);
        }
        program_.start = start;
        at_ = start;
    }

    CordicMotion motion() {
        const auto& set_points = processor_.published();
        const auto& commands = processor_.commanded();
        std::size_t next = 0;
        for (std::size_t n = 0; n <= set_points.size(); ++n) {
            for (; next < commands.size() && commands[next].behind_set_points == static_cast<std::int64_t>(n);
                 ++next) {
                command(commands[next], next);
            }
            if (n < set_points.size()) {
                move(set_points[n], n);
            }
        }
        if (program_.blocks.empty() || program_.blocks.back().kind != program::BlockKind::end) {
            add(program::BlockKind::end, 0);
        }
        return {std::move(program_), std::move(accelerations_)};
    }

private:
    const cordic::Processor& processor_;
    const CordicProgram& made_;
    const std::filesystem::path& file_;
    double most_acceleration_;
    program::Program program_;
    std::vector<double> accelerations_;
    std::array<int, linear_axes> axes_{};
    program::AxisSet named_;
    AxisPositions at_;

    /// Of assembler text; 0 of an image.
    [[nodiscard]] int line_of(cordic::CodeAddress address) const {
        return cordic::line_at(made_.code_lines, address).line;
    }

    program::Block& add(program::BlockKind kind, int line) {
        program::Block& block = program_.blocks.emplace_back();
        accelerations_.push_back(std::numeric_limits<double>::infinity());
        block.kind = kind;
        block.target = at_;
        block.source_line = line;
        return block;
    }

    void pause(program::PauseKind kind, std::string text, int line) {
        program::Block& block = add(program::BlockKind::pause, line);
        block.pause = kind;
        block.text = std::move(text);
    }

    void move(const cordic::Published& record, std::size_t n) {
        const auto set = processor_.set_point(record);
        const auto height = processor_.height_point(record);
        const int line = n < made_.points.size() ? made_.points[n].line : line_of(record.instruction_at);
        const std::array<double, linear_axes> to{set.x, set.y, height.z};
        double squares = 0.0;
        for (std::size_t axis = 0; axis < to.size(); ++axis) {
            squares += std::pow(to[axis] - at_[axes_[axis]], 2);
            at_[axes_[axis]] = to[axis];
        }
        const double length = std::sqrt(squares);
        if (!(length > 0.0)) {
            return; // nothing to do
        }
        const double speed = std::hypot(set.vx, set.vy, height.vz);
        const double acceleration = std::hypot(set.ax, set.ay, height.az);
        if (!(speed > 0.0 && acceleration > 0.0)) {
            throw Error(Diagnostic{
                {file_, line, 0, -1},
                fmt::format("set-point {} is {:.6g} mm away but has no {}: it was rounded to 0 in {}",
                            n + 1,
                            length,
                            speed > 0.0 ? "acceleration" : "speed",
                            cordic::to_text(processor_.format())),
                "choose a number format with more fraction bits"});
        }
        program::Block& block = add(program::BlockKind::feed, line);
        block.named = named_;
        block.feed = speed;
        block.duration = length / speed;
        accelerations_.back() = std::min(acceleration, most_acceleration_);
    }

    void command(const Commanded& command, std::size_t n) {
        const int line =
            n < made_.command_lines.size() ? made_.command_lines[n] : line_of(command.instruction_at);
        const double parameter = command.parameter;
        switch (command.opcode) {
        case Opcode::g04:
            add(program::BlockKind::dwell, line).duration = parameter * seconds_per_microsecond;
            return;
        case Opcode::m00:
            pause(program::PauseKind::program_stop, "program stop", line);
            return;
        case Opcode::m01:
            pause(program::PauseKind::optional_stop, "optional stop", line);
            return;
        case Opcode::m03:
        case Opcode::m04:
            add(program::BlockKind::spindle_on, line).spindle_rpm =
                command.opcode == Opcode::m03 ? parameter : -parameter;
            return;
        case Opcode::m05:
            add(program::BlockKind::spindle_off, line);
            return;
        case Opcode::m06:
            pause(program::PauseKind::tool_change, fmt::format("change to tool {}", command.parameter), line);
            return;
        case Opcode::m07:
        case Opcode::m08:
            add(program::BlockKind::coolant_on, line);
            return;
        case Opcode::m09:
            add(program::BlockKind::coolant_off, line);
            return;
        case Opcode::m02:
        case Opcode::m30:
            add(program::BlockKind::end, line);
            return;
        default:
            add(program::BlockKind::comment, line).text = fmt::format("M{}", command.parameter);
        }
    }
};

} // namespace

double greatest_acceleration(const cordic::Processor& processor) {
    double greatest = 0.0;
    for (const cordic::Published& record : processor.published()) {
        const auto set = processor.set_point(record);
        greatest = std::max(greatest, std::hypot(set.ax, set.ay, processor.height_point(record).az));
    }
    return greatest;
}

MachineModel cordic_machine(double acceleration, double jerk) {
    constexpr double fastest = 1e6; // mm/s: more than any program asks for
    kinematics::MachineDescription description;
    description.name = "cordic";
    description.source = "limits of the records";
    const std::array<Vec3, linear_axes> directions{Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
    for (std::size_t n = 0; n < directions.size(); ++n) {
        kinematics::MachineAxis axis;
        axis.letter = gcode::axis_letters[n];
        axis.direction = directions[n];
        axis.max_velocity = fastest;
        axis.max_acceleration = acceleration;
        if (jerk > 0.0) {
            axis.max_jerk = jerk;
        }
        description.head.push_back(axis);
    }
    return MachineModel(std::move(description));
}

CordicMotion cordic_motion(const cordic::Processor& processor,
                           const CordicProgram& made,
                           const MachineModel& machine,
                           const AxisPositions& start,
                           const std::filesystem::path& file,
                           double most_acceleration) {
    return SetPointMotion(processor, made, machine, start, file, most_acceleration).motion();
}

} // namespace millwright::cordic_machine
