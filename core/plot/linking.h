// Gap linking: strokes whose ends are near are joined, so that the tool need not be lifted between them.
// Source: KMITL master's thesis 2006, forming software for wood and plastic, gap analysis.
#pragma once

#include "core/plot/region.h"
#include "core/plot/strokes.h"

#include <optional>

namespace millwright::plot {

struct LinkSettings {
    double distance = 3.0; ///< gaps shorter than this are joined, mm
    /// Given: links have to stay inside. Not given: as the thesis, which asks nothing.
    std::optional<Region> inside = std::nullopt;
};

struct Linked {
    Strokes strokes;
    int links = 0;
    double link_length = 0.0; ///< mm
    int refused = 0;          ///< short enough, but they would leave the region
};

/// Joins neighbours in the order given, of the same pen, none reversed; a dot stays alone. The length of
/// drawing and travel together stays what it was. Throws Error if the distance is not 0 or more.
[[nodiscard]] Linked link(const Strokes& strokes, const LinkSettings& settings);

/// What the closed strokes enclose: the region that hatches of a drawing have to stay in. A stroke is closed
/// where its ends are nearer than `tolerance`.
[[nodiscard]] Region enclosed(const Strokes& strokes, double tolerance = 0.05);

/// Whether the straight line from `a` to `b` stays inside, its ends and edges of the region included.
[[nodiscard]] bool stays_inside(const Region& region, const Vec2& a, const Vec2& b);

} // namespace millwright::plot
