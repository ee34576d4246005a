#include "core/drivers/grbl/internal/messages.h"

#include "core/drivers/grbl/codes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace millwright::drivers::grbl {
namespace {

template <class Kind> bool is(std::string_view line) {
    return std::holds_alternative<Kind>(read_message(line));
}

TEST(GrblMessages, AreTakenApart) {
    EXPECT_TRUE(is<Ack>("ok"));
    EXPECT_TRUE(is<Blank>(""));
    EXPECT_EQ(std::get<ErrorAnswer>(read_message("error:22")).number, 22);
    EXPECT_EQ(std::get<AlarmMessage>(read_message("ALARM:9")).number, 9);
    EXPECT_EQ(std::get<Welcome>(read_message("Grbl 1.1f ['$' for help]")).who.version, "1.1f");
    EXPECT_EQ(std::get<SettingMessage>(read_message("$110=500.000")).value, 500.0);
    EXPECT_EQ(std::get<Feedback>(read_message("[MSG:Pgm End]")).text, "Pgm End");
    EXPECT_TRUE(std::get<StartupLine>(read_message(">G54G20:ok")).executed);
}

TEST(GrblMessages, ReadAStatusReport) {
    const auto report =
        std::get<StatusMessage>(read_message("<Hold:1|MPos:1.000,-2.500,0.001|Bf:15,128|Ln:99|FS:500,8000|Pn:"
                                             "XP|WCO:0.0,1.5,5.6|Ov:90,50,110|A:SF>"));
    EXPECT_EQ(report.state, MachineState::hold);
    EXPECT_EQ(report.sub_state, 1);
    EXPECT_TRUE(report.moving());
    EXPECT_EQ(*report.machine_position, (Axes{1.0, -2.5, 0.001}));
    EXPECT_EQ(*report.free_blocks, 15);
    EXPECT_EQ(*report.free_bytes, 128);
    EXPECT_EQ(*report.line, 99);
    EXPECT_EQ(*report.feed, 500.0);
    EXPECT_EQ(*report.spindle_rpm, 8000.0);
    EXPECT_EQ(report.pins, "XP");
    EXPECT_EQ((*report.offset)[2], 5.6);
    EXPECT_EQ((*report.overrides)[1], 50);
}

TEST(GrblMessages, AreGarbageWhenAByteIsWrong) {
    for (const char* line : {"0k",
                             "okk",
                             "o",
                             "error:",
                             "error:x",
                             "error:-1",
                             "ALARM:0",
                             "ALARM:1x",
                             "Grbl ",
                             "<Idle>",
                             "<Idel|MPos:0,0,0>",
                             "<Idle|MPos:0,0>",
                             "<Idle|MPos:0,0,x>",
                             "<Idle|MPos:0,0,0",
                             "<Idle|MPos:0,0,inf>",
                             "<Idle|MPos:0,0,0|Ln:-5>",
                             "<Idle|MPos:0,0,0|Bf:15>",
                             "<Idle|MPos:0,0,0|X-y:1>",
                             "<Idle|MPos:0,0,0,0,0,0,0,0,0,0>",
                             "$1",
                             "$x=1",
                             "[MSG]",
                             "hello"}) {
        EXPECT_TRUE(is<Garbage>(line)) << line;
    }
}

TEST(GrblMessages, ReadReportsOfFurtherAxesAndWithFurtherFields) {
    const auto report = std::get<StatusMessage>(read_message(
        "<Alarm:11|MPos:1.000,2.000,3.000,90.000,-45.000|FS:0,0,0|WCO:0,0,0,1,2|A:|Sc:|H:1,7|AR>"));
    EXPECT_EQ(report.state, MachineState::alarm);
    EXPECT_EQ(report.sub_state, 11);
    EXPECT_EQ(*report.machine_position, (Axes{1.0, 2.0, 3.0, 90.0, -45.0}));
    EXPECT_EQ((*report.offset)[4], 2.0);
    EXPECT_TRUE(report.foreign_fields);
    EXPECT_FALSE(std::get<StatusMessage>(read_message("<Idle|MPos:0,0,0|A:SF>")).foreign_fields);
    EXPECT_EQ(std::get<StatusMessage>(read_message("<Tool|MPos:0,0,0>")).state, MachineState::tool);
    EXPECT_EQ(std::get<NamedSetting>(read_message("$/axes/x/max_travel_mm=300.000")).name,
              "/axes/x/max_travel_mm");
    EXPECT_EQ(std::get<NamedSetting>(read_message("$302=192.168.5.1")).value, "192.168.5.1");
}

TEST(GrblMessages, ReadTheResultOfAProbe) {
    EXPECT_EQ(read_probe_result("1.0,2.0,-3.5:1")->position[2], -3.5);
    EXPECT_FALSE(read_probe_result("1.0,2.0,-3.5:0")->touched);
    EXPECT_FALSE(read_probe_result("1.0,2.0:1"));
}

TEST(GrblCodes, ExplainEveryErrorAndAlarm) {
    EXPECT_EQ(grbl_alarms().size(), 9u);
    for (int number = 1; number <= 38; ++number) {
        const bool gap = number == 18 || number == 19;
        EXPECT_EQ(explain_grbl_error(number).find("does not define") != std::string::npos, gap) << number;
    }
    for (int number = 1; number <= 9; ++number) {
        EXPECT_THAT(explain_grbl_alarm(number), testing::MatchesRegex("alarm [1-9]: [a-z].* \\(.*\\)"));
    }
}

} // namespace
} // namespace millwright::drivers::grbl
