#include "app/commands/cordic_remarks.h"

#include "core/base/units.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <optional>
#include <utility>

namespace millwright::app {

namespace {

constexpr double much = 0.05; // of the feed

bool has_arcs(const cordic::Processor& processor) {
    using cordic::Opcode;
    return std::ranges::any_of(processor.published(), [](const cordic::Published& record) {
        return record.opcode == Opcode::g02 || record.opcode == Opcode::g03 ||
               record.opcode == Opcode::g02z || record.opcode == Opcode::g03z;
    });
}

/// Set-points that are where the axes were already. Those of G-code are left out when it is compiled.
std::optional<std::string> idle_remark(const cordic::Processor& processor,
                                       const gcode::CordicProgram& program) {
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
    const std::string place =
        at.line > 0 ? fmt::format("line {}, column {}", at.line, at.column) : fmt::format("{:#06x}", address);
    return fmt::format("motions lead to where the axes are already, the first one at {}", place);
}

/// Two passes leave up to the angle of the last step each; what is more comes from the word.
std::string cause_of_speed_error(const cordic::Processor& processor, double error) {
    const cordic::Sequence& sequence = processor.settings().sequence;
    const int last = sequence.shifts[static_cast<std::size_t>(sequence.step_count - 1)];
    const double left = 2.0 * std::atan(std::ldexp(1.0, -last));
    if (left >= 0.5 * error) {
        return fmt::format("{} iterations turn its direction by up to {:.2g} degrees beside",
                           sequence.step_count,
                           to_degrees(left));
    }
    return fmt::format("{} has too few bits for it", cordic::to_text(processor.format()));
}

} // namespace

std::vector<std::string> remarks_on(const cordic::Processor& processor,
                                    const cordic::RunReport& report,
                                    const gcode::CordicProgram& program,
                                    const CordicChoice& choice) {
    const bool of_gcode = !program.points.empty();
    std::vector<std::string> remarks;
    if (auto idle = idle_remark(processor, program)) {
        remarks.push_back(std::move(*idle));
    }
    if (of_gcode && choice.arithmetic.thesis_direction && has_arcs(processor)) {
        remarks.emplace_back(
            "arcs turn the other way, as in the thesis's model: they end beside where the program says, "
            "and what follows leads straight back");
    }
    if (of_gcode && report.speed_error > much) {
        remarks.push_back(fmt::format("the speed is up to {:.0f} % beside the feed: {}",
                                      100.0 * report.speed_error,
                                      cause_of_speed_error(processor, report.speed_error)));
    }
    return remarks;
}

} // namespace millwright::app
