// The motion file of the arm while it is being written: what is wrong with it, and its motion. Lengths mm,
// angles rad.
#pragma once

#include "core/arm/arm_model.h"
#include "core/arm/arm_motion_file.h"
#include "core/base/error.h"
#include "core/geometry/vectors.h"
#include "core/motion/trajectory.h"

#include <filesystem>
#include <string>
#include <vector>

namespace millwright::actions {

/// A block of a motion file while the arm is at it.
struct ArmBlockPlayed {
    int line = 0;             ///< where the block begins, from 1
    std::string text;         ///< that line, without blanks around it
    Vec3 goal = Vec3::Zero(); ///< of the tip
    double end = 0.0;         ///< of its motion, s from the beginning of the file's
};

struct ArmFileMotion {
    motion::Trajectory trajectory;
    std::vector<ArmBlockPlayed> blocks; ///< those that move, in their order
};

/// Lines and arcs of a motion file, from the joints `start` on. Throws Error with the line of what is wrong,
/// and of what the arm cannot do.
[[nodiscard]] ArmFileMotion motion_of_file(const arm::ArmModel& arm,
                                           const std::string& text,
                                           const arm::JointPositions& start,
                                           const std::filesystem::path& file);

class MotionFileDraft {
public:
    /// Looks through the text if it is another one than before.
    void follow(const std::string& text);
    /// The first thing that is wrong, if anything is: words, numbers, arcs.
    [[nodiscard]] const std::vector<Diagnostic>& faults() const { return faults_; }
    [[nodiscard]] bool has_blocks() const { return !blocks_.empty(); }
    /// Of a text without faults.
    [[nodiscard]] const std::vector<arm::ArmBlock>& blocks() const { return blocks_; }

    /// Stands for a file in messages.
    [[nodiscard]] static const std::filesystem::path& name();

private:
    std::string text_;
    std::vector<Diagnostic> faults_;
    std::vector<arm::ArmBlock> blocks_;
};

} // namespace millwright::actions
