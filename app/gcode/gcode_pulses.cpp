#include "app/gcode/gcode_pulses.h"

#include "core/base/counted.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/units.h"
#include "core/motion/step_pulses.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <span>
#include <string_view>

namespace millwright::app {

namespace {

constexpr double usual_steps_per_mm = 250.0; // $100 to $102 as Grbl ships
constexpr double usual_steps_per_degree = 100.0;
constexpr double microseconds = 1e6;

/// In people's units, a mm or a degree.
struct AxisSteps {
    char letter = 'X';
    bool rotary = false;
    double steps = 0.0;

    [[nodiscard]] double per_unit() const { return rotary ? steps / from_degrees(1.0) : steps; }
};

[[noreturn]] void refuse_steps(std::string_view word) {
    throw Error(fmt::format("--steps {} does not name an axis of the machine and its steps", word),
                {},
                "write --steps X=250: steps per mm, for a rotary axis per degree");
}

void take_steps(std::string_view word, std::vector<AxisSteps>& axes) {
    const std::size_t sign = word.find('=');
    const auto axis = std::ranges::find_if(axes, [&](const AxisSteps& one) {
        return sign == 1 && std::toupper(static_cast<unsigned char>(word.front())) == one.letter;
    });
    if (axis == axes.end()) {
        refuse_steps(word);
    }
    const std::string_view number = word.substr(sign + 1);
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), axis->steps);
    constexpr double most = 1e6;
    if (error != std::errc() || end != number.data() + number.size() ||
        !(axis->steps > 0.0 && axis->steps <= most)) {
        refuse_steps(word);
    }
}

std::vector<AxisSteps> steps_of(const program::Program& program, const PulseOptions& options) {
    std::vector<AxisSteps> axes;
    for (const program::ProgramAxis& axis : program.axes) {
        const bool rotary = axis.kind == kinematics::AxisKind::rotary;
        axes.push_back({axis.letter, rotary, rotary ? usual_steps_per_degree : usual_steps_per_mm});
    }
    for (const std::string& word : options.steps) {
        take_steps(word, axes);
    }
    return axes;
}

int source_line(const program::Program& program, int block) {
    return program.blocks[static_cast<std::size_t>(block)].source_line;
}

void print_step_table(const std::vector<AxisSteps>& axes, const std::vector<motion::StepJitter>& found) {
    fmt::print("{:4} {:>14} {:>12} {:>10} {:>12} {:>12} {:>10} {:>10} {:>8}\n",
               "axis",
               "steps",
               "pulses",
               "reversals",
               "planned Hz",
               "output Hz",
               "max us",
               "rms us",
               "late");
    for (std::size_t n = 0; n < axes.size(); ++n) {
        const motion::StepJitter& axis = found[n];
        fmt::print("{:4} {:>14} {:>12} {:>10} {:>12.1f} {:>12.1f} {:>10.3f} {:>10.3f} {:>8}\n",
                   std::string(1, axes[n].letter),
                   fmt::format("{:g}/{}", axes[n].steps, axes[n].rotary ? "deg" : "mm"),
                   axis.pulses,
                   axis.reversals,
                   axis.max_frequency,
                   axis.given_frequency,
                   axis.max_jitter * microseconds,
                   axis.rms_jitter * microseconds,
                   axis.late);
    }
}

nlohmann::ordered_json
axis_steps_json(const AxisSteps& steps, const motion::StepJitter& found, const program::Program& program) {
    nlohmann::ordered_json axis;
    axis["axis"] = std::string(1, steps.letter);
    axis[steps.rotary ? "steps_per_deg" : "steps_per_mm"] = steps.steps;
    axis["pulses"] = found.pulses;
    axis["reversals"] = found.reversals;
    axis["planned_hz"] = found.max_frequency;
    axis["given_hz"] = found.given_frequency;
    axis["max_jitter_s"] = found.max_jitter;
    axis["rms_jitter_s"] = found.rms_jitter;
    axis["late"] = found.late;
    axis["over_limit"] = found.over_limit;
    axis["end_error_steps"] = found.end_error_steps;
    if (found.overrun_block >= 0) {
        axis["overrun_line"] = source_line(program, found.overrun_block);
    }
    return axis;
}

void print_sentences(const std::vector<AxisSteps>& axes,
                     const std::vector<motion::StepJitter>& found,
                     const program::Program& program,
                     const PulseOptions& options,
                     const std::string& file) {
    for (std::size_t n = 0; n < axes.size(); ++n) {
        const char letter = axes[n].letter;
        if (options.jitter_limit_us > 0.0) {
            fmt::print("{}: {} of {} off by more than {:g} us\n",
                       letter,
                       found[n].over_limit,
                       counted(found[n].pulses, "pulse"),
                       options.jitter_limit_us);
        }
        if (found[n].overrun_block >= 0) {
            fmt::print(
                stderr,
                "millwright: {}\n",
                to_text(Diagnostic{{file, source_line(program, found[n].overrun_block), 0, -1},
                                   fmt::format("from here on the timer cannot keep up with {}: {:.6g} pulses "
                                               "per second are needed, {:.6g} are possible",
                                               letter,
                                               found[n].max_frequency,
                                               options.timer_hz / static_cast<double>(options.min_interval)),
                                   "use a faster --timer, a shorter --min-interval or fewer --steps"}));
        }
    }
}

} // namespace

void add_pulse_options(CLI::App& command, PulseOptions& options) {
    command.add_option(
        "--steps",
        options.steps,
        "Steps of an axis, such as X=250: per mm (default 250), for a rotary axis per degree (default 100)");
    command.add_option("--timer", options.timer_hz, "Frequency of the pulse timer, Hz")
        ->check(CLI::Range(1.0, 1e10))
        ->capture_default_str();
    command.add_option("--min-interval", options.min_interval, "Minimum ticks between two pulses of an axis")
        ->check(CLI::Range(std::int64_t{1}, std::int64_t{1'000'000}))
        ->capture_default_str();
    command
        .add_option(
            "--jitter-limit", options.jitter_limit_us, "Count pulses that are off by more than this, us")
        ->check(CLI::Range(0.0, 1e6));
}

int report_pulses(const motion::Trajectory& trajectory,
                  const program::Program& program,
                  const PulseOptions& options,
                  const std::string& file,
                  bool json) {
    const std::vector<AxisSteps> axes = steps_of(program, options);
    motion::StepSettings settings;
    for (const AxisSteps& axis : axes) {
        settings.steps_per_unit.push_back(axis.per_unit());
    }
    settings.timer_frequency = options.timer_hz;
    settings.min_interval = options.min_interval;
    settings.jitter_limit = options.jitter_limit_us / microseconds;
    const auto pass_over = [](std::span<const motion::StepPulse>) {};
    const auto found = motion::step_pulses(trajectory, settings, pass_over, Progress());
    if (json) {
        nlohmann::ordered_json answer;
        answer["time_s"] = trajectory.duration();
        answer["timer_hz"] = options.timer_hz;
        answer["axes"] = nlohmann::ordered_json::array();
        for (std::size_t n = 0; n < axes.size(); ++n) {
            answer["axes"].push_back(axis_steps_json(axes[n], found[n], program));
        }
        fmt::print("{}\n", answer.dump(2));
    } else {
        print_step_table(axes, found);
        print_sentences(axes, found, program, options, file);
    }
    return std::ranges::any_of(found, [](const auto& axis) { return axis.overrun_block >= 0; }) ? 1 : 0;
}

} // namespace millwright::app
