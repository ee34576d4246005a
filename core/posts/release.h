// From a program to a text that may leave the house: made ready for a control, written, read back.
#pragma once

#include "core/kinematics/machine_model.h"
#include "core/posts/post_format.h"
#include "core/posts/prepare.h"
#include "core/posts/writer.h"

#include <filesystem>

namespace millwright::posts {

struct ReleaseSettings {
    TextSettings text = {};
    double arc_tolerance = 0.0;                 ///< mm; 0: no arcs
    double tip_tolerance = 0.0;                 ///< as prepare() has it, mm; 0: feeds are not cut
    std::filesystem::path file = "the program"; ///< called so in diagnostics
};

struct ReleasedText {
    program::Program program; ///< what the text says, block by block
    program::Listing listing;
    double tip_deviation = 0.0; ///< PreparedProgram::tip_deviation
    int arcs = 0;
};

/// Throws Error if the control cannot do what the program asks, or if the text does not read back as it.
[[nodiscard]] ReleasedText release(const program::Program& program,
                                   const kinematics::MachineModel& machine,
                                   const PostFormat& format,
                                   const ReleaseSettings& settings = {});

} // namespace millwright::posts
