// Jobs of G-code files whose motion is planned here.
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
