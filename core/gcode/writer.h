// Programs as text, in the words of any control. What is written for LinuxCNC and why:
// docs/reference/gcode.md; how controls are described: docs/reference/post-file.md.
#pragma once

#include "core/gcode/posts/post_format.h"
#include "core/gcode/posts/wording.h"
#include "core/gcode/program.h"
#include "core/gcode/program_settings.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace millwright::gcode {

/// The text of a program and which line says which block.
struct Listing {
    std::string text;                     ///< ASCII, lines end in \n, the same bytes for the same program
    std::vector<int> line_of_block;       ///< from 1; of several lines the first; blocks of an arc share one
    std::vector<std::size_t> line_starts; ///< byte where each line begins, plus the length of the text

    [[nodiscard]] int line_count() const { return static_cast<int>(line_starts.size()) - 1; }
    /// Line `line` (from 1) without its end.
    [[nodiscard]] std::string_view line(int line) const;
    /// The block that `line` belongs to: the last one that begins at or before it; -1 above the first.
    [[nodiscard]] int block_at_line(int line) const;
};

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
