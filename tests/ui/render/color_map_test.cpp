// Sampled against other entries of the published tables than those that are built in.
#include "ui/render/color_map.h"

#include "core/base/error.h"

#include <glm/common.hpp>
#include <gtest/gtest.h>

#include <limits>

namespace millwright::render {
namespace {

void expect_close(const glm::vec3& color, const glm::vec3& published) {
    constexpr float tolerance = 0.025F; // of 16 colours in place of 256
    EXPECT_NEAR(color.r, published.r, tolerance);
    EXPECT_NEAR(color.g, published.g, tolerance);
    EXPECT_NEAR(color.b, published.b, tolerance);
}

TEST(ColorMap, HasTheColoursOfThePublishedViridis) {
    expect_close(sample(ColorMap::viridis, 196.0 / 255.0), {0.404001F, 0.800275F, 0.362552F});
    expect_close(sample(ColorMap::viridis, 216.0 / 255.0), {0.606045F, 0.850733F, 0.236712F});
    expect_close(sample(ColorMap::viridis, 1.0), {0.993248F, 0.906157F, 0.143936F});
}

TEST(ColorMap, HasTheColoursOfThePublishedCividis) {
    expect_close(sample(ColorMap::cividis, 0.0), {0.0F, 0.135112F, 0.304751F});
    expect_close(sample(ColorMap::cividis, 60.0 / 255.0), {0.247605F, 0.296986F, 0.422917F});
    expect_close(sample(ColorMap::cividis, 145.0 / 255.0), {0.551612F, 0.534849F, 0.471439F});
    expect_close(sample(ColorMap::cividis, 230.0 / 255.0), {0.896818F, 0.811030F, 0.320982F});
}

TEST(ColorMap, GetsBrighterAllTheWay) {
    for (const ColorMap map : {ColorMap::viridis, ColorMap::cividis}) {
        double before = -1.0;
        for (int i = 0; i <= 1000; ++i) {
            const double now = luminance(sample(map, i / 1000.0));
            EXPECT_GT(now, before) << name(map) << " at " << i;
            before = now;
        }
    }
}

TEST(ColorMap, KeepsItsEndColoursOutside) {
    EXPECT_EQ(sample(ColorMap::viridis, -3.0), sample(ColorMap::viridis, 0.0));
    EXPECT_EQ(sample(ColorMap::viridis, std::numeric_limits<double>::infinity()),
              sample(ColorMap::viridis, 1.0));
}

TEST(ColorMap, RefusesWhatIsNoNumber) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(static_cast<void>(sample(ColorMap::cividis, nan)), Defect);
}

TEST(Luminance, IsThatOfTheStandard) {
    EXPECT_NEAR(luminance(glm::vec3(1.0F)), 1.0, 1e-9);
    EXPECT_NEAR(luminance({0.0F, 1.0F, 0.0F}), 0.7152, 1e-9);
    EXPECT_NEAR(contrast(glm::vec3(0.0F), glm::vec3(1.0F)), 21.0, 1e-9);
}

TEST(ColorScale, ShowsTheSignalColourOnlyAboveTheLimit) {
    const ColorScale scale = {.low = 0.0, .high = 10.0, .limit = 8.0, .over_limit = {1.0F, 0.0F, 0.0F}};
    EXPECT_EQ(color_of(scale, 8.0), sample(ColorMap::viridis, 0.8));
    EXPECT_EQ(color_of(scale, 8.001), scale.over_limit);
}

TEST(ColorScale, HasOneColourWhenItsEndsAreTheSame) {
    const ColorScale scale = {.low = 2.0, .high = 2.0};
    EXPECT_EQ(color_of(scale, 2.0), sample(ColorMap::viridis, 0.0));
    EXPECT_EQ(color_of(scale, 5.0), sample(ColorMap::viridis, 0.0));
}

} // namespace
} // namespace millwright::render
