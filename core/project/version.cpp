#include "core/project/version.h"

namespace millwright::project {

std::string_view version() {
    return MILLWRIGHT_VERSION;
}

} // namespace millwright::project
