#include "app/cordic/cordic_remarks.h"

#include "core/base/counted.h"
#include "core/base/numbers.h"
#include "core/base/units.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

namespace millwright::app {

namespace {

constexpr double notable_speed_error = 0.05; // of the feed

bool has_arcs(const cordic::Processor& processor) {
    using cordic::Opcode;
    return std::ranges::any_of(processor.published(), [](const cordic::Published& record) {
        return record.opcode == Opcode::g02 || record.opcode == Opcode::g03 ||
               record.opcode == Opcode::g02z || record.opcode == Opcode::g03z;
    });
}

/// Set-points that are where the axes were already. Those of G-code are left out when it is compiled.
std::optional<Diagnostic> idle_remark(const cordic::Processor& processor,
                                      const cordic_machine::CordicProgram& program,
                                      const std::string& file) {
    const auto& published = processor.published();
    const auto same_place = [](const cordic::Published& a, const cordic::Published& b) {
        constexpr std::size_t z = 6;
        return a.words[0] == b.words[0] && a.words[1] == b.words[1] && a.words[z] == b.words[z];
    };
    const auto first = std::ranges::adjacent_find(published, same_place);
    if (first == published.end()) {
        return std::nullopt;
    }
    const cordic::CodeAddress address = std::next(first)->instruction_at;
    const cordic::CodeLine at = cordic::line_at(program.code_lines, address);
    constexpr std::string_view what = "this motion ends where the axes already are (the first such motion)";
    return Diagnostic{{file, at.line, at.column, -1},
                      at.line > 0 ? std::string(what) : fmt::format("{}, at {:#06x}", what, address),
                      {}};
}

/// What is left to turn is 0 from the first step on, and the model leaves steps out, but not their gain.
bool comes_from_sign_of_zero(const cordic::Processor& processor,
                             const cordic::ExactPoint& from,
                             const cordic::ExactPoint& to) {
    return processor.settings().zero == cordic::SignOfZero::zero &&
           (exactly_equal(to.x, from.x) || exactly_equal(to.y, from.y));
}

/// Two passes leave up to the angle of the last step each; what is more comes from the word.
std::string cause_of_speed_error(const cordic::Processor& processor,
                                 const cordic::RunReport& report,
                                 std::span<const cordic::ExactPoint> exact) {
    const std::size_t n = report.speed_error_at;
    const cordic::ExactPoint& to = exact[n];
    const cordic::ExactPoint from = n == 0 ? cordic::ExactPoint() : exact[n - 1];
    const double way = std::hypot(to.x - from.x, to.y - from.y, to.z - from.z);
    if (report.position_error >= 0.5 * report.speed_error * way) {
        return fmt::format(
            "its ends are up to {:.2g} mm off, on a path of {:.2g} mm", report.position_error, way);
    }
    if (comes_from_sign_of_zero(processor, from, to)) {
        return "with --matlab-zero nothing is turned along an axis, but the gain is removed all the same";
    }
    const cordic::Sequence& sequence = processor.settings().sequence;
    const int last = sequence.shifts[static_cast<std::size_t>(sequence.step_count - 1)];
    const double left = 2.0 * std::atan(std::ldexp(1.0, -last));
    if (left >= 0.5 * report.speed_error) {
        return fmt::format("{} leave its direction up to {:.2g} degrees off",
                           counted(sequence.step_count, "iteration"),
                           to_degrees(left));
    }
    return fmt::format("{} has too few bits", cordic::to_text(processor.format()));
}

} // namespace

std::vector<Diagnostic> remarks_on(const cordic::Processor& processor,
                                   const cordic::RunReport& report,
                                   const cordic_machine::CordicProgram& program,
                                   const CordicChoice& choice,
                                   const std::string& file) {
    const bool of_gcode = !program.points.empty();
    std::vector<Diagnostic> remarks;
    if (auto idle = idle_remark(processor, program, file)) {
        remarks.push_back(std::move(*idle));
    }
    if (of_gcode && choice.arithmetic.thesis_direction && has_arcs(processor)) {
        remarks.push_back({{file, 0, 0, -1},
                           "arcs turn the other way, as in the thesis's model: they end off the programmed "
                           "point, and the next motion goes straight back",
                           {}});
    }
    if (of_gcode && report.speed_error > notable_speed_error) {
        remarks.push_back({{file, program.points[report.speed_error_at].line, 0, -1},
                           fmt::format("the speed deviates from the feed rate by up to {:.0f} %: {}",
                                       100.0 * report.speed_error,
                                       cause_of_speed_error(processor, report, program.points)),
                           {}});
    }
    return remarks;
}

} // namespace millwright::app
