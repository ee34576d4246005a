#include "core/project/window_settings.h"

#include "core/base/error.h"
#include "core/base/files.h"
#include "tests/support/scratch_folder.h"

#include <gtest/gtest.h>

namespace millwright::project {
namespace {

TEST(WindowSettings, SurviveTheirFile) {
    const test::ScratchFolder scratch;
    const auto place = window_settings_place(scratch / "new/recent.json");
    EXPECT_EQ(place.filename(), "window.json");
    EXPECT_TRUE(read_window_settings(place).empty());
    const WindowSettings settings{{"theme", "light"}, {"folder.program", "/with \"quotes\""}};
    write_window_settings(settings, place);
    EXPECT_EQ(read_window_settings(place), settings);
}

TEST(WindowSettings, HaveNoPlaceWhereNothingIsKept) {
    EXPECT_TRUE(window_settings_place({}).empty());
    EXPECT_TRUE(read_window_settings({}).empty());
}

TEST(WindowSettings, OfAnotherKindAreAnErrorWithItsPlace) {
    const test::ScratchFolder scratch;
    write_file(scratch / "window.json", "[{\"name\": \"theme\", \"value\": 3}]");
    try {
        (void)read_window_settings(scratch / "window.json");
        FAIL() << "read";
    } catch (const Error& error) {
        EXPECT_EQ(error.diagnostic().place.line, 1);
    }
}

} // namespace
} // namespace millwright::project
