#include "app/commands/cordic_remarks.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

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

} // namespace

std::vector<std::string> remarks_on(const cordic::Processor& processor,
                                    const cordic::RunReport& report,
                                    const CordicSource& source,
                                    const CordicChoice& choice,
                                    bool of_gcode) {
    std::vector<std::string> remarks;
    const bool is_image = std::filesystem::path(source.file).extension() == ".bin";
    if (is_image && (choice.iterations > 0 || choice.rounding != CordicChoice().rounding)) {
        remarks.emplace_back(
            "the image was made for 29 steps and truncation: with others its arcs may end beside their "
            "places");
    }
    if (of_gcode && choice.thesis_direction && has_arcs(processor)) {
        remarks.emplace_back(
            "arcs turn the other way, as in the thesis's model: they end beside where the program says, "
            "and what follows leads straight back");
    }
    if (of_gcode && !choice.thesis_direction && report.speed_error > much) {
        remarks.push_back(
            fmt::format("the speed is up to {:.0f} % beside the feed: {} has too few bits for it",
                        100.0 * report.speed_error,
                        cordic::to_text(processor.format())));
    }
    return remarks;
}

} // namespace millwright::app
