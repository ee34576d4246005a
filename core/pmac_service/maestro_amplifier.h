// The resistors of a Midi-Maestro servo amplifier (Control Techniques), after Saengsasri, Nittayachin 1996,
// KMITL, chapter 4. Two of the printed formulas do not give the printed tables: both values are reported,
// with the resistor that the tables fit. Currents A, speeds rpm, tachometer constants V per 1000 rpm.
#pragma once

#include <optional>
#include <span>
#include <string_view>

namespace millwright::pmac {

/// RT = 200 (Vm Ke - 5), Vm = rpm / 1000; no unit is printed. Nothing where it would be below 0: a tachometer
/// of a higher constant is needed; 0: a bridge.
[[nodiscard]] std::optional<double> speed_resistor(double max_rpm, double tacho);
/// RRT = 183000 (0.068 Vm Ke - 1), with switch 3 on; no unit is printed. Nothing where it would be below 0.
[[nodiscard]] std::optional<double> tacho_loss_resistor(double max_rpm, double tacho);

/// A formula as it is printed, and as the printed table asks for it; kOhm. Nothing: none is fitted.
struct ResistorValue {
    std::optional<double> printed;
    std::optional<double> corrected;
};

/// RIN = f Inom / (0.1925 Ipeak - 0.385 Inom): f = 10000 is printed, 1000 (in Ohm) gives table 4.1.
[[nodiscard]] ResistorValue nominal_current_resistor(double nominal, double peak);
/// RIP: 2200 Inom / (Ipeak - Ilim) is printed; 2.2 Ilim / (Ipeak - Ilim) gives most of table 4.2.
[[nodiscard]] ResistorValue peak_current_resistor(double nominal, double limit, double peak);

/// A row of a printed table: for this current, this resistor.
struct FittedResistor {
    std::string_view model;
    double peak = 0.0; ///< of the model
    double current = 0.0;
    std::optional<double> kilo_ohm; ///< nothing: none is fitted
};

[[nodiscard]] std::span<const FittedResistor> nominal_current_table(); ///< table 4.1
[[nodiscard]] std::span<const FittedResistor> peak_current_table();    ///< table 4.2

} // namespace millwright::pmac
