#include "core/plot/left_alone.h"

#include "core/plot/linking.h"

#include <fmt/format.h>

namespace millwright::plot {

std::string left_alone(const Strokes& drawn, const ShapedStrokes& shaped) {
    if (shaped.open == 0) {
        return {};
    }
    if (closed_outlines(drawn).empty()) {
        return "no stroke is closed: none is filled or compensated";
    }
    return shaped.open == 1
               ? "1 stroke stays as it is, not closed: neither filled nor compensated"
               : fmt::format("{} strokes stay as they are, not closed: neither filled nor compensated",
                             shaped.open);
}

} // namespace millwright::plot
