#include "core/base/program_files.h"

#include <system_error>

namespace millwright {

namespace fs = std::filesystem;

fs::path executable() {
    std::error_code unknown;
    return fs::read_symlink("/proc/self/exe", unknown);
}

std::optional<fs::path> find_above(const fs::path& executable, std::initializer_list<const char*> names) {
    for (fs::path above = executable.parent_path(); !above.empty(); above = above.parent_path()) {
        for (const char* name : names) {
            std::error_code unknown;
            if (fs::exists(above / name, unknown)) {
                return above / name;
            }
        }
        if (above == above.root_path()) {
            break;
        }
    }
    return std::nullopt;
}

} // namespace millwright
