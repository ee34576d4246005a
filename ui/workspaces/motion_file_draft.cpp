#include "ui/workspaces/motion_file_draft.h"

#include "core/arm/arm_forward.h"
#include "core/arm/arm_motion_file.h"
#include "core/arm/arm_path.h"
#include "core/base/units.h"
#include "core/motion/arm_motion.h"
#include "core/motion/planner.h"

#include <sstream>
#include <utility>

namespace millwright::actions {

namespace {

std::vector<std::string> trimmed_lines(const std::string& text) {
    constexpr const char* blanks = " \t\r";
    std::vector<std::string> lines;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) {
        const std::size_t first = line.find_first_not_of(blanks);
        lines.push_back(first == std::string::npos
                            ? std::string()
                            : line.substr(first, line.find_last_not_of(blanks) + 1 - first));
    }
    return lines;
}

/// A block is as many moves of the joints as keep its tip on its way.
std::vector<ArmBlockPlayed> played_blocks(const arm::ArmModel& arm,
                                          const program::Program& program,
                                          const motion::Trajectory& trajectory,
                                          const std::string& text) {
    const std::vector<std::string> lines = trimmed_lines(text);
    std::vector<ArmBlockPlayed> played;
    for (int n = 0; n < program.block_count(); ++n) {
        const program::Block& block = program.blocks[static_cast<std::size_t>(n)];
        if (block.source_line <= 0 || static_cast<std::size_t>(block.source_line) > lines.size()) {
            continue;
        }
        if (played.empty() || played.back().line != block.source_line) {
            played.push_back(
                {.line = block.source_line, .text = lines[static_cast<std::size_t>(block.source_line - 1)]});
        }
        played.back().goal = arm::base_T_tool(arm, block.target).translation();
        played.back().end = trajectory.end_of(n);
    }
    return played;
}

} // namespace

ArmFileMotion motion_of_file(const arm::ArmModel& arm,
                             const std::string& text,
                             const arm::JointPositions& start,
                             const std::filesystem::path& file) {
    constexpr double quarter_turn = 0.5 * pi;
    const auto ways = arm::ways_of(arm, arm::parse_arm_motion(text, file), start, file);
    arm::ArmPathSettings settings;
    settings.aim = arm::aim_of(arm, quarter_turn);
    motion::ArmMotion motion(arm, start);
    motion.follow(ways, arm::follow_path(arm, ways, start, settings, {}), file);
    motion::Trajectory trajectory = motion::plan(motion.program(), arm, {}, {});
    auto blocks = played_blocks(arm, motion.program(), trajectory, text);
    return {std::move(trajectory), std::move(blocks)};
}

const std::filesystem::path& MotionFileDraft::name() {
    static const std::filesystem::path stands_for_a_file = "motion file";
    return stands_for_a_file;
}

void MotionFileDraft::follow(const std::string& text) {
    if (text == text_) {
        return;
    }
    text_ = text;
    faults_.clear();
    blocks_.clear();
    try {
        auto blocks = arm::parse_arm_motion(text_, name());
        arm::expect_arcs(blocks, name());
        blocks_ = std::move(blocks);
    } catch (const Error& error) {
        faults_.push_back(error.diagnostic());
    }
}

} // namespace millwright::actions
