// A design from measured points: exactly through those in rows, or near a cloud of them.
#pragma once

#include "core/project/imported_surface.h"

#include <filesystem>

namespace millwright::project {

/// Throws Error, naming the file, and the line where there is one; Cancelled.
[[nodiscard]] ImportedSurface import_points(const exchange::MeasuredPoints& read,
                                            const ImportChoice& choice,
                                            const std::filesystem::path& file,
                                            const Progress& progress);

} // namespace millwright::project
