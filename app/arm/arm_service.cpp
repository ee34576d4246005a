#include "app/arm/arm_command.h"
#include "core/base/counted.h"
#include "core/base/error.h"
#include "core/base/files.h"
#include "core/base/numbers.h"
#include "core/pmac_service/maestro_amplifier.h"
#include "core/pmac_service/pmac_wiring.h"
#include "core/pmac_service/scale_calibration.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <memory>
#include <optional>
#include <span>
#include <string>

namespace millwright::app {

namespace {

struct ArmServiceOptions {
    std::string file;
    bool json = false;
    int motor = 0; ///< 0: all
    double max_rpm = 0.0, tacho = 0.0;
    double nominal = 0.0, limit = 0.0, peak = 0.0;
};

int calibrate(const ArmServiceOptions& options) {
    const auto fits = pmac::fit_scales(pmac::parse_scale_readings(read_file(options.file), options.file));
    if (fits.empty()) {
        throw Error(Diagnostic{.place = {.file = options.file},
                               .message = "there are no readings",
                               .hint = "write lines of: motor counts angle"});
    }
    auto list = nlohmann::ordered_json::array();
    for (const pmac::ScaleFit& fit : fits) {
        if (options.json) {
            list.push_back({{"motor", fit.motor},
                            {"counts_per_deg", fit.counts_per_degree},
                            {"counts_at_zero", fit.counts_at_zero},
                            {"counts_per_deg_error", fit.counts_per_degree_error},
                            {"rms_deg", fit.rms},
                            {"worst_deg", fit.worst},
                            {"worst_line", fit.worst_line},
                            {"readings", fit.readings}});
            continue;
        }
        fmt::print("motor {}: {:.4f} counts per degree (+- {:.4f}), {:.1f} counts at 0 deg; {}, {:.3f} deg "
                   "rms, at most {:+.3f} deg in line {}\n",
                   fit.motor,
                   fit.counts_per_degree,
                   fit.counts_per_degree_error,
                   fit.counts_at_zero,
                   counted(fit.readings, "reading"),
                   fit.rms,
                   fit.worst,
                   fit.worst_line);
    }
    if (options.json) {
        fmt::print("{}\n", list.dump(2));
    }
    return 0;
}

std::string kilo_ohms(const std::optional<double>& value) {
    return value ? fmt::format("{:.2f} kOhm", *value) : std::string("none fitted");
}

void print_resistor_table(std::span<const pmac::FittedResistor> table, double peak, double current) {
    for (const pmac::FittedResistor& row : table) {
        if (exactly_equal(row.peak, peak) &&
            exactly_equal(row.current, current)) { // typed as they stand there
            fmt::print("  in the table of model {}: {}\n", row.model, kilo_ohms(row.kilo_ohm));
        }
    }
}

void print_speed(const ArmServiceOptions& options) {
    const auto speed = pmac::speed_resistor(options.max_rpm, options.tacho);
    fmt::print("RT  (speed): {}\n",
               !speed         ? "none: use a tachometer with a higher constant"
               : *speed > 0.0 ? fmt::format("{:.0f}", *speed)
                              : "a bridge");
    const auto loss = pmac::tacho_loss_resistor(options.max_rpm, options.tacho);
    fmt::print("RRT (tachometer loss; switch 3 on first): {}\n",
               loss ? fmt::format("{:.0f}", *loss) : "none");
}

int amplifier(const ArmServiceOptions& options) {
    if (options.peak > 0.0 && !(std::max(options.nominal, options.limit) <= options.peak)) {
        throw Error(fmt::format(
            "the peak current of the amplifier, {} A, is below the peak current limit of the motor",
            options.peak));
    }
    if (options.nominal > 0.5 * options.peak && options.nominal > 0.0) {
        throw Error(
            fmt::format("an amplifier of {} A peak supplies {} A continuously without RIN: less than {} A",
                        options.peak,
                        0.5 * options.peak,
                        options.nominal));
    }
    if (options.max_rpm > 0.0) {
        print_speed(options);
    }
    if (options.nominal > 0.0) {
        const auto value = pmac::nominal_current_resistor(options.nominal, options.peak);
        fmt::print("RIN (nominal current): {} (as printed {})\n",
                   kilo_ohms(value.corrected),
                   kilo_ohms(value.printed));
        print_resistor_table(pmac::nominal_current_table(), options.peak, options.nominal);
    }
    if (options.limit > 0.0) {
        const double nominal = options.nominal > 0.0 ? options.nominal : options.peak / 2.0;
        const auto value = pmac::peak_current_resistor(nominal, options.limit, options.peak);
        fmt::print(
            "RIP (peak current): {} (as printed {})\n", kilo_ohms(value.corrected), kilo_ohms(value.printed));
        print_resistor_table(pmac::peak_current_table(), options.peak, options.limit);
    }
    return 0;
}

/// Of the pins of `motor`, or of all of them, 0.
std::string trust_text(const pmac::PmacPin& pin, int motor) {
    const bool differs = motor == 0 && trust_of(pin, 4) != pin.trust;
    return std::string(name_of(motor == 0 ? pin.trust : trust_of(pin, motor))) +
           (differs ? " of motor 1" : "");
}

int wiring(const ArmServiceOptions& options) {
    for (const pmac::PmacPin& pin : pmac::pmac_pins()) {
        std::string numbers;
        for (int motor = 1; motor <= 4; ++motor) {
            const int number = pin.of_motor[static_cast<std::size_t>(motor - 1)];
            if (options.motor == 0 || options.motor == motor) {
                numbers += number > 0 ? fmt::format("{:>5}", number) : "    -";
            }
        }
        fmt::print("{:<11}{}  {:<21} {}\n", pin.signal, numbers, trust_text(pin, options.motor), pin.note);
    }
    fmt::print("\n");
    for (const pmac::PmacJumper& jumper : pmac::pmac_jumpers()) {
        fmt::print("{:<18}  {:<21}{}\n", jumper.jumper, name_of(jumper.trust), jumper.meaning);
    }
    return 0;
}

void add_amplifier(CLI::App& group, Command& chosen, const std::shared_ptr<ArmServiceOptions>& options) {
    CLI::App& command = *group.add_subcommand("amplifier", "Resistors for a Midi-Maestro amplifier");
    const auto amperes = CLI::Range(0.1, 1000.0);
    CLI::Option* speed = command.add_option("--max-rpm", options->max_rpm, "Maximum speed of the motor, rpm")
                             ->check(CLI::Range(1.0, 1e5));
    speed->needs(command.add_option("--tacho", options->tacho, "Tachometer constant, V per 1000 rpm")
                     ->check(CLI::Range(1e-3, 1e3)));
    CLI::Option* peak =
        command.add_option("--peak", options->peak, "Peak current of the amplifier, A")->check(amperes);
    command.add_option("--nominal", options->nominal, "Nominal current of the motor, A")
        ->check(amperes)
        ->needs(peak);
    command.add_option("--limit", options->limit, "Peak current limit of the motor, A")
        ->check(amperes)
        ->needs(peak);
    command.callback([&chosen, options] {
        if (!(options->max_rpm > 0.0 || options->nominal > 0.0 || options->limit > 0.0)) {
            throw CLI::RequiredError("--max-rpm with --tacho, or --peak with --nominal or --limit,");
        }
        chosen = [options] { return amplifier(*options); };
    });
}

} // namespace

void add_arm_service_commands(CLI::App& group, Command& chosen) {
    const auto options = std::make_shared<ArmServiceOptions>();
    CLI::App& scale =
        *group.add_subcommand("calibrate", "Counts per degree of each motor, from measured angles");
    scale.add_option("FILE", options->file, "File with lines of: motor counts angle")->required();
    scale.add_flag("--json", options->json, "Print the result as JSON");
    scale.callback([&chosen, options] { chosen = [options] { return calibrate(*options); }; });
    add_amplifier(group, chosen, options);
    CLI::App& pins = *group.add_subcommand("wiring", "Pins and jumpers of a PMAC-Lite, and first checks");
    pins.add_option("MOTOR", options->motor, "Motor, 1 to 4 (default: all)")->check(CLI::Range(1, 4));
    pins.callback([&chosen, options] { chosen = [options] { return wiring(*options); }; });
}

} // namespace millwright::app
