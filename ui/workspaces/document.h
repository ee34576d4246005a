// What is being worked on as a file: where it is, and what stands there.
#pragma once

#include "core/project/project.h"

#include <filesystem>
#include <optional>
#include <string>

namespace millwright::actions {

/// A file as this program read or wrote it last.
struct KnownFile {
    std::filesystem::path file;
    std::string hash; ///< of its bytes, jobs::program_hash; empty: not known

    friend bool operator==(const KnownFile&, const KnownFile&) = default;
};

struct Document {
    std::filesystem::path file;            ///< empty for a project never saved
    project::Project saved;                ///< as it is on disk, or as it was made
    std::string hash = {};                 ///< of `file`, as in KnownFile
    std::optional<KnownFile> program = {}; ///< where the program was written last; nothing: nowhere yet

    friend bool operator==(const Document&, const Document&) = default;
};

} // namespace millwright::actions
