// The bodies of the project's machine for the 3D view, read once per machine.
#pragma once

#include "core/geometry/solid.h"
#include "core/plan/plan.h"

#include <filesystem>
#include <memory>
#include <vector>

namespace millwright::actions {

class MachineSolids {
public:
    /// Reads them where the machine is another one than before; a machine that is not there has none. Throws
    /// Error once about a file of bodies that cannot be read.
    void follow(const project::Project& project, const plan::Folders& folders);

    /// Null where the machine's file names none.
    [[nodiscard]] const std::shared_ptr<const std::vector<geometry::SolidBody>>& bodies() const {
        return bodies_;
    }

private:
    std::filesystem::path file_; ///< of the machine
    std::shared_ptr<const std::vector<geometry::SolidBody>> bodies_;
};

} // namespace millwright::actions
