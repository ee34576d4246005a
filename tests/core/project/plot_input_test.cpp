#include "core/project/plot_input.h"

#include "core/project/gcode_file.h"

#include <gtest/gtest.h>

#include <string>
#include <string_view>

namespace millwright::project {
namespace {

using plot::Level;

TEST(PlotInput, FilesAreToldByTheirNames) {
    EXPECT_TRUE(is_plot_file("sign.PLT"));
    EXPECT_TRUE(is_plot_file("photo.JPeG"));
    EXPECT_TRUE(is_picture_file("photo.bmp"));
    EXPECT_TRUE(is_picture_file("photo.pgm"));
    EXPECT_FALSE(is_picture_file("sign.plt"));
    EXPECT_TRUE(is_path_file("sign.path"));
    EXPECT_TRUE(is_plot_file("points.csv"));
    EXPECT_TRUE(is_point_file("points.CSV"));
    EXPECT_FALSE(is_plot_file("sign.ngc"));
    EXPECT_FALSE(is_plot_file("plt"));
}

TEST(PlotInput, TheKindsThatAreNamedAreThoseThatAreOpened) {
    const std::string text = plot_file_kinds_text();
    for (const PlotFileKind& kind : plot_file_kinds()) {
        EXPECT_NE(text.find(kind.name), std::string::npos);
        for (const std::string_view ending : kind.endings) {
            const std::string file = "file" + std::string(ending);
            EXPECT_TRUE(is_plot_file(file) || is_gcode_file(file)) << file;
            EXPECT_NE(text.find(ending), std::string::npos) << ending;
        }
    }
    for (const char* ending : {".hpg", ".ppm", ".path", ".csv", ".pts", ".txt", ".tap"}) {
        EXPECT_NE(text.find(ending), std::string::npos) << ending;
    }
}

TEST(PlotInput, APensOnlyLevelIsSwitchedOffAndASecondOneGoes) {
    std::vector<Level> levels{{.pen = 1}, {.pen = 2}};
    repeat_level(levels, 0);
    ASSERT_EQ(levels.size(), 3U);
    EXPECT_EQ(levels[1].pen, 1);
    remove_level(levels, 0);
    ASSERT_EQ(levels.size(), 2U);
    EXPECT_TRUE(levels[0].enabled);
    remove_level(levels, 0);
    ASSERT_EQ(levels.size(), 2U);
    EXPECT_FALSE(levels[0].enabled);
    EXPECT_TRUE(levels[1].enabled);
}

TEST(PlotInput, AMaterialSetsEveryPenAndRoughsWhatIsDeep) {
    const plot::CuttingValues values{
        .feed = {25.0, ""}, .plunge = {5.0, ""}, .depth_per_pass = {1.5, ""}, .spindle_rpm = {9000.0, ""}};
    PlotSettings settings;
    settings.depth = 1.0;
    use_material(settings, {{.pen = 3, .depth = 3.0}, {.pen = 4, .depth = 3.1}}, values);
    ASSERT_EQ(settings.levels.size(), 2U);
    EXPECT_EQ(settings.levels[0].passes, 2); // 3 mm are two passes of 1.5 mm, not three
    EXPECT_EQ(settings.levels[1].passes, 3);
    EXPECT_DOUBLE_EQ(settings.levels[1].cutting, 25.0);
    EXPECT_DOUBLE_EQ(settings.level.plunging, 5.0);
    EXPECT_EQ(settings.spindle_rpm, 9000.0);
    EXPECT_FALSE(settings.depth_per_pass);
    settings.depth = 4.0;
    use_material(settings, {}, values);
    EXPECT_EQ(settings.depth_per_pass, 1.5);
}

} // namespace
} // namespace millwright::project
