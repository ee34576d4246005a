// Programs as text, in the words of any control. What is written for LinuxCNC and why:
// docs/reference/gcode.md; how controls are described: docs/reference/post-file.md.
#pragma once

#include "core/gcode/listing.h"
#include "core/gcode/posts/post_format.h"
#include "core/gcode/posts/wording.h"
#include "core/gcode/program.h"
#include "core/gcode/program_settings.h"

#include <string>
#include <string_view>

namespace millwright::gcode {

/// What a person chooses about a text, beside its format.
struct TextSettings {
    std::string name = "PROGRAM"; ///< letters, digits, '-' and '_'
    bool line_numbers = false;
    double path_tolerance = 0.005; ///< mm; 0: exact path
};

/// `name` as controls take it: capitals, digits, '-' and '_', at most 24 of them; PROGRAM if nothing is left.
[[nodiscard]] std::string text_name(std::string_view name);

/// Throws Error naming the block that the control has no words for, or whose line would be too long. Throws
/// Defect if a target is not finite.
[[nodiscard]] Listing write_text(const Program& program,
                                 const Wording& wording,
                                 const PostFormat& format,
                                 const TextSettings& settings);

/// For LinuxCNC, in axis positions. Of `settings` the decimals, line numbers and path tolerance count.
[[nodiscard]] Listing write_gcode(const Program& program, const ProgramSettings& settings);

} // namespace millwright::gcode
