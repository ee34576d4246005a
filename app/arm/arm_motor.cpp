#include "app/arm/arm_command.h"
#include "app/command_line/arm_choice.h"
#include "app/drivers/pmac_connection.h"
#include "core/base/error.h"
#include "core/base/files.h"
#include "core/base/text.h"
#include "core/pmac/driver/arm_axes.h"
#include "core/pmac_service/direction_check.h"
#include "core/pmac_service/offset_finder.h"
#include "core/pmac_service/step_test.h"
#include "ui/render/picture.h"
#include "ui/viewport/chart_picture.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <optional>
#include <string>

namespace millwright::app {

namespace {

struct ArmMotorOptions {
    int motor = 1;
    std::string port;
    std::string arm = "motoman-l3";
    bool apply = false;
    std::optional<int> from;
    double most_way = pmac::OffsetSearch().most_way;
    pmac::StepTest step;
    pmac::DirectionCheck direction;
    bool power = false; ///< a person has looked: the motors may have power
    std::string out;
    std::string picture;
};

int offset(const ArmMotorOptions& options) {
    PmacConnection connection(options.port, options.arm);
    connection.let_lines_give_power(); // to the motor that creeps
    pmac::OffsetSearch search;
    search.from = options.from;
    search.most_way = options.most_way;
    const pmac::OffsetFound found = pmac::find_offset(connection.card(), options.motor, search);
    fmt::print("motor {}: creeps backward up to Ix29 = {}, forward from {}; the middle is {} (it was {})\n"
               "at most {:.0f} counts from its start position; the motor is disabled now\n",
               options.motor,
               found.backward,
               found.forward,
               found.middle,
               found.before,
               found.farthest);
    if (options.apply) {
        set_motor_variable(connection.card(), options.motor, 29, found.middle);
        fmt::print("I{}29={}; use SAVE to keep it\n", options.motor, found.middle);
    }
    return 0;
}

std::string csv(const pmac::StepResponse& response) {
    std::string text = "seconds,counts\n";
    for (const pmac::StepReading& reading : response.readings) {
        text += fmt::format("{},{}\n", fixed(reading.time, 4), fixed(reading.position, 1));
    }
    return text;
}

void draw(const pmac::StepResponse& response, const ArmMotorOptions& options) {
    viewport::ChartLine is{"position", {0.0}, {0.0}};
    viewport::ChartLine should{"command", {0.0}, {response.size}};
    for (const pmac::StepReading& reading : response.readings) {
        is.x.push_back(reading.time);
        is.y.push_back(reading.position);
        should.x.push_back(reading.time);
        should.y.push_back(response.size);
    }
    const viewport::Chart chart{
        fmt::format("motor {}: response to a step of {:.0f} counts", options.motor, response.size),
        "s",
        "position",
        "counts",
        false,
        {should, is}};
    constexpr render::PixelSize size{1000, 600};
    render::write_png(viewport::chart_picture({chart}, size, render::Theme::light), options.picture);
}

std::string seconds(double time) {
    return time < 0.0 ? std::string("never") : fmt::format("{:.3f} s", time);
}

/// Throws Error for a step that the driver makes a ramp of.
void expect_step(const ArmMotorOptions& options) {
    for (const pmac::PmacAxis& axis : pmac::five_axis_arm_settings().axes) {
        const double degrees = std::abs(options.step.size) / axis.counts_per_degree;
        if (axis.motor == options.motor && degrees > pmac::pmac_step_deg) {
            throw Error(
                fmt::format(
                    "a step of {:.0f} counts is {:.1f} degrees, but jogs beyond {} degrees are slowed down",
                    options.step.size,
                    degrees,
                    pmac::pmac_step_deg),
                {},
                fmt::format("use --size {:.0f} or less",
                            std::floor(pmac::pmac_step_deg * axis.counts_per_degree)));
        }
    }
}

int step(const ArmMotorOptions& options) {
    expect_step(options);
    PmacConnection connection(options.port, options.arm);
    if (options.power) {
        connection.give_power();
    }
    const pmac::StepResponse response = pmac::step_test(connection.card(), options.motor, options.step);
    fmt::print("motor {}: rise {}, overshoot {:.1f} %, settled {}, {:+.1f} counts at the end\n",
               options.motor,
               seconds(response.rise_time),
               100.0 * response.overshoot,
               seconds(response.settling_time),
               response.error);
    std::string variables;
    for (const auto& [number, value] : response.variables) {
        variables += fmt::format(" I{}{:02}={}", options.motor, number, shortest(value));
    }
    fmt::print("with{} (values restored)\nto change: {}\n", variables, response.advice);
    if (!options.out.empty()) {
        write_file(options.out, csv(response));
    }
    if (!options.picture.empty()) {
        draw(response, options);
    }
    return 0;
}

int direction(const ArmMotorOptions& options) {
    PmacConnection connection(options.port, options.arm);
    if (options.power) {
        connection.give_power();
    }
    const pmac::DirectionFound found =
        pmac::direction_check(connection.card(), options.motor, options.direction);
    fmt::print("motor {}: {}{} gave {:+.0f} counts in a jog, {:+.0f} in a program: {}\n",
               options.motor,
               found.axis,
               shortest(options.direction.way),
               found.jog,
               found.program,
               found.agree ? "same direction" : "NOT the same direction");
    if (!found.agree) {
        fmt::print("Its axis is defined by {} counts: check the sign, the motor power and the encoder.\n",
                   shortest(found.scale));
    }
    return found.agree ? 0 : 1;
}

CLI::App& add_motor_subcommand(CLI::App& group,
                               const char* name,
                               const char* text,
                               const std::shared_ptr<ArmMotorOptions>& options) {
    CLI::App& command = *group.add_subcommand(name, text);
    command.add_option("MOTOR", options->motor, "1 to 8")->required()->check(CLI::Range(1, 8));
    command.add_option("--port", options->port, "Serial port, or tcp:HOST:PORT of the PMAC")
        ->required()
        ->type_name("PORT");
    add_arm_option(command, options->arm);
    return command;
}

void add_power(CLI::App& command, const std::shared_ptr<ArmMotorOptions>& options) {
    command.add_flag(
        "--power", options->power, "Allow the arm's motors to be enabled (operator has checked the arm)");
}

} // namespace

void add_arm_motor_commands(CLI::App& group, Command& chosen) {
    const auto options = std::make_shared<ArmMotorOptions>();
    CLI::App& still = add_motor_subcommand(
        group,
        "offset",
        "Find the output offset at which a motor does not move (Ix29). The motor creeps!",
        options);
    still.add_flag("--apply", options->apply, "Set Ix29 to the result");
    still.add_option("--from", options->from, "Initial offset, bits (default: the current Ix29)")
        ->check(CLI::Range(-32767, 32767));
    still.add_option("--most-way", options->most_way, "Travel at which the search is given up, counts")
        ->check(CLI::Range(100.0, 1e9))
        ->capture_default_str();
    still.callback([&chosen, options] { chosen = [options] { return offset(*options); }; });
    CLI::App& way =
        add_motor_subcommand(group,
                             "direction",
                             "Check that jogs and programs move in the same direction. The motor moves!",
                             options);
    way.add_option("--way", options->direction.way, "Travel there and back, degrees")
        ->check(CLI::Range(0.01, 10.0))
        ->capture_default_str();
    add_power(way, options);
    way.callback([&chosen, options] { chosen = [options] { return direction(*options); }; });
    CLI::App& answer = add_motor_subcommand(
        group, "step", "Measure a motor's step response and suggest changes. The motor moves!", options);
    answer.add_option("--size", options->step.size, "Step size there and back, counts")
        ->check(CLI::Range(-1e4, 1e4))
        ->capture_default_str();
    answer.add_option("--seconds", options->step.duration, "Recording time, s")
        ->check(CLI::Range(0.05, 60.0))
        ->capture_default_str();
    answer.add_option("--out", options->out, "Output file for the readings: seconds,counts")
        ->type_name("CSV");
    answer.add_option("--picture", options->picture, "Output file for a plot of the readings")
        ->type_name("PNG");
    add_power(answer, options);
    answer.callback([&chosen, options] { chosen = [options] { return step(*options); }; });
}

} // namespace millwright::app
