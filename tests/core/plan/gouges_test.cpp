#include "core/plan/gouges.h"

#include "core/plan/cut_remarks.h"

#include <gtest/gtest.h>

namespace millwright::plan {
namespace {

BlockBite bite(int line, double depth, bool by_holder = false) {
    BlockBite made;
    made.block = line - 1;
    made.line = line;
    made.by_holder = by_holder;
    made.bite.depth = depth;
    return made;
}

TEST(GougeText, IsEmptyWhereNoBlockGouges) {
    CutStudy cut;
    cut.deepest = 0.05; // within the limit
    EXPECT_EQ(gouge_text(project::Project{}, cut), "");
}

TEST(GougeText, NamesTheDeepestLineOfCutterAndHolder) {
    project::Project project;
    project.tool.gouge_limit_mm = 0.25;
    const std::string checked = "; " + checked_text(project);
    CutStudy cut;
    cut.bites = {bite(20, 0.5), bite(31, 10.2421), bite(40, 0.75)};
    EXPECT_EQ(gouge_text(project, cut),
              "the cutter goes up to 10.2421 mm below the surface; the limit is 0.25 mm (3 blocks, the "
              "deepest in line 31)" +
                  checked);
    cut.bites.push_back(bite(52, 1.5, true));
    EXPECT_EQ(
        gouge_text(project, cut),
        "the cutter goes up to 10.2421 mm below the surface; the limit is 0.25 mm (3 blocks, the deepest in "
        "line 31); the holder penetrates the part by up to 1.5000 mm (1 block, the deepest in line 52)" +
            checked);
}

} // namespace
} // namespace millwright::plan
