#include "core/posts/release.h"

#include "core/posts/arc_fit.h"
#include "core/posts/post_file.h"
#include "core/posts/read_back.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace millwright::posts {

namespace {

/// The head of the text says it, for all moves, or nothing does.
void set_path_mode(program::Program& program, const PostFormat& format, double tolerance) {
    std::optional<program::PathControl> said;
    if (says_path_mode(format)) {
        said = {tolerance > 0.0 ? program::PathMode::continuous : program::PathMode::exact_path,
                std::max(0.0, tolerance)};
    }
    for (program::Block& block : program.blocks) {
        if (block.moves()) {
            block.path = said;
        }
    }
}

} // namespace

ReleasedText release(const program::Program& program,
                     const kinematics::MachineModel& machine,
                     const PostFormat& format,
                     const ReleaseSettings& settings) {
    PreparedProgram ready = prepare(program, machine, format, settings.tip_tolerance);
    set_path_mode(ready.program, format, settings.text.path_tolerance);
    if (settings.arc_tolerance > 0.0) {
        ready.program_words.arcs =
            fit_arcs(ready.program, ready.program_words, format, settings.arc_tolerance);
    }
    program::Listing listing = write_text(ready.program, ready.program_words, format, settings.text);
    check_read_back(
        listing, ready.program, ready.program_words, format, settings.arc_tolerance, settings.file);
    return {std::move(ready.program),
            std::move(listing),
            ready.tip_deviation,
            static_cast<int>(ready.program_words.arcs.size())};
}

} // namespace millwright::posts
