#include "core/plan/set_up_edge.h"

#include "core/base/units.h"
#include "core/plan/set_up_study.h"

#include <fmt/format.h>

#include <algorithm>

namespace millwright::plan {

namespace {

constexpr double near = 1e-3; // of the way from edge to edge: where a descent may settle

bool at_edge(const toolpath::SetUpPlace& place, const toolpath::SetUpSearchSettings& within, Eigen::Index n) {
    const double room = within.most[n] - within.least[n];
    const bool is_round = n == 3 && room > 2.0 * pi - near; // a whole turn has no edge
    const double left = std::min(place[n] - within.least[n], within.most[n] - place[n]);
    return room > 0.0 && !is_round && left <= near * room;
}

} // namespace

std::string edge_sentence(const toolpath::SetUpSearch& search,
                          const toolpath::SetUpSearchSettings& within,
                          const std::array<std::string_view, 4>& reach_names) {
    if (search.best.place == search.start.place) {
        return {};
    }
    std::string limits;
    for (std::size_t n = 0; n < reach_names.size(); ++n) {
        if (at_edge(search.best.place, within, static_cast<Eigen::Index>(n))) {
            limits += fmt::format("{}{} ({})",
                                  limits.empty() ? "" : ", ",
                                  name(static_cast<toolpath::SetUpParameter>(n)),
                                  reach_names.at(n));
        }
    }
    return limits.empty() ? std::string()
                          : "The best position is at the edge of the search range: " + limits +
                                ". A wider search range may give a better one.";
}

} // namespace millwright::plan
