// How far an arc is from the straight moves that it stands for.
#pragma once

#include "core/posts/program_words.h"
#include "core/program/program.h"

namespace millwright::posts {

/// The largest distance between the arc and its moves, each measured from the other, as a control goes: from
/// the first move's begin to the last one's end, radius and third axis changing linearly with the angle. mm;
/// infinite where the moves turn back, or where the arc ends at another angle than they do.
[[nodiscard]] double
arc_deviation(const program::Program& program, const ProgramWords& program_words, const FittedArc& arc);

} // namespace millwright::posts
