#include "core/pmac_service/maestro_amplifier.h"

#include "core/base/error.h"

#include <array>
#include <cmath>

namespace millwright::pmac {

namespace {

void expect_amperes(double value) {
    if (!(value > 0.0 && std::isfinite(value))) {
        throw Error("the current must be above 0 A");
    }
}

double volts(double max_rpm, double tacho) {
    if (!(max_rpm > 0.0 && tacho > 0.0 && std::isfinite(max_rpm * tacho))) {
        throw Error("the speed and the tachometer constant must be above 0");
    }
    return max_rpm / 1000.0 * tacho;
}

std::optional<double> not_below_zero(double value) {
    return value >= 0.0 ? std::optional(value) : std::nullopt;
}

constexpr std::array<FittedResistor, 11> nominal_currents{{{"8/16", 16.0, 8.0, {}},
                                                           {"8/16", 16.0, 7.0, 18.0},
                                                           {"8/16", 16.0, 6.0, 7.5},
                                                           {"8/16", 16.0, 5.0, 4.7},
                                                           {"8/16", 16.0, 4.0, 2.7},
                                                           {"14/28", 28.0, 14.0, {}},
                                                           {"14/28", 28.0, 12.0, 15.0},
                                                           {"14/28", 28.0, 10.0, 6.8},
                                                           {"14/28", 28.0, 8.0, 3.3},
                                                           {"14/28", 28.0, 6.0, 1.8},
                                                           {"14/28", 28.0, 4.0, 1.0}}};

constexpr std::array<FittedResistor, 12> peak_currents{{{"8/16", 16.0, 16.0, {}},
                                                        {"8/16", 16.0, 14.0, 12.0},
                                                        {"8/16", 16.0, 12.0, 6.8},
                                                        {"8/16", 16.0, 10.0, 3.9},
                                                        {"8/16", 16.0, 8.0, 2.2},
                                                        {"14/28", 28.0, 28.0, {}},
                                                        {"14/28", 28.0, 26.0, 15.0},
                                                        {"14/28", 28.0, 24.0, 8.6},
                                                        {"14/28", 28.0, 22.0, 6.8},
                                                        {"14/28", 28.0, 20.0, 5.6},
                                                        {"14/28", 28.0, 18.0, 3.9},
                                                        {"14/28", 28.0, 16.0, 2.7}}};

} // namespace

std::optional<double> speed_resistor(double max_rpm, double tacho) {
    return not_below_zero(200.0 * (volts(max_rpm, tacho) - 5.0));
}

std::optional<double> tacho_loss_resistor(double max_rpm, double tacho) {
    return not_below_zero(183000.0 * (0.068 * volts(max_rpm, tacho) - 1.0));
}

ResistorValue nominal_current_resistor(double nominal, double peak) {
    expect_amperes(nominal);
    expect_amperes(peak);
    const double below = 0.1925 * peak - 0.385 * nominal;
    constexpr double rounding = 1e-9;
    if (!(below > rounding)) {
        return {};
    }
    constexpr double ohm = 1000.0;
    return {10000.0 * nominal / below / ohm, 1000.0 * nominal / below / ohm};
}

ResistorValue peak_current_resistor(double nominal, double limit, double peak) {
    expect_amperes(nominal);
    expect_amperes(limit);
    expect_amperes(peak);
    if (!(limit < peak)) {
        return {};
    }
    return {2200.0 * nominal / (peak - limit), 2.2 * limit / (peak - limit)};
}

std::span<const FittedResistor> nominal_current_table() {
    return nominal_currents;
}

std::span<const FittedResistor> peak_current_table() {
    return peak_currents;
}

} // namespace millwright::pmac
