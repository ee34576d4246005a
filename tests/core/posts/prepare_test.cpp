#include "core/posts/prepare.h"

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/kinematics/forward.h"
#include "core/posts/post_file.h"
#include "tests/support/programs.h"
#include "tests/support/random_paths.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace millwright::posts {
namespace {

using kinematics::AxisPositions;

PostFormat post(const std::string& name) {
    return read_post("assets/posts/" + name + ".json");
}

TEST(PreparedProgram, IsTheSameInAxisPositionsOfFourDecimals) {
    const auto machine = test::machine("rotary-tilt-listing");
    const program::Program program = test::post_over("dome", machine, 6, 6).program;
    const PreparedProgram ready = prepare(program, machine, PostFormat{});
    ASSERT_EQ(ready.program.block_count(), program.block_count());
    for (int n = 0; n < program.block_count(); ++n) {
        const auto k = static_cast<std::size_t>(n);
        EXPECT_EQ(ready.program.blocks[k].target, program.blocks[k].target);
        EXPECT_FALSE(ready.program_words.blocks[k].tip);
    }
    EXPECT_EQ(ready.tip_deviation, 0.0);
}

TEST(PreparedProgram, RoundsToTheDigitsOfTheControl) {
    const auto machine = test::machine("router-xyz");
    std::mt19937 random(5);
    const PreparedProgram ready = prepare(test::random_moves(machine, 30, random), machine, post("grbl"));
    for (const program::Block& block : ready.program.blocks) {
        for (int n = 0; n < 3; ++n) {
            EXPECT_NEAR(std::remainder(block.target[n], 0.001), 0.0, 1e-12);
        }
    }
}

TEST(PreparedProgram, IsRefusedWhereTheControlLacksAnAxis) {
    const auto machine = test::machine("ac-table");
    const program::Program program = test::post_over("dome", machine, 4, 4).program;
    try {
        (void)prepare(program, machine, post("grbl"));
        FAIL() << "Grbl has no rotary axes";
    } catch (const Error& error) {
        EXPECT_STREQ(error.what(),
                     "Grbl 1.1 moves only X Y Z, but the program for 'A-on-C table' also moves A C (choose a "
                     "post for a control with these axes)");
    }
}

TEST(PreparedProgram, SaysWhichPositionTheMachineCannotReach) {
    const auto machine = test::machine("router-xyz");
    program::Program program = test::empty_program(machine);
    test::add_move(program, AxisPositions::Constant(3, 1e4));
    EXPECT_THROW((void)prepare(program, machine, PostFormat{}), Error);
}

/// A program of the tip for a shipped machine.
struct TipCase {
    kinematics::MachineModel machine;
    PostFormat format;
    program::Program program;
    PreparedProgram ready;

    TipCase(const std::string& machine_name, const std::string& post_name)
        : machine(test::machine(machine_name)), format(post(post_name)),
          program(test::post_over("dome", machine, 8, 8).program), ready(prepare(program, machine, format)) {}
};

class TipPrograms : public ::testing::TestWithParam<std::tuple<const char*, const char*>> {
protected:
    TipCase now{std::get<0>(GetParam()), std::get<1>(GetParam())};
};

TEST_P(TipPrograms, SayWhereTheTipIsOnThePart) {
    for (std::size_t n = 0; n < now.ready.program.blocks.size(); ++n) {
        const BlockWords& words = now.ready.program_words.blocks[n];
        const program::Block& block = now.ready.program.blocks[n];
        if (!block.moves() || !words.tip) {
            continue;
        }
        const Vec3 tip = kinematics::forward(now.machine, block.target).tip;
        const Vec3 said(words.to[now.machine.axis_index('X')],
                        words.to[now.machine.axis_index('Y')],
                        words.to[now.machine.axis_index('Z')]);
        EXPECT_LT((tip - said).cwiseAbs().maxCoeff(), 0.5001 * now.format.numbers.length.digit());
        for (const int axis : now.machine.rotary_axes()) {
            EXPECT_EQ(words.to[axis], block.target[axis]);
        }
    }
}

TEST_P(TipPrograms, BeginAndEndInMachinePositionsWithTheTableAtZero) {
    std::vector<int> moves;
    for (int n = 0; n < now.ready.program.block_count(); ++n) {
        if (now.ready.program.blocks[static_cast<std::size_t>(n)].moves()) {
            moves.push_back(n);
        }
    }
    const auto words = [&](int n) -> const BlockWords& {
        return now.ready.program_words.blocks[static_cast<std::size_t>(n)];
    };
    ASSERT_GE(moves.size(), 4U);
    EXPECT_FALSE(words(moves[0]).tip);
    EXPECT_FALSE(words(moves[1]).tip);
    EXPECT_TRUE(words(moves[2]).tip);
    EXPECT_FALSE(words(moves.back()).tip);
    for (const int axis : now.machine.rotary_axes()) {
        EXPECT_NEAR(words(moves[1]).to[axis] + now.machine.axis(axis).zero_offset, 0.0, 1e-12);
    }
    int switches = 0;
    for (std::size_t n = 1; n < moves.size(); ++n) {
        switches += words(moves[n]).tip != words(moves[n - 1]).tip ? 1 : 0;
    }
    EXPECT_EQ(switches, 2);
}

/// The largest distance of the axes' own way from the straight line of the tip.
double swing(const kinematics::MachineModel& machine, const AxisPositions& a, const AxisPositions& b) {
    const Vec3 begin = kinematics::forward(machine, a).tip;
    const Vec3 way = kinematics::forward(machine, b).tip - begin;
    double largest = 0.0;
    for (int k = 0; k <= 500; ++k) {
        const Vec3 off = kinematics::forward(machine, a + k / 500.0 * (b - a)).tip - begin;
        const double along = std::clamp(off.dot(way) / std::max(way.squaredNorm(), 1e-30), 0.0, 1.0);
        largest = std::max(largest, (off - along * way).norm());
    }
    return largest;
}

TEST_P(TipPrograms, KeepRapidsWhereTheyWereFoundClear) {
    double feeds = 0.0;
    for (int n = 0; n < now.ready.program.block_count(); ++n) {
        const program::Block& block = now.ready.program.blocks[static_cast<std::size_t>(n)];
        if (!block.moves() || !now.ready.program_words.blocks[static_cast<std::size_t>(n)].tip) {
            continue;
        }
        const double found = swing(now.machine, program::position_before(now.ready.program, n), block.target);
        if (block.kind == program::BlockKind::rapid) {
            EXPECT_LT(found, 1.02 * now.format.tip->rapid_tolerance + 0.002);
        } else {
            feeds = std::max(feeds, found);
        }
    }
    EXPECT_NEAR(now.ready.tip_deviation, feeds, 0.01 * feeds + 1e-9);
    EXPECT_GT(feeds, 0.01); // or there would be nothing to tell apart
}

TEST_P(TipPrograms, KeepFeedsOnTheWayOfStraightAxesWhereThatIsMeant) {
    constexpr double tolerance = 0.01; // mm
    const PreparedProgram near = prepare(now.program, now.machine, now.format, tolerance);
    double largest = 0.0;
    double before = 0.0;
    double after = 0.0;
    for (int n = 0; n < near.program.block_count(); ++n) {
        const program::Block& block = near.program.blocks[static_cast<std::size_t>(n)];
        if (block.kind == program::BlockKind::feed &&
            near.program_words.blocks[static_cast<std::size_t>(n)].tip) {
            largest = std::max(largest,
                               swing(now.machine, program::position_before(near.program, n), block.target));
            after += block.duration;
        }
    }
    for (const program::Block& block : now.ready.program.blocks) {
        before += block.kind == program::BlockKind::feed ? block.duration : 0.0;
    }
    EXPECT_GT(now.ready.tip_deviation, 2.0 * tolerance);
    EXPECT_LT(largest, 1.02 * tolerance + 0.002); // and the digits
    EXPECT_NEAR(near.tip_deviation, largest, 0.02 * largest);
    EXPECT_GT(near.program.block_count(), now.ready.program.block_count());
    EXPECT_NEAR(after, before, 0.01 * before); // the same time, but for the digits of inverse time
}

/// Where G54 is set such a program goes to other machine positions than its words say.
TEST(PreparedProgram, WritesNoMoveOfTheWorkInMachinePositions) {
    const auto machine = test::machine("router-xyz");
    program::Program program = test::empty_program(machine);
    test::add_move(program, AxisPositions{Vec3(0.0, 0.0, 20.0)});
    test::add_move(program, AxisPositions{Vec3(10.0, 10.0, 20.0)});
    for (program::Block& block : program.blocks) {
        block.kind = program::BlockKind::rapid;
    }
    for (const char* control : {"fanuc-tcp", "heidenhain", "linuxcnc-tcp"}) {
        const PreparedProgram ready = prepare(program, machine, post(control));
        ASSERT_EQ(ready.program.block_count(), 2) << control;
        for (const BlockWords& words : ready.program_words.blocks) {
            EXPECT_TRUE(words.tip) << control;
        }
    }
}

TEST(PreparedProgram, TurnsNoTableBelowAToolThatWasNotPulledOff) {
    const auto machine = test::machine("ac-table");
    program::Program program = test::empty_program(machine);
    AxisPositions to = AxisPositions::Zero(5);
    to[machine.axis_index('X')] = 10.0;
    test::add_move(program, to);
    program.blocks.back().kind = program::BlockKind::rapid;
    const PreparedProgram ready = prepare(program, machine, post("fanuc-tcp"));
    ASSERT_GE(ready.program.block_count(), 3);
    const int z = machine.axis_index('Z');
    const program::Block& first = ready.program.blocks[0];
    EXPECT_TRUE(first.named == program::AxisSet::only(z));
    EXPECT_EQ(first.target[z], machine.axis(z).max);
    EXPECT_FALSE(ready.program_words.blocks[0].tip);
    EXPECT_FALSE(ready.program_words.blocks[1].tip); // A and C to zero
    EXPECT_TRUE(ready.program_words.blocks[2].tip);
}

TEST(PreparedProgram, SaysWhichLineNoNumberOfPiecesKeepsNearEnough) {
    const auto machine = test::machine("ac-table");
    program::Program program = test::empty_program(machine);
    AxisPositions from = AxisPositions::Zero(5);
    AxisPositions to = from;
    to[0] = 200.0;
    to[machine.axis_index('C')] = 3.0;
    test::add_move(program, from);
    test::add_move(program, to);
    program.blocks.back().kind = program::BlockKind::feed;
    program.blocks.back().duration = 10.0;
    program.blocks.back().source_line = 7;
    try {
        (void)prepare(program, machine, post("fanuc-tcp"), 1e-9);
        FAIL() << "no digits are so fine";
    } catch (const Error& error) {
        EXPECT_EQ(error.diagnostic().place.line, 7);
        EXPECT_THAT(error.what(), testing::HasSubstr("the tip deviates by"));
    }
}

TEST_P(TipPrograms, KeepEveryBlockOfTheProgramInItsPlace) {
    std::size_t at = 0;
    for (const program::Block& block : now.program.blocks) {
        const auto& blocks = now.ready.program.blocks;
        const auto same = [&](const program::Block& other) {
            return other.kind == block.kind && other.text == block.text &&
                   other.path_point == block.path_point &&
                   (other.target - block.target).cwiseAbs().maxCoeff() < 0.001;
        };
        while (at < blocks.size() && !same(blocks[at])) {
            EXPECT_EQ(blocks[at].kind, program::BlockKind::rapid); // only pieces of rapids were added
            ++at;
        }
        ASSERT_LT(at, blocks.size());
        // The feed stays, and so the time follows the length as it is written, to four places.
        constexpr double share = 5e-4;
        EXPECT_NEAR(blocks[at].duration, block.duration, share * block.duration);
        ++at;
    }
    EXPECT_EQ(at, now.ready.program.blocks.size());
}

INSTANTIATE_TEST_SUITE_P(Shipped,
                         TipPrograms,
                         ::testing::Combine(::testing::Values("ac-table", "rotary-tilt-listing"),
                                            ::testing::Values("linuxcnc-tcp", "fanuc-tcp", "heidenhain")),
                         [](const auto& chosen) {
                             std::string name =
                                 std::string(std::get<0>(chosen.param)) + "_" + std::get<1>(chosen.param);
                             std::replace(name.begin(), name.end(), '-', '_');
                             return name;
                         });

} // namespace
} // namespace millwright::posts
