#include "core/plan/set_up_edge.h"

#include "core/base/units.h"

#include <gtest/gtest.h>

namespace millwright::plan {
namespace {

TEST(SetUpEdge, ABestPlaceAtTheEdgeOfWhatWasSearchedSaysSo) {
    constexpr std::array<std::string_view, 4> names{"of a", "of b", "of c", "of the turn"};
    toolpath::SetUpSearch search;
    toolpath::SetUpSearchSettings within;
    within.least = {-60.0, -60.0, 45.0, -1.0};
    within.most = {60.0, 60.0, 205.0, 1.0};
    search.best.place = {10.0, 20.0, 204.9, 0.3};
    EXPECT_EQ(edge_sentence(search, within, names),
              "The best position is at the edge of the search range: c (of c). A wider search range may give "
              "a better one.");
    search.best.place = {-60.0, 20.0, 120.0, -1.0};
    EXPECT_NE(edge_sentence(search, within, names).find(": a (of a), turn (of the turn)."),
              std::string::npos);
    within.least[3] = -pi;
    within.most[3] = pi; // all the way round there is no edge
    search.best.place = {0.0, 0.0, 100.0, pi};
    EXPECT_EQ(edge_sentence(search, within, names), "");
    search.best.place = search.start.place = {60.0, 0.0, 100.0, 0.0};
    EXPECT_EQ(edge_sentence(search, within, names), "") << "where the part stood before";
}

} // namespace
} // namespace millwright::plan
