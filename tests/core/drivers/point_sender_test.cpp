#include "core/drivers/point_sender.h"

#include "core/base/error.h"
#include "core/base/units.h"
#include "tests/support/machines.h"

#include <gtest/gtest.h>

namespace millwright::drivers {
namespace {

using Answer = PointSender::Answer;
using kinematics::AxisPositions;

AxisPositions axes(double x, double y, double z) {
    AxisPositions position(3);
    position << x, y, z;
    return position;
}

const RecordFormat steps{.pattern = "{X},{Y}", .ending = ";", .relative = true, .answer = "ok"};

TEST(PointSender, WritesTheSamePositionsAsLinesAndAsRecords) {
    const kinematics::MachineModel table = test::machine("forming-table");
    PointSender lines({.period = 0.5, .decimals = 1}, table);
    EXPECT_EQ(lines.heading(), "# millwright-stream 1 period_s 0.5 X mm Y mm Z mm\n");
    lines.begin(axes(1.0, 1.0, 0.0));
    EXPECT_EQ(lines.to(axes(1.5, 1.0, 0.0)), "1.5 1.0 0.0\n");
    EXPECT_FALSE(lines.asks() || lines.owed() || lines.writes_records());

    PointSender records({steps, 0.5, 1}, table);
    EXPECT_EQ(records.heading(), "");
    records.begin(axes(1.0, 1.0, 0.0));
    EXPECT_EQ(records.to(axes(1.5, 1.0, 0.0)), "0.5,0.0;");
    EXPECT_EQ(records.to(axes(1.5, 3.0, 0.0)), "0.0,2.0;") << "from where the last one led";
    EXPECT_EQ(records.line(axes(1.5, 3.0, 0.0)), "1.5 3.0 0.0\n");
}

TEST(PointSender, AMoveThatTheMachinePlansHasItsOwnSpeed) {
    PointSender sender({RecordFormat{.pattern = "{X} {s} {a}"}, 0.5, 1}, test::machine("forming-table"));
    sender.begin(axes(0.0, 0.0, 0.0));
    EXPECT_EQ(sender.to(axes(2.0, 0.0, 0.0)), "2.0 4.0 8.0\n") << "in a period";
    EXPECT_EQ(sender.to(axes(3.0, 0.0, 0.0), 7.0, 50.0), "3.0 7.0 50.0\n");
}

TEST(PointSender, TellsAnAnswerFromWhatWasNotAskedFor) {
    PointSender sender({steps, 0.5, 1}, test::machine("forming-table"));
    sender.begin(axes(0.0, 0.0, 0.0));
    EXPECT_FALSE(sender.hear("o"));
    EXPECT_EQ(sender.hear("k\n")->kind, Answer::unasked);
    (void)sender.to(axes(1.0, 0.0, 0.0));
    EXPECT_TRUE(sender.owed());
    EXPECT_EQ(sender.hear("ok\nok\n")->kind, Answer::right);
    EXPECT_FALSE(sender.owed());
    EXPECT_EQ(sender.hear()->kind, Answer::unasked) << "one for each position";
    (void)sender.to(axes(2.0, 0.0, 0.0));
    const auto heard = sender.hear("error 3\n");
    ASSERT_TRUE(heard);
    EXPECT_EQ(heard->kind, Answer::wrong);
    EXPECT_EQ(heard->line, "error 3");
}

TEST(PointSender, RefusesWhatNoMachineCouldRead) {
    const kinematics::MachineModel table = test::machine("forming-table");
    EXPECT_THROW(PointSender({.decimals = 10}, table), Error);
    EXPECT_THROW(PointSender({.record = RecordFormat{.pattern = "{C}"}}, table), Error);
}

} // namespace
} // namespace millwright::drivers
