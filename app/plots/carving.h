// V-carving on the command line: its options, its program and its report.
#pragma once

#include "app/command_line/watched_work.h"
#include "app/plots/cutting.h"
#include "core/plot/carving/v_carving.h"
#include "core/plot_strokes/strokes.h"

#include <string>
#include <vector>

namespace CLI {
class App;
} // namespace CLI

namespace millwright::app {

struct CarvingOptions {
    CuttingOptions cutting;
    std::string tool = "v:60";
    plot::CarvingSettings settings = {}; ///< but for the tool, speeds and height
    bool leave_floor = false;
    bool json = false;
};

/// Adds them to `command`, with those of add_cutting_options().
void add_carving_options(CLI::App& command, CarvingOptions& options);

/// Carves what is closed of `drawn`, which is of `file`: writes the program, and says on standard output what
/// was carved, on standard error what a person should know. Throws Error, or Cancelled.
void carve_strokes(const plot::Strokes& drawn,
                   const std::string& file,
                   const CarvingOptions& options,
                   WatchedWork& work);

} // namespace millwright::app
