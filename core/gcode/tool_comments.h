// Tools that CAM programs name in comments, since G-code has no word for a diameter: Fusion 360 and HSM
// `(T1 D=6. CR=0. - FLAT END MILL)`, Mastercam `(TOOL - 1 DIA. OFF. - 1 LEN. - 1 DIA. - 6.)`,
// `( TOOL DIA. = 6 )`, `(Tool 2, diameter: 3.175 mm)`, `(6MM ENDMILL)`, `(T1 | 1/4 FLAT ENDMILL)`, APT
// `(TOOL/MILL,6,0,50)`. Lengths mm.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace millwright::gcode {

struct CommentTool {
    std::optional<int> number; ///< not given: the comment does not say
    double diameter = 0.0;     ///< above 0
    int line = 0;              ///< of the program, from 1

    friend bool operator==(const CommentTool&, const CommentTool&) = default;
};

/// In the order of the text; the first comment of each tool that is called: where the program has T words, a
/// comment with another number is of none of them. A fraction is of an inch; another length
/// without a unit is in inches where the first unit word of the program is G20 or G70.
[[nodiscard]] std::vector<CommentTool> tools_in_comments(std::string_view text);

/// The first of `tools` if all are as wide; nothing if one is not, or there is none.
[[nodiscard]] std::optional<CommentTool> only_tool(const std::vector<CommentTool>& tools);

} // namespace millwright::gcode
