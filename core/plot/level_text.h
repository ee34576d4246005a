// Levels as people write them on a command line.
#pragma once

#include "core/plot/cut_path.h"

#include <string_view>

namespace millwright::plot {

/// `PEN` or `PEN:what,...`, where what is `depth=MM`, `passes=N`, `feed=MM/MIN`, `plunge=MM/MIN`, `order=N`,
/// `tool=N`, `side=on-line|outside|inside`, `cutter=MM`, `tabs=N` or `off`, each once; the rest is as in
/// `like`. Throws Error quoting what is none of them.
[[nodiscard]] Level parse_level(std::string_view text, const Level& like);

} // namespace millwright::plot
