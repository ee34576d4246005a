#include "core/project/export_note.h"

#include <fmt/format.h>

#include <algorithm>

namespace millwright::project {

std::string left_out_text(const SurfaceInput& surface) {
    if (surface.face && !surface.face->trim.everything()) {
        return "The face is trimmed: the file contains all of its surface, without its outline and holes.";
    }
    const auto trimmed =
        std::ranges::count_if(surface.trims, [](const geometry::Trim& trim) { return !trim.everything(); });
    if (trimmed == 0) {
        return {};
    }
    return trimmed == 1 ? std::string("One patch is trimmed: the file contains the whole patch, without its "
                                      "outline and holes.")
                        : fmt::format("{} patches are trimmed: the file contains the whole patches, without "
                                      "their outlines and holes.",
                                      trimmed);
}

} // namespace millwright::project
