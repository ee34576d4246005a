#include "core/gcode_programs/written_steps.h"

#include "core/base/error.h"
#include "core/base/numbers.h"
#include "core/gcode/canon_frame.h"
#include "core/gcode/interpreter.h"
#include "core/gcode_programs/programmed_feed.h"

#include <cmath>
#include <utility>

namespace millwright::gcode {

namespace {

/// The parameters of G54, as an interpreter starts with them.
std::vector<std::pair<int, double>> parameters_of(const AxisValues& work_offset) {
    constexpr int parameter_g54 = 5221;
    std::vector<std::pair<int, double>> parameters;
    for (std::size_t n = 0; n < axis_count; ++n) {
        if (!exactly_equal(work_offset[n], 0.0)) {
            parameters.emplace_back(parameter_g54 + static_cast<int>(n), work_offset[n]);
        }
    }
    return parameters;
}

class Steps final : public CanonSink {
public:
    Steps(std::filesystem::path file, const WrittenTextRules& rules)
        : file_(std::move(file)), rules_(rules), at_(rules.start) {}

    void move(const Move& move, const SourceLine&) override {
        switch (move.kind) {
        case MoveKind::traverse:
            return add_move(StepKind::rapid, move);
        case MoveKind::feed:
            return add_move(StepKind::feed, move);
        case MoveKind::arc:
            return add_move(StepKind::arc, move);
        default:
            refuse(move.source, "probing and tapping cannot be converted");
        }
    }

    void curve(const Curve& curve, const SourceLine&) override {
        refuse(curve.source, "splines cannot be converted");
    }

    void command(const Command& command, const SourceLine&) override {
        frame_.command(command);
        feed_.command(command, frame_.unit());
        switch (command.kind) {
        case CommandKind::set_spindle_speed:
            rpm_ = command.value;
            break;
        case CommandKind::start_spindle_clockwise:
            add(StepKind::spindle_on, command).value = rpm_;
            break;
        case CommandKind::start_spindle_counterclockwise:
            add(StepKind::spindle_on, command).value = -rpm_;
            break;
        case CommandKind::stop_spindle_turning:
            add(StepKind::spindle_off, command);
            break;
        case CommandKind::mist_on:
        case CommandKind::flood_on:
            add(StepKind::coolant_on, command);
            break;
        case CommandKind::flood_off: // M9 also ends the mist
            add(StepKind::coolant_off, command);
            break;
        case CommandKind::dwell:
            add(StepKind::dwell, command).value = command.value;
            break;
        case CommandKind::select_tool:
            selected_ = command.index;
            break;
        case CommandKind::change_tool:
            forget_line(command);
            add(StepKind::tool, command).value = selected_;
            break;
        case CommandKind::program_stop:
            add(StepKind::pause, command);
            break;
        case CommandKind::set_feed_mode:
            if (command.index == 1) {
                refuse(command.source, "feed per revolution cannot be converted");
            }
            break;
        case CommandKind::control_tip:
            tip_ = command.index == 1;
            break;
        case CommandKind::user_command:
            control_tip(command);
            break;
        case CommandKind::program_end:
            end(command);
            break;
        default:
            break;
        }
    }

    std::vector<WrittenStep> take() { return std::move(steps_); }

private:
    std::filesystem::path file_;
    const WrittenTextRules& rules_;
    std::vector<WrittenStep> steps_;
    CanonFrame frame_;
    ProgrammedFeed feed_;
    AxisValues at_; ///< machine positions
    double rpm_ = 0.0;
    int selected_ = 0; ///< tool number
    bool tip_ = false;

    [[noreturn]] void refuse(SourcePlace source, std::string message) const {
        throw Error({{file_, source.line, 0, -1}, std::move(message), {}});
    }

    WrittenStep& add(StepKind kind, const Command& command) {
        WrittenStep& step = steps_.emplace_back();
        step.kind = kind;
        step.line = command.source.line;
        return step;
    }

    void control_tip(const Command& command) {
        const bool on = command.index == rules_.tip_on;
        if (!on && command.index != rules_.tip_off) {
            refuse(command.source, "the effect of this M code is unknown");
        }
        tip_ = on;
    }

    /// What an end or a tool change switches off was not written.
    void forget_line(const Command& command) {
        while (!steps_.empty() && steps_.back().line == command.source.line) {
            steps_.pop_back();
        }
    }

    void end(const Command& command) {
        forget_line(command);
        add(StepKind::end, command).tip = tip_;
    }

    void add_move(StepKind kind, const Move& move) {
        const AxisValues end = frame_.to_machine(move.target);
        WrittenStep step;
        step.kind = kind;
        step.line = move.source.line;
        step.tip = tip_;
        step.target = end;
        if (kind == StepKind::arc) {
            set_arc(step, move);
        }
        if (kind != StepKind::rapid) {
            const std::optional<double> duration =
                kind == StepKind::arc ? feed_.duration(arc_length(step)) : feed_.duration(at_, end);
            if (!duration) {
                refuse(move.source, "a feed move has no feed rate");
            }
            step.value = *duration;
        }
        at_ = end;
        steps_.push_back(step);
    }

    [[nodiscard]] static std::array<Axis, 3> axes_of(Plane plane) {
        return plane == Plane::xy   ? std::array{Axis::x, Axis::y, Axis::z}
               : plane == Plane::xz ? std::array{Axis::z, Axis::x, Axis::y}
                                    : std::array{Axis::y, Axis::z, Axis::x};
    }

    /// Without rotation an arc of the program is one of the machine, all offsets added.
    void set_arc(WrittenStep& step, const Move& move) const {
        const auto [first, second, third] = axes_of(move.plane);
        AxisValues centre = move.target;
        centre[first] = move.centre_1;
        centre[second] = move.centre_2;
        centre = frame_.to_machine(centre);
        step.plane = move.plane;
        step.centre_1 = centre[first];
        step.centre_2 = centre[second];
        step.sweep = move.sweep;
    }

    [[nodiscard]] double arc_length(const WrittenStep& step) const {
        const auto [first, second, third] = axes_of(step.plane);
        const double radius = std::hypot(at_[first] - step.centre_1, at_[second] - step.centre_2);
        return std::hypot(radius * step.sweep, step.target[third] - at_[third]);
    }
};

} // namespace

std::vector<WrittenStep>
read_written_rs274(std::string_view text, const std::filesystem::path& file, const WrittenTextRules& rules) {
    ReaderSettings settings;
    settings.dialect = rules.dialect;
    settings.grbl_axes = rules.grbl_axes;
    settings.start = rules.start;
    settings.any_tool = true;
    if (rules.tool.number > 0) {
        settings.tools.tools.push_back(rules.tool);
    }
    settings.parameters = parameters_of(rules.work_offset);
    if (rules.tip_on != 0) {
        settings.remapped_m = {rules.tip_on, rules.tip_off};
    }
    Steps steps(file, rules);
    Interpreter interpreter(text, file, std::move(settings), steps);
    interpreter.run();
    if (!interpreter.errors().empty()) {
        throw Error(interpreter.errors().front());
    }
    return steps.take();
}

} // namespace millwright::gcode
