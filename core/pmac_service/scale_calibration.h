// Counts of a motor for a degree of its joint, from angles that were measured. Counts are exact, angles are
// what errs: a line is fitted to the angles by least squares.
#pragma once

#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

namespace millwright::pmac {

struct ScaleReading {
    int motor = 1;
    double counts = 0.0; ///< where the motor stood
    double angle = 0.0;  ///< measured, deg
    int line = 0;        ///< of the file
};

struct ScaleFit {
    int motor = 1;
    double counts_per_degree = 0.0;       ///< negative: the motor turns against its joint
    double counts_at_zero = 0.0;          ///< where the angle is 0
    double counts_per_degree_error = 0.0; ///< standard error; 0 with two readings
    double rms = 0.0;                     ///< of what is left, deg
    double worst = 0.0;                   ///< deg, with its sign: measured - fitted
    int worst_line = 0;
    int readings = 0;
};

/// Lines "motor counts angle", separated by blanks, tabs, commas or semicolons; '#' begins a comment. Throws
/// Error with line and column.
[[nodiscard]] std::vector<ScaleReading> parse_scale_readings(std::string_view text,
                                                             const std::filesystem::path& file);

/// One fit a motor, in their order. Throws Error for a motor with fewer than two different positions or whose
/// angles do not change.
[[nodiscard]] std::vector<ScaleFit> fit_scales(std::span<const ScaleReading> readings);

} // namespace millwright::pmac
