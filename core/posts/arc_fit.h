// Runs of short feeds as arcs.
#pragma once

#include "core/posts/post_format.h"
#include "core/posts/program_words.h"
#include "core/program/program.h"

#include <vector>

namespace millwright::posts {

// How far an arc is from the straight moves that it replaces.

/// The largest distance between the arc and its moves, each measured from the other, as a control goes: from
/// the first move's begin to the last one's end, radius and third axis changing linearly with the angle. mm;
/// infinite where the moves turn back, or where the arc ends at another angle than they do.
[[nodiscard]] double
arc_deviation(const program::Program& program, const ProgramWords& program_words, const FittedArc& arc);

/// Arcs of at least three feeds in one of the planes that `format` allows, the third axis being still or
/// going along evenly, every other axis being still. Nowhere is an arc, with its centre and ends as written,
/// farther than `tolerance` (mm, > 0) from its feeds. None goes over a change of speed or role, or over
/// anything between the feeds; none has a radius over 1 m, a sweep below 1 degree or of a whole turn. The
/// longest arc is taken first from the begin of each run. Throws Error if the control is written without
/// arcs.
[[nodiscard]] std::vector<FittedArc> fit_arcs(const program::Program& program,
                                              const ProgramWords& program_words,
                                              const PostFormat& format,
                                              double tolerance);

} // namespace millwright::posts
