// The tool's length from the project to the tip: whatever stands in the spindle, the tip goes where it is to
// go.
#include "core/base/error.h"
#include "core/gcode/interpreter.h"
#include "core/gcode/tool_table.h"
#include "core/gcode_programs/machine_program.h"
#include "core/kinematics/forward.h"
#include "core/kinematics/inverse.h"
#include "core/posts/post_file.h"
#include "core/posts/release.h"
#include "core/program/program_settings.h"
#include "tests/support/machines.h"

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace millwright::posts {
namespace {

using kinematics::AxisPositions;
using kinematics::MachineModel;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr double machine_file_length = 40.0; // of the shipped machines that say one

/// Poses that lean by up to 25 degrees all around, tips on a dome.
std::vector<geometry::ToolPose> leaning_poses(const MachineModel& machine) {
    std::vector<geometry::ToolPose> poses;
    const bool leans = !machine.rotary_axes().empty();
    for (int n = 0; n < 24; ++n) {
        const double around = 0.7 * n;
        const double lean = leans ? 0.05 + 0.0165 * n : 0.0;
        const Vec3 axis(std::sin(lean) * std::cos(around), std::sin(lean) * std::sin(around), std::cos(lean));
        poses.push_back({Vec3(20.0 + n, 15.0 - 0.5 * n, 5.0 + 0.3 * n), axis});
    }
    return poses;
}

/// A rapid to each pose.
program::Program program_for(const MachineModel& machine, const std::optional<program::ProgramTool>& tool) {
    program::Program program;
    program.machine = machine.name();
    program.tool = tool;
    for (const kinematics::MachineAxis& axis : machine.axes()) {
        program.axes.push_back({axis.letter, axis.kind});
    }
    program.start = AxisPositions::Zero(machine.axis_count());
    AxisPositions at = program.start;
    for (const geometry::ToolPose& pose : leaning_poses(machine)) {
        const auto found = kinematics::inverse(machine, pose, at);
        EXPECT_FALSE(found.branches.empty()) << machine.name() << ": " << found.why;
        at = found.branches.front();
        program::Block& block = program.blocks.emplace_back();
        block.kind = program::BlockKind::rapid;
        block.target = at;
        block.named = program::AxisSet::all(machine.axis_count());
    }
    program::Block& end = program.blocks.emplace_back();
    end.kind = program::BlockKind::end;
    end.target = at;
    return program;
}

/// Where a control whose tool table has the true length takes the axes.
std::vector<AxisPositions>
read_by_control(const std::string& text, const MachineModel& machine, double length_offset) {
    gcode::MachineProgramBuilder builder(machine, "text", {});
    gcode::ReaderSettings settings;
    settings.tools = gcode::parse_tool_table(fmt::format("T7 P7 Z{:.6f}\n", length_offset), "t.tbl");
    gcode::Interpreter reader(std::string_view(text), "text", std::move(settings), builder);
    reader.run();
    EXPECT_TRUE(reader.errors().empty());
    std::vector<AxisPositions> positions;
    for (const program::Block& block : builder.take().program.blocks) {
        if (block.moves()) {
            positions.push_back(block.target);
        }
    }
    return positions;
}

/// The tip of a tool of that length by a model of its own: a point on the spindle's axis, carried by the
/// head.
Vec3 tip_by_the_gauge_point(const MachineModel& file, const AxisPositions& at, double length) {
    const kinematics::MachineDescription& of = file.description();
    Vec3 point = of.tool_tip + (machine_file_length - length) * of.tool_axis;
    for (auto n = of.head.rbegin(); n != of.head.rend(); ++n) {
        const double by = at[file.axis_index(n->letter)] + n->zero_offset;
        if (n->kind == kinematics::AxisKind::linear) {
            point += by * n->direction;
        } else {
            point = n->point + Eigen::AngleAxisd(by, n->direction) * (point - n->point);
        }
    }
    for (const kinematics::MachineAxis& axis : of.table) {
        const double by = at[file.axis_index(axis.letter)] + axis.zero_offset;
        if (axis.kind == kinematics::AxisKind::linear) {
            point -= by * axis.direction;
        } else {
            point = axis.point + Eigen::AngleAxisd(-by, axis.direction) * (point - axis.point);
        }
    }
    return point - of.table_origin - of.workpiece_offset;
}

class ToolLength : public ::testing::TestWithParam<const char*> {};

TEST_P(ToolLength, ALongerToolLeavesTheTipWhereItIs) {
    const MachineModel file = test::machine(GetParam());
    for (const double length : {25.0, 40.0, 90.0}) {
        const double longer = length - machine_file_length;
        const MachineModel machine = file.with_tool_length(length);
        const program::Program program =
            program_for(machine, program::ProgramTool{7, machine.description().tool_length_offset});
        const ReleasedText text = release(program, machine, PostFormat{});
        EXPECT_THAT(text.listing.text, HasSubstr("\nT7 M6\nG43 H7\n"));
        const std::vector<AxisPositions> control = read_by_control(text.listing.text, file, longer);
        const std::vector<geometry::ToolPose> poses = leaning_poses(machine);
        ASSERT_EQ(control.size(), poses.size());
        for (std::size_t n = 0; n < poses.size(); ++n) {
            const Vec3 tip = tip_by_the_gauge_point(file, control[n], length);
            EXPECT_LT((tip - poses[n].tip).norm(), 1e-3) << GetParam() << ", " << length << " mm, pose " << n;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(EveryMachine,
                         ToolLength,
                         ::testing::Values("ac-table",
                                           "tilted-c-table",
                                           "bc-table-head",
                                           "ca-head",
                                           "rotary-tilt-listing",
                                           "rotary-tilt-chapter3",
                                           "rotary-tilt-gui",
                                           "router-xyz"),
                         [](const auto& param) {
                             std::string name = param.param;
                             std::erase(name, '-');
                             return name;
                         });

TEST(ToolLengths, OnASwingingHeadTheBlocksDependOnTheLengthEvenWithoutATool) {
    const MachineModel file = test::machine("bc-table-head");
    const auto text_of = [&](double length, const std::optional<program::ProgramTool>& tool) {
        const MachineModel machine = file.with_tool_length(length);
        return release(program_for(machine, tool), machine, PostFormat{}).listing.text;
    };
    EXPECT_NE(text_of(40.0, program::ProgramTool{1, 0.0}), text_of(90.0, program::ProgramTool{1, 50.0}));
    EXPECT_NE(text_of(40.0, std::nullopt), text_of(90.0, std::nullopt));
    EXPECT_THAT(text_of(90.0, std::nullopt), Not(HasSubstr("G43")));
}

TEST(ToolLengths, ATableMachineHasTheSameTextForEveryLength) {
    const MachineModel file = test::machine("ac-table");
    const auto text_of = [&](double length) {
        const MachineModel machine = file.with_tool_length(length);
        return release(program_for(machine, program::ProgramTool{1, length - machine_file_length}),
                       machine,
                       PostFormat{})
            .listing.text;
    };
    EXPECT_EQ(text_of(40.0), text_of(90.0));
}

PostFormat post_of(std::string_view name) {
    return read_post(fmt::format("assets/posts/{}.json", name));
}

TEST(ToolLengths, EachControlCallsTheToolInItsOwnWords) {
    const MachineModel machine = test::machine("ac-table").with_tool_length(60.0);
    const program::Program program = program_for(machine, program::ProgramTool{12, 20.0});
    const auto text_of = [&](std::string_view post) {
        return release(program, machine, post_of(post)).listing.text;
    };
    EXPECT_THAT(text_of("linuxcnc"), HasSubstr("\nT12 M6\nG43 H12\n"));
    EXPECT_THAT(text_of("linuxcnc-tcp"), HasSubstr("\nT12 M6\nG43 H12\n"));
    EXPECT_THAT(text_of("fanuc-tcp"), HasSubstr("\nT12 M6\n"));
    EXPECT_THAT(text_of("fanuc-tcp"), HasSubstr("G43.4 H12"));
    EXPECT_THAT(text_of("heidenhain"), HasSubstr("TOOL CALL 12 Z\n"));
}

/// Of a program without a tool of its own that stops for these.
program::Program program_that_stops_for(const MachineModel& machine, const std::vector<std::string>& texts) {
    program::Program program = program_for(machine, std::nullopt);
    program::Block spindle = program.blocks.front();
    spindle.kind = program::BlockKind::spindle_on;
    spindle.named = {};
    spindle.spindle_rpm = 5000.0;
    program.blocks.insert(program.blocks.begin(), spindle);
    for (const std::string& text : texts) {
        program::Block pause = spindle;
        pause.kind = text.starts_with("tool ") ? program::BlockKind::comment : program::BlockKind::pause;
        pause.pause = program::PauseKind::tool_change;
        pause.spindle_rpm = 0.0;
        pause.text = text;
        program.blocks.insert(program.blocks.begin(), pause);
    }
    return program;
}

// A control that keeps the tip takes its length from the tool that is called: tool 1 was called whatever the
// operator had put in.
TEST(ToolLengths, TheToolThatTheOperatorPutsInIsTheOneThatIsCalled) {
    const MachineModel machine = test::machine("ac-table");
    const auto text_of = [&](std::string_view post, const std::vector<std::string>& pauses) {
        return release(program_that_stops_for(machine, pauses), machine, post_of(post)).listing.text;
    };
    for (const char* text : {"change to tool 3", "put in tool 3", "tool 3"}) {
        EXPECT_THAT(text_of("heidenhain", {text, "pallet change"}), HasSubstr("TOOL CALL 3 Z S5000\n"))
            << text;
        EXPECT_THAT(text_of("fanuc-tcp", {text}), HasSubstr("G43.4 H3\n")) << text;
    }
    EXPECT_THAT(text_of("heidenhain", {"change to tool 3", "change to tool 3"}),
                HasSubstr("TOOL CALL 3 Z S"));
    EXPECT_THAT(text_of("heidenhain", {"change to tool 3 and 4"}), HasSubstr("TOOL CALL 1 Z S"));
    const std::vector<std::string> two{"change to tool 12", "put in tool 3"};
    for (const char* post : {"heidenhain", "fanuc-tcp"}) {
        try {
            (void)text_of(post, two);
            FAIL() << post;
        } catch (const Error& error) {
            EXPECT_THAT(error.what(), HasSubstr("the program uses tools 3 and 12")) << post;
            EXPECT_EQ(error.diagnostic().hint, "divide the program at its tool changes");
        }
    }
    EXPECT_NO_THROW((void)text_of("linuxcnc", two));
}

TEST(ToolLengths, GrblIsToldNothingAndThePersonWhatToDo) {
    const MachineModel machine = test::machine("router-xyz").with_tool_length(60.0);
    const program::Program program = program_for(machine, program::ProgramTool{3, 0.0});
    const std::string text = release(program, machine, post_of("grbl")).listing.text;
    EXPECT_THAT(text, HasSubstr("(set the zero of Z with tool 3: its length is not compensated)"));
    EXPECT_THAT(text, Not(HasSubstr("G43")));
    EXPECT_THAT(text, Not(HasSubstr("M6")));
    EXPECT_THAT(text, HasSubstr("Z5.000"));
}

/// A router's zero of Z is set with each tool.
TEST(ToolLengths, WhereTheMachineFileSaysNoneItsZerosHoldForAny) {
    const MachineModel file = test::machine("router-xyz");
    ASSERT_FALSE(file.description().tool_length.has_value());
    EXPECT_EQ(file.with_tool_length(90.0).description().tool_tip, file.description().tool_tip);
    kinematics::MachineDescription swinging = test::machine("bc-table-head").description();
    swinging.tool_length.reset();
    EXPECT_THROW((void)MachineModel(swinging).with_tool_length(90.0), Error);
}

TEST(ToolLengths, G43AloneCannotCompensateAToolThatLiesAcross) {
    kinematics::MachineDescription across = test::machine("router-xyz").description();
    across.tool_axis = Vec3::UnitX();
    across.tool_length = 40.0;
    const MachineModel machine = MachineModel(across).with_tool_length(60.0);
    EXPECT_FALSE(machine.compensates_along_z());
    program::Program program = program_for(test::machine("router-xyz"), program::ProgramTool{3, 20.0});
    EXPECT_THROW((void)release(program, machine, PostFormat{}), Error);
    program.tool.reset();
    EXPECT_NO_THROW((void)release(program, machine, PostFormat{}));
}

TEST(ToolLengths, ATextThatForgetsTheLengthIsNotReleased) {
    const MachineModel machine = test::machine("ac-table").with_tool_length(60.0);
    const program::Program program = program_for(machine, program::ProgramTool{12, 20.0});
    PostFormat forgetful;
    forgetful.blocks.tool = {"T{tool} M6"};
    EXPECT_THROW((void)release(program, machine, forgetful), Error);
    PostFormat other_tool;
    other_tool.blocks.tool = {"T1 M6", "G43 H{tool}"};
    EXPECT_THROW((void)release(program, machine, other_tool), Error);
}

TEST(ToolLengths, ArcsAreCheckedUnderTheLength) {
    const MachineModel machine = test::machine("router-xyz").with_tool_length(60.0);
    program::Program program = program_for(machine, program::ProgramTool{2, 20.0});
    program.blocks.resize(1);
    const AxisPositions begin = program.blocks.front().target;
    for (int n = 1; n <= 20; ++n) { // a quarter of a circle in Z X
        const double angle = 1.5707963267948966 * n / 20.0;
        program::Block& block = program.blocks.emplace_back();
        block.kind = program::BlockKind::feed;
        block.duration = 0.1;
        block.named = program::AxisSet::all(3);
        block.target = begin + Vec3(10.0 * std::sin(angle), 0.0, 10.0 * (1.0 - std::cos(angle)));
    }
    program::Block& end = program.blocks.emplace_back();
    end.kind = program::BlockKind::end;
    end.target = program.blocks[program.blocks.size() - 2].target;
    const ReleasedText text = release(program, machine, post_of("linuxcnc-xyz"), {.arc_tolerance = 0.01});
    EXPECT_EQ(text.arcs, 1);
}

} // namespace
} // namespace millwright::posts
