// What `millwright finish` makes of a mesh: passes, program, and what the program leaves. Lengths mm.
#pragma once

#include "app/command_line/posting.h"
#include "core/base/progress.h"
#include "core/exchange/mesh_file.h"
#include "core/kinematics/machine_model.h"
#include "core/mesh_finish/finishing.h"
#include "core/mesh_finish/mesh_inspection.h"
#include "core/plan/finish_check.h"
#include "core/plan/part_surface.h"
#include "core/program/program.h"
#include "core/toolpath/profile.h"

#include <optional>
#include <string>
#include <vector>

namespace millwright::app {

struct FinishOptions {
    std::string file;
    std::string out;
    std::string machine;
    std::string tool;
    PostChoice post;
    double mm_per_unit = 1.0;
    std::vector<double> shift; ///< X,Y,Z; empty: none
    std::vector<double> axis;  ///< I,J,K; empty: along Z
    double direction_deg = 0.0;
    std::optional<double> step_over; ///< nullopt: by the scallop
    double scallop = 0.01;
    double tolerance = 0.005;
    double overrun = 0.0;
    bool one_way = false; ///< no passes across
    double link_clearance = 2.0;
    std::optional<double> allowance; ///< nullopt: not known
    double feed_mm_per_min = 1200.0;
    double plunge_mm_per_min = 300.0;
    double spindle_rpm = 8000.0;
    double left_tolerance = 0.02; ///< of the check
    double memory_mb = 1000.0;    ///< of the check's field
    bool allow_gouges = false;
};

struct FinishTool {
    toolpath::Profile body;
    std::optional<toolpath::Profile> holder{};
    std::string text;
};

/// What comes out, in the order in which it is made.
struct FinishWork {
    exchange::MeshFile mesh; ///< in mm, where it lies on the machine
    std::vector<std::string> remarks;
    kinematics::MachineModel machine; ///< with the tool
    FinishTool tool;
    mesh_finish::FinishSettings settings;
    mesh_finish::FinishPath path;
    std::optional<mesh_finish::HolderReach> holder_reach{};
    program::Program program;
    PostedText text;
    double seconds = 0.0; ///< that the machine takes by the planner
    plan::PartSurface part;
    plan::FinishCheck check;
    std::size_t memory = 0; ///< bytes of mesh, tree and what is compared
};

/// Throws Error with the first thing that is wrong, UsageError for options that do not fit together;
/// Cancelled.
[[nodiscard]] FinishWork finish_work(const FinishOptions& options, const Progress& progress);

} // namespace millwright::app
