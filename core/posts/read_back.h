// A text read again, by a reader that knows nothing of how it was written, and compared with what was meant.
#pragma once

#include "core/posts/post_format.h"
#include "core/posts/program_words.h"
#include "core/posts/writer.h"
#include "core/program/program.h"

#include <filesystem>

namespace millwright::posts {

/// Block by block: kind, positions and tip control, feeds as durations, spindle, dwells; each within half of
/// its last digit, arcs nowhere farther than `arc_tolerance` (mm) from their blocks besides. Throws Error
/// naming `file`, line and block where the text says something else, or what its control would refuse.
void check_read_back(const program::Listing& listing,
                     const program::Program& program,
                     const ProgramWords& program_words,
                     const PostFormat& format,
                     double arc_tolerance,
                     const std::filesystem::path& file);

} // namespace millwright::posts
