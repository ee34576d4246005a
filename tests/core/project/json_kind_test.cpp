#include "core/project/json_kind.h"

#include "core/base/files.h"
#include "core/project/color_choices.h"
#include "core/project/project.h"
#include "core/project/project_file.h"
#include "core/project/recent_files.h"
#include "core/project/taught_points.h"
#include "core/project/window_settings.h"
#include "tests/support/scratch_folder.h"

#include <gtest/gtest.h>

namespace millwright::project {
namespace {

TEST(JsonKind, IsThatOfWhatTheProgramWrites) {
    const test::ScratchFolder scratch;
    (void)write_project(project_from_preset("dome"), scratch / "a.json");
    write_taught_points({}, scratch / "b.json");
    write_recent({"/home/me/dome.json"}, scratch / "c.json");
    write_window_settings({{"theme", "light"}}, scratch / "d.json");
    write_colors({{"floor", "#102030"}}, scratch / "e.json");
    EXPECT_EQ(json_kind(scratch / "a.json"), "project");
    EXPECT_EQ(json_kind(scratch / "b.json"), "taught points");
    EXPECT_EQ(json_kind(scratch / "c.json"), "recent files");
    EXPECT_EQ(json_kind(scratch / "d.json"), "window settings");
    EXPECT_EQ(json_kind(scratch / "e.json"), "colours");
    EXPECT_TRUE(is_project_json(scratch / "a.json"));
    EXPECT_FALSE(is_project_json(scratch / "c.json"));
}

TEST(JsonKind, IsThatOfWhatComesWithTheProgram) {
    EXPECT_EQ(json_kind("assets/projects/sine.json"), "project");
    EXPECT_EQ(json_kind("assets/machines/ac-table.json"), "machine");
    EXPECT_TRUE(is_arm_json("assets/arms/scara.json"));
    EXPECT_EQ(json_kind("assets/tools/ball-6.json"), "tool");
    EXPECT_EQ(json_kind("assets/posts/grbl.json"), "post");
    EXPECT_EQ(json_kind("assets/materials/materials.json"), "materials");
}

TEST(JsonKind, IsPlainWhereNothingTellsMore) {
    const test::ScratchFolder scratch;
    for (const char* text : {"",
                             "[",
                             "[]",
                             "{",
                             "{\"format\"",
                             "{\"format\": \"",
                             "{\"format\": \"other\"}",
                             "[{\"",
                             "[{\"name\": \"a\"}]",
                             "3"}) {
        write_file(scratch / "some.json", text);
        EXPECT_EQ(json_kind(scratch / "some.json"), "JSON") << text;
    }
    EXPECT_EQ(json_kind(scratch / "missing.json"), "JSON");
    EXPECT_EQ(json_kind(scratch / "dome.ply"), "");
}

} // namespace
} // namespace millwright::project
