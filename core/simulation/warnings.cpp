#include "core/simulation/warnings.h"

#include "core/base/counted.h"

#include <fmt/format.h>

#include <algorithm>

namespace millwright::simulation {

bool is_in_stock(const Finding& finding) {
    return finding.kind == FindingKind::holder_in_stock || finding.kind == FindingKind::shank_in_stock;
}

std::vector<Diagnostic>
warnings_of(const Simulation& found, std::span<const ToolUse> tools, double resolution) {
    std::vector<Diagnostic> warnings;
    if (found.skipped && found.skipped->feeds > 0) {
        warnings.push_back({{{}, found.skipped->first_feed_line, 0, -1},
                            fmt::format("not simulated: {} before the program has positioned every "
                                        "axis that it uses, lines {} to {}",
                                        counted(found.skipped->feeds, "feed"),
                                        found.skipped->first_feed_line,
                                        found.skipped->last_feed_line),
                            "position all axes with rapid moves first"});
    }
    const auto narrow = std::ranges::find_if(tools, [resolution](const ToolUse& tool) {
        return tool.body && tool.body->shape().radius < resolution;
    });
    if (narrow != tools.end()) {
        warnings.push_back({{},
                            fmt::format("a tool of {:.3g} mm is narrower than two lines at a resolution of "
                                        "{:.3g} mm: what it cuts can be missed",
                                        2.0 * narrow->body->shape().radius,
                                        resolution),
                            {}});
    }
    if (found.cutting_moves == 0 && std::ranges::none_of(found.findings, is_in_stock)) {
        warnings.push_back({{}, "no move meets the stock: check its place and the work offset", {}});
    }
    return warnings;
}

} // namespace millwright::simulation
