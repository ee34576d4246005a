#include "core/program/program_settings.h"

#include "core/base/error.h"

#include <fmt/format.h>

#include <string_view>

namespace millwright::program {

namespace {

struct Range {
    std::string_view name;
    std::string_view unit;
    double least, most;
};

void check_range(double value, const Range& range) {
    if (!(value >= range.least && value <= range.most)) {
        throw Error(fmt::format("program settings: {} of {} {} is not between {} and {}",
                                range.name,
                                value,
                                range.unit,
                                range.least,
                                range.most));
    }
}

} // namespace

void check(const ProgramSettings& settings) {
    constexpr double slowest = 1e-3;
    constexpr double fastest = 1e4;
    check_range(settings.cutting_feed, {"a cutting feed", "mm/s", slowest, fastest});
    check_range(settings.plunge_feed, {"a plunge feed", "mm/s", slowest, fastest});
    check_range(settings.link_clearance, {"a link clearance", "mm", 1e-2, 1e3});
    check_range(settings.approach_clearance, {"an approach clearance", "mm", 1e-2, 1e3});
    check_range(settings.safe_position.value_or(0.0), {"a safe position", "mm", -1e5, 1e5});
    check_range(settings.spindle_rpm, {"a spindle speed", "1/min", 0.0, 1e6});
    check_range(settings.path_tolerance, {"a path tolerance", "mm", 0.0, 10.0});
    check_range(settings.length_decimals, {"a number of decimals", "digits", 1, 6});
    check_range(settings.angle_decimals, {"a number of decimals", "digits", 1, 6});
}

} // namespace millwright::program
