#include "core/drivers/virtual_machine/internal/manual_control.h"

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/drivers/mdi_lines.h"
#include "core/drivers/modal_lines.h"
#include "core/gcode/interpreter.h"
#include "core/gcode_programs/machine_program.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <utility>

namespace millwright::drivers::internal {

using gcode::AxisValues;
using kinematics::AxisKind;
using kinematics::AxisPositions;
using kinematics::MachineAxis;
using kinematics::MachineModel;
using program::Block;
using program::BlockKind;

namespace {

constexpr int first_g28 = 5161;
constexpr int first_g30 = 5181;
constexpr int g92_active = 5210;
constexpr int first_g92 = 5211;
constexpr int first_system = 5221; ///< G54; the others follow in steps of `system_stride`
constexpr int system_stride = 20;
constexpr int systems = 9;

std::size_t index_of(char letter) {
    return static_cast<std::size_t>(std::ranges::find(gcode::axis_letters, letter) -
                                    gcode::axis_letters.begin());
}

/// Flow control belongs in programs: a single line has nothing to jump to.
void refuse_o_words(const std::string& lines) {
    bool at_start = true;
    for (const char c : lines) {
        if (at_start && (c == 'o' || c == 'O')) {
            throw Error("O-words are allowed in programs, not in single lines");
        }
        at_start = c == '\n' || (at_start && (std::isspace(static_cast<unsigned char>(c)) != 0));
    }
}

} // namespace

HandControl::HandControl(std::shared_ptr<const MachineModel> model) : model_(std::move(model)) {
    expects(model_ != nullptr, "there is a machine to control");
}

program::Program HandControl::read(const std::string& lines, const AxisPositions& position) {
    refuse_o_words(lines);
    const bool straight = state_.motion == 0 || state_.motion == 10;
    const std::string modes = modal_lines(state_, gcode::Dialect::linuxcnc) +
                              (straight ? fmt::format("G{}\n", state_.motion / 10) : "");
    const auto count = [](const std::string& text) { return std::ranges::count(text, '\n'); };
    const auto before = static_cast<int>(count(modes));
    const std::string text = modes + lines + "\n";

    gcode::ReaderSettings settings;
    settings.any_tool = true;
    settings.parameters.assign(parameters_.begin(), parameters_.end());
    for (int n = 0; n < model_->axis_count(); ++n) {
        const MachineAxis& axis = model_->axis(n);
        settings.start[index_of(axis.letter)] =
            axis.kind == AxisKind::rotary ? to_degrees(position[n]) : position[n];
    }
    gcode::MachineProgramSettings target;
    target.start = position;
    gcode::MachineProgramBuilder builder(*model_, {}, target);
    gcode::Interpreter reader(std::string_view(text), {}, std::move(settings), builder);
    const auto all = count(text);
    for (std::ptrdiff_t n = 0; n < all && reader.step(); ++n) {
    }
    gcode::MachineProgram made = builder.take();
    std::vector<Diagnostic> faults = reader.errors();
    faults.insert(faults.end(), made.faults.begin(), made.faults.end());
    if (!faults.empty()) {
        faults.front().place.line = std::max(0, faults.front().place.line - before);
        throw Error(faults.front());
    }
    check_limits(made.program);
    state_ = reader.state();
    for (int number = first_g28; number < first_system + systems * system_stride; ++number) {
        parameters_[number] = reader.parameter(number);
    }
    return std::move(made.program);
}

void HandControl::check_limits(const program::Program& program) const {
    for (const Block& block : program.blocks) {
        for (int n = 0; n < model_->axis_count(); ++n) {
            const MachineAxis& axis = model_->axis(n);
            const bool inside = block.target[n] >= axis.min && block.target[n] <= axis.max;
            if (!inside) {
                const bool rotary = axis.kind == AxisKind::rotary;
                const auto shown = [&](double value) { return rotary ? to_degrees(value) : value; };
                throw Error(fmt::format("axis {} would move to {:.3f}, outside {:.3f} ... {:.3f} {}",
                                        axis.letter,
                                        shown(block.target[n]),
                                        shown(axis.min),
                                        shown(axis.max),
                                        rotary ? "deg" : "mm"));
            }
        }
    }
}

AxisPositions HandControl::axes_of(const AxisValues& values) const {
    AxisPositions axes = AxisPositions::Zero(model_->axis_count());
    for (int n = 0; n < model_->axis_count(); ++n) {
        const double value = values[index_of(model_->axis(n).letter)];
        axes[n] = model_->axis(n).kind == AxisKind::rotary ? from_degrees(value) : value;
    }
    return axes;
}

AxisPositions HandControl::work_offset() const {
    const AxisValues offset = state_.g5x_offset + state_.g92_offset + state_.tool_offset;
    return axes_of(state_.unit == gcode::LengthUnit::inch ? offset.lengths_scaled(gcode::mm_per_inch)
                                                          : offset);
}

std::vector<StoredOffset> HandControl::stored_offsets() const {
    const auto values = [this](int first) {
        AxisValues result;
        for (std::size_t n = 0; n < gcode::axis_count; ++n) {
            const auto found = parameters_.find(first + static_cast<int>(n));
            result[n] = found == parameters_.end() ? 0.0 : found->second;
        }
        return axes_of(result);
    };
    std::vector<StoredOffset> table;
    for (int system = 1; system <= systems; ++system) {
        table.push_back({work_system_name(system), values(first_system + (system - 1) * system_stride)});
    }
    const auto active = parameters_.find(g92_active);
    const bool g92 = active != parameters_.end() && active->second > 0.0;
    table.push_back({"G28", values(first_g28)});
    table.push_back({"G30", values(first_g30)});
    table.push_back({"G92", g92 ? values(first_g92) : AxisPositions::Zero(model_->axis_count())});
    return table;
}

std::string HandControl::modes() const {
    std::string text = modal_lines(state_, gcode::Dialect::linuxcnc);
    std::ranges::replace(text, '\n', ' ');
    text.pop_back();
    return text;
}

program::Program straight_program(const MachineModel& model,
                                  const AxisPositions& from,
                                  const AxisPositions& to,
                                  double speed) {
    program::Program program;
    program.machine = model.name();
    program.start = from;
    double linear = 0.0;
    double angular = 0.0;
    for (int n = 0; n < model.axis_count(); ++n) {
        program.axes.push_back({model.axis(n).letter, model.axis(n).kind});
        double& sum = model.axis(n).kind == AxisKind::linear ? linear : angular;
        sum = std::hypot(sum, to[n] - from[n]);
    }
    Block move;
    move.kind = speed > 0.0 ? BlockKind::feed : BlockKind::rapid;
    move.target = to;
    move.named = program::AxisSet::all(model.axis_count());
    const double way = linear > 0.0 ? linear : angular;
    move.duration = speed > 0.0 ? way / speed : 0.0;
    move.feed = linear > 0.0 ? speed : 0.0;
    if (way > 0.0) {
        program.blocks.push_back(move);
    }
    Block end;
    end.kind = BlockKind::end;
    end.target = to;
    program.blocks.push_back(end);
    return program;
}

double reach_within_limits(const MachineModel& model, const AxisPositions& from, const AxisPositions& way) {
    double reach = 1.0;
    for (int n = 0; n < model.axis_count(); ++n) {
        const double end = way[n] > 0.0 ? model.axis(n).max : model.axis(n).min;
        if (std::abs(way[n]) > 0.0 && std::isfinite(end)) {
            reach = std::min(reach, (end - from[n]) / way[n]);
        }
    }
    return std::max(0.0, reach);
}

} // namespace millwright::drivers::internal
