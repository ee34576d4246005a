// What is being worked on as a file: where it is, and what stands there.
#pragma once

#include "core/project/project.h"

#include <filesystem>

namespace millwright::actions {

struct Document {
    std::filesystem::path file; ///< empty for a project never saved
    project::Project saved;     ///< as it stands on disk, or as it was made

    friend bool operator==(const Document&, const Document&) = default;
};

} // namespace millwright::actions
