// Programs as text, in the words of any control. What is written for LinuxCNC and why:
// docs/reference/gcode.md; how controls are described: docs/reference/post-file.md.
#pragma once

#include "core/posts/post_format.h"
#include "core/posts/program_words.h"
#include "core/program/listing.h"
#include "core/program/program.h"
#include "core/program/program_settings.h"

#include <string>
#include <string_view>
#include <vector>

namespace millwright::posts {

/// What a person chooses about a text, beside its format.
struct TextSettings {
    std::string name = "PROGRAM"; ///< letters, digits, '-' and '_'
    bool line_numbers = false;
    double path_tolerance = 0.005;         ///< mm; 0: exact path
    std::vector<std::string> remarks = {}; ///< comments at the top, each as lines as long as they may be
};

/// `name` as controls take it: capitals, digits, '-' and '_', at most 24 of them; PROGRAM if nothing is left.
[[nodiscard]] std::string text_name(std::string_view name);

/// Throws Error naming the block that the control has no words for, or whose line would be too long. Throws
/// Defect if a target is not finite.
[[nodiscard]] program::Listing write_text(const program::Program& program,
                                          const ProgramWords& program_words,
                                          const PostFormat& format,
                                          const TextSettings& settings);

/// For LinuxCNC, in axis positions. Of `settings` the decimals, line numbers and path tolerance count.
[[nodiscard]] program::Listing write_gcode(const program::Program& program,
                                           const program::ProgramSettings& settings);

} // namespace millwright::posts
