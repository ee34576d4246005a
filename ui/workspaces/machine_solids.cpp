#include "ui/workspaces/machine_solids.h"

#include "core/base/error.h"
#include "core/kinematics/machine_file.h"
#include "core/kinematics/machine_solids.h"
#include "core/project/assets.h"

#include <optional>

namespace millwright::actions {

namespace {

/// Empty where there is none: the plan tells that.
std::filesystem::path file_of(const project::Project& project, const plan::Folders& folders) {
    try {
        return project::machine_path(project, folders.project, folders.assets);
    } catch (const Error&) {
        return {};
    }
}

} // namespace

void MachineSolids::follow(const project::Project& project, const plan::Folders& folders) {
    const std::filesystem::path file = file_of(project, folders);
    if (file == file_) {
        return;
    }
    file_ = file;
    bodies_ = nullptr;
    if (file_.empty()) {
        return;
    }
    std::optional<kinematics::MachineModel> machine;
    try {
        machine = kinematics::read_machine(file_);
    } catch (const Error&) { // the plan tells it, at its place
        return;
    }
    bodies_ = kinematics::read_machine_solids(file_, *machine);
}

} // namespace millwright::actions
