// Files as jobs of a machine that is moved position by position: G-code, and path files.
#pragma once

#include "core/geometry/vectors.h"
#include "core/machine/job.h"

#include <filesystem>
#include <memory>
#include <optional>

namespace millwright::machine {

struct FileJobSettings {
    /// Where the machine stands; not given: at zero, or at its nearest limits.
    std::optional<kinematics::AxisPositions> start = {};
    Vec3 origin = Vec3::Zero(); ///< where the file's zero lies on the machine
};

/// The job of a G-code file, or of a path file (core/plot/path_file.h), whose first line says so. The blocks
/// tell their lines. Throws Error with file and line for what is wrong in it, and for what the machine cannot
/// do.
[[nodiscard]] Job file_job(const std::filesystem::path& file,
                           std::shared_ptr<const kinematics::MachineModel> machine,
                           const FileJobSettings& settings = {});

} // namespace millwright::machine
