// Gap linking: strokes whose ends are near are joined, so that the tool need not be lifted between them.
// Source: KMITL master's thesis 2006, forming software for wood and plastic, gap analysis.
#pragma once

#include "core/plot/stroke_plan.h"
#include "core/plot_strokes/region.h"
#include "core/plot_strokes/strokes.h"

#include <vector>

namespace millwright::plot {

struct LinkSettings {
    double distance = 3.0; ///< gaps shorter than this are joined, mm
    /// Given: a link may run along these closed lines but not across one, and has to be on the side of each
    /// of them that its strokes are on. Not given: as the thesis, which asks nothing.
    std::vector<Ring> outlines = {};
};

struct Linked {
    Strokes strokes;
    int links = 0;
    double link_length = 0.0; ///< mm
    int refused = 0;          ///< short enough, but on the wrong side of an outline
};

/// Joins neighbours in the order given, of the same pen, none reversed; a dot stays alone. The length of
/// drawing and travel together stays what it was. Throws Error if the distance is not 0 or more.
[[nodiscard]] Linked link(const Strokes& strokes, const LinkSettings& settings);

/// The closed strokes: what hatches of a drawing have to stay in. A stroke is closed where its ends are
/// nearer than `tolerance`.
[[nodiscard]] std::vector<Ring> closed_outlines(const Strokes& strokes, double tolerance = 0.05);

// Outlines that are drawn line by line, as those of LINE entities: strokes whose ends touch, put together to
// closed ones. Lengths mm.

/// Open strokes of one pen that go around with nothing else at their ends become one closed stroke, in the
/// place and the direction of the first of them; all others stay as they are. Ends touch where they are no
/// farther apart than `tolerance`.
[[nodiscard]] Strokes rings_joined(const Strokes& strokes, double tolerance = 0.05);

/// What the plan fills, compensates or keeps links in: rings joined where it does any of it, else the strokes
/// as drawn. Throws Error where it compensates and there is nothing closed: what was to be cut outside would
/// come out too small.
[[nodiscard]] Strokes outlines_for(const Strokes& drawn, const StrokePlan& plan);

} // namespace millwright::plot
