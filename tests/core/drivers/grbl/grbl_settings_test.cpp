#include "core/drivers/grbl/grbl_settings.h"

#include "core/emulators/grbl/grbl_emulator.h"

#include <gtest/gtest.h>

#include <sstream>
#include <string>

namespace millwright::drivers {
namespace {

TEST(GrblSettings, ExplainEverySettingThatAControllerLists) {
    emulators::GrblEmulator grbl;
    (void)grbl.take_output();
    grbl.receive("$$\n");
    grbl.advance(0.5);
    std::istringstream lines(grbl.take_output());
    std::size_t count = 0;
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with('$')) {
            const GrblSetting* setting = find_grbl_setting(std::stoi(line.substr(1)));
            ASSERT_NE(setting, nullptr) << line;
            EXPECT_FALSE(setting->title.empty() || setting->explanation.empty() || setting->unit.empty());
            ++count;
        }
    }
    EXPECT_EQ(count, grbl_settings().size());
    EXPECT_EQ(find_grbl_setting(7), nullptr);
}

TEST(GrblSettings, AdviseToReportThePlannerWhereItIsNotReported) {
    EXPECT_TRUE(grbl_reports_advice(3).empty());
    EXPECT_TRUE(grbl_reports_advice(2).empty());
    EXPECT_NE(grbl_reports_advice(1).find("$10=3"), std::string_view::npos);
    EXPECT_FALSE(grbl_reports_advice(0).empty());
}

} // namespace
} // namespace millwright::drivers
