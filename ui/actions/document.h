// The open file: where it is, what was last saved, and the files opened before.
#pragma once

#include "core/project/history.h"

#include <filesystem>
#include <vector>

namespace millwright::actions {

struct Document {
    std::filesystem::path file;                ///< empty for a project never saved
    project::Project saved;                    ///< as it stands on disk, or as it was made
    std::vector<std::filesystem::path> recent; ///< newest first, at most 10
};

} // namespace millwright::actions
