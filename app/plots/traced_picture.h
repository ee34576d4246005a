// Pictures whose dark areas are traced, on the command line.
#pragma once

#include "app/plots/picture_choice.h"
#include "core/plot/picture/trace.h"

#include <vector>

namespace CLI {
class App;
} // namespace CLI

namespace millwright::app {

/// Adds --threshold, --speckle, --corner, --tolerance and --turns to `command`.
void add_tracing_options(CLI::App& command, plot::TraceSettings& tracing);

/// Outlines of what is dark. Throws Error where there are none, with what would help.
[[nodiscard]] std::vector<plot::TracedPath>
traced_outlines(const SizedPicture& sized, const PictureChoice& choice, const plot::TraceSettings& tracing);

} // namespace millwright::app
