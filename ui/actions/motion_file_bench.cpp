#include "ui/actions/motion_file_bench.h"

#include "core/base/units.h"
#include "core/kinematics/arm_motion_ways.h"
#include "core/kinematics/arm_path.h"
#include "core/motion/arm_motion.h"
#include "core/motion/planner.h"

namespace millwright::actions {

motion::Trajectory motion_of_file(const kinematics::ArmModel& arm,
                                  const std::string& text,
                                  const kinematics::JointPositions& start,
                                  const std::filesystem::path& file) {
    constexpr double quarter_turn = 0.5 * pi;
    const auto ways = kinematics::ways_of(arm, kinematics::parse_arm_motion(text, file), start, file);
    kinematics::ArmPathSettings settings;
    settings.aim = kinematics::aim_of(arm, quarter_turn);
    motion::ArmMotion motion(arm, start);
    motion.follow(ways, kinematics::follow_path(arm, ways, start, settings, {}), file);
    return motion::plan(motion.program(), arm, {}, {});
}

const std::filesystem::path& MotionFileBench::name() {
    static const std::filesystem::path stands_for_a_file = "motion file";
    return stands_for_a_file;
}

void MotionFileBench::follow(const std::string& text) {
    if (text == text_) {
        return;
    }
    text_ = text;
    faults_.clear();
    blocks_.clear();
    try {
        auto blocks = kinematics::parse_arm_motion(text_, name());
        kinematics::expect_arcs(blocks, name());
        blocks_ = std::move(blocks);
    } catch (const Error& error) {
        faults_.push_back(error.diagnostic());
    }
}

} // namespace millwright::actions
