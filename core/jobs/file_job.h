// Files as jobs of a machine that is moved position by position: G-code, and path files.
#pragma once

#include "core/gcode_programs/work_origin.h"
#include "core/geometry/vectors.h"
#include "core/jobs/job.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace millwright::jobs::internal {

// Jobs of G-code files whose motion is planned here.

struct PlannedText {
    std::optional<kinematics::AxisPositions> start = {}; ///< of the machine; not given: not known
    std::optional<gcode::WorkOrigin> origin = {};        ///< as FileJobSettings::origin
};

/// As file_job().
[[nodiscard]] Job planned_text(std::string_view text,
                               const std::filesystem::path& file,
                               std::shared_ptr<const kinematics::MachineModel> machine,
                               const PlannedText& how);

/// For Job::hash: the same file somewhere else on the machine is another job, which cannot go on with this
/// one. Empty (that of the listing) at zero.
[[nodiscard]] std::string hash_of(const program::Listing& listing, const Vec3& origin);

} // namespace millwright::jobs::internal

namespace millwright::jobs {

struct FileJobSettings {
    std::optional<kinematics::AxisPositions> start = {}; ///< where the machine stands; not given: not known
    /// Where the file's zero lies on the machine; not given: not known, and its positions are taken for those
    /// of the machine.
    std::optional<gcode::WorkOrigin> origin = {};
};

/// The job of a G-code file, or of a path file (core/plot/path_file.h), whose first line says so. The blocks
/// tell their lines. Throws Error with file and line for what is wrong in it, for what the machine cannot do,
/// and for what depends on a start or an origin that is not known (MachineProgram::unplaced).
[[nodiscard]] Job file_job(const std::filesystem::path& file,
                           std::shared_ptr<const kinematics::MachineModel> machine,
                           const FileJobSettings& settings = {});

} // namespace millwright::jobs
