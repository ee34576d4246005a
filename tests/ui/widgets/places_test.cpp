#include "ui/widgets/places.h"

#include "core/base/error.h"

#include <gtest/gtest.h>

namespace millwright::widgets {
namespace {

TEST(Places, APathIsMadeOfTheScopesAndTheId) {
    Places places;
    places.enter("grid");
    places.enter("weight");
    EXPECT_EQ(places.path("nu"), "grid/weight/nu");
    places.leave();
    EXPECT_EQ(places.path("nu"), "grid/nu");
    places.leave();
    EXPECT_EQ(places.path("nu"), "nu");
}

TEST(Places, APathUsedTwiceInAFrameIsADefect) {
    Places places;
    places.record("grid/nu", {});
    EXPECT_THROW(places.record("grid/nu", {}), Defect);
}

TEST(Places, APathMayComeBackInTheNextFrame) {
    Places places;
    places.record("grid/nu", {});
    places.clear();
    EXPECT_EQ(places.find("grid/nu"), nullptr);
    EXPECT_NO_THROW(places.record("grid/nu", {}));
}

TEST(Places, AScopeLeftOpenIsADefect) {
    Places places;
    places.enter("grid");
    EXPECT_THROW(places.clear(), Defect);
}

TEST(Places, AnEmptyIdIsADefect) {
    Places places;
    EXPECT_THROW(places.enter(""), Defect);
    EXPECT_THROW(places.record("", {}), Defect);
    EXPECT_THROW(places.record("grid/", {}), Defect);
}

} // namespace
} // namespace millwright::widgets
