// Reads HPGL, the language of HP's pen plotters, into strokes: what AutoCAD's drivers, CAD programs and
// cutters of today write. Commands and what becomes of each: docs/reference/hpgl.md. The judge is
// hp2xx 3.4.4.
#pragma once

#include "core/base/error.h"
#include "core/hpgl/hpgl_settings.h"
#include "core/plot_strokes/strokes.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace millwright::hpgl {

/// What a file says about one pen.
struct PenUse {
    double speed = 0.0; ///< VS, mm/s; 0: nothing said
    double width = 0.0; ///< PW or PT, mm; 0: nothing said

    friend bool operator==(const PenUse&, const PenUse&) = default;
};

/// A command that is understood and that a machine cannot follow: pens' colours, pages, questions to the
/// plotter.
struct LeftOut {
    std::string name;      ///< the two letters
    std::string why;       ///< one sentence
    std::int64_t byte = 0; ///< of the first
    std::int64_t count = 0;

    friend bool operator==(const LeftOut&, const LeftOut&) = default;
};

struct Plot {
    plot::Strokes strokes;
    std::map<int, PenUse> pens; ///< all that drew or that the file says something about
    Vec2 end = Vec2::Zero();    ///< where the pen is left, mm
    std::int64_t commands = 0;
    std::vector<LeftOut> left_out;
    std::vector<Diagnostic> diagnostics; ///< in the order of the file, each with its byte
    std::int64_t more_diagnostics = 0;   ///< that are not kept
    /// What line ends between two digits are read as, where the file leaves a choice (LineEnds::automatic).
    std::optional<Diagnostic> line_ends;
};

/// Reads a whole file's bytes; `file` is named in every diagnostic. Nothing is drawn from a command that is
/// wrong, and the pen is up from there to the next absolute position. Throws Error at the first diagnostic if
/// reading strictly, and always for more points than `settings.most_points`, for text in UTF-16, and where
/// the file does not show what its line ends between two digits mean. A byte order mark of UTF-8 is skipped.
[[nodiscard]] Plot
read_hpgl(std::string_view bytes, const std::filesystem::path& file, const HpglSettings& settings = {});

/// What a person should know of a plot that was read from `file`: what is wrong, how much more of it there
/// is, and each command that is left out, with how often and why.
[[nodiscard]] std::vector<Diagnostic> notices(const Plot& plot, const std::filesystem::path& file);

/// Bytes: more than the points that a plot may have take, ten bytes each.
inline constexpr std::size_t largest_plot = std::size_t{256} << 20U;

/// Reads the file itself. Throws Error if it cannot be read, or is larger than `largest_plot`, too.
[[nodiscard]] Plot read_hpgl_file(const std::filesystem::path& file, const HpglSettings& settings = {});

} // namespace millwright::hpgl
