#include "core/base/program_files.h"

#include <sys/auxv.h>

#include <system_error>

namespace millwright {

namespace fs = std::filesystem;

fs::path executable() {
    std::error_code unknown;
    const fs::path file = fs::read_symlink("/proc/self/exe", unknown);
    if (!unknown) {
        return file;
    }
    const auto called = ::getauxval(AT_EXECFN); // without /proc: the path that it was started by
    return called == 0 ? fs::path() : fs::canonical(reinterpret_cast<const char*>(called), unknown);
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
