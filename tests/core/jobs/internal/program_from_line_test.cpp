// Programs that are planned here, begun in their middle: from anywhere the tool comes off the part first,
// then across, and down to where the line begins; the rest is the program's own.
#include "core/jobs/internal/program_from_line.h"

#include "core/base/error.h"
#include "core/drivers/virtual_machine/virtual_machine.h"
#include "core/jobs/dispatcher.h"
#include "core/kinematics/forward.h"
#include "core/program/program_settings.h"
#include "core/program/retract.h"
#include "tests/support/jobs.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace millwright::jobs {
namespace {

using kinematics::AxisPositions;
using program::BlockKind;
using ::testing::HasSubstr;

Job surface_job(const std::string& machine_name, const std::string& preset) {
    const auto machine = test::machine(machine_name);
    program::ProgramSettings settings;
    settings.coolant = true;
    program::Program program = test::post_over(preset, machine, 6, 7, settings).program;
    Job job = test::job_of(std::move(program));
    job.machine = std::make_shared<const kinematics::MachineModel>(machine);
    return job;
}

/// Pockets in a plate, one below the other.
Job pocketing_job() {
    const auto router = test::machine("router-xyz");
    program::Program program = test::empty_program(router);
    test::add_block(program, BlockKind::spindle_on);
    program.blocks.back().spindle_rpm = 9000.0;
    for (int n = 0; n < 12; ++n) {
        const double depth = -1.0 - n % 3;
        const double x = 10.0 * n;
        for (const auto& [at, duration] : {std::pair{Vec3(x, 0, 30), 0.0},
                                           {Vec3(x, 0, depth), 2.0},
                                           {Vec3(x, 50, depth), 3.0},
                                           {Vec3(x + 5, 50, depth), 0.5},
                                           {Vec3(x + 5, 50, 30), 0.0}}) {
            test::add_move(program, AxisPositions(at), duration);
            program.blocks.back().feed = duration > 0.0 ? 16.0 : 0.0;
        }
    }
    test::add_block(program, BlockKind::spindle_off);
    test::add_block(program, BlockKind::end);
    Job job = test::job_of(std::move(program));
    job.machine = std::make_shared<const kinematics::MachineModel>(router);
    return job;
}

/// A place inside the travel where somebody may have left the machine.
AxisPositions anywhere(const kinematics::MachineModel& machine, std::mt19937& random) {
    AxisPositions position = AxisPositions::Zero(machine.axis_count());
    for (int n = 0; n < machine.axis_count(); ++n) {
        const double low = std::max(machine.axis(n).min, -100.0);
        const double high = std::min(machine.axis(n).max, 100.0);
        position[n] = std::uniform_real_distribution(low, high)(random);
    }
    return position;
}

struct Accessories {
    double rpm = 0.0;
    bool coolant = false;

    friend bool operator==(const Accessories&, const Accessories&) = default;
};

/// As the first `count` blocks leave them.
Accessories accessories_after(const program::Program& program, int count) {
    Accessories now;
    for (int n = 0; n < count; ++n) {
        const program::Block& block = program.blocks[static_cast<std::size_t>(n)];
        now.rpm = block.kind == BlockKind::spindle_on    ? block.spindle_rpm
                  : block.kind == BlockKind::spindle_off ? 0.0
                                                         : now.rpm;
        now.coolant =
            block.kind == BlockKind::coolant_on || (now.coolant && block.kind != BlockKind::coolant_off);
    }
    return now;
}

/// Off the part, then across, then down: recognised from samples of the motion alone.
void expect_safe(const Job& rest, int approach, const AxisPositions& start) {
    const motion::Trajectory motion = motion::plan(*rest.program, *rest.machine, rest.planner, {}, start);
    const program::RetractAxis up = program::retract_axis(*rest.machine);
    const AxisPositions& begin = program::position_before(*rest.program, approach);
    const double safe = rest.program->blocks.front().target[up.axis];
    const double end = motion.end_of(approach - 1);
    bool across = false;
    bool down = false;
    constexpr int samples = 2000;
    for (int k = 0; k <= samples; ++k) {
        const AxisPositions now = motion.at(end * k / samples).position;
        AxisPositions others = now - start;
        others[up.axis] = 0.0;
        const bool off = std::abs(now[up.axis] - safe) < 1e-6;
        const bool moved = others.cwiseAbs().maxCoeff() > 1e-9;
        ASSERT_TRUE(off || !moved || across) << "across before it is off the part";
        across = across || (off && moved);
        if (across && !off) {
            down = true;
            const Vec3 tip = kinematics::forward(*rest.machine, now).tip;
            const Vec3 goal = kinematics::forward(*rest.machine, begin).tip;
            const bool rotated = [&] {
                for (int n = 0; n < rest.machine->axis_count(); ++n) {
                    const bool rotary = rest.machine->axis(n).kind == kinematics::AxisKind::rotary;
                    if (rotary && std::abs(now[n] - begin[n]) > 1e-6) {
                        return true;
                    }
                }
                return false;
            }();
            ASSERT_FALSE(rotated) << "the tool turns while it comes down";
            if (k == samples) {
                EXPECT_LT((tip - goal).norm(), 1e-6);
            }
        }
    }
    EXPECT_TRUE(down || std::abs(begin[up.axis] - safe) < 1e-6);
    EXPECT_LT((motion.at(end).position - begin).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(ProgramFromLine, ComesToEachLineFromAboveAndGoesOnAsTheProgramDoes) {
    std::mt19937 random(3);
    int begun = 0;
    for (const Job& job :
         {surface_job("rotary-tilt-listing", "dome"), surface_job("ac-table", "two-bell"), pocketing_job()}) {
        for (int line = 1; line <= job.listing->line_count(); ++line) {
            Job rest;
            try {
                rest = job_from_line(job, line, {});
            } catch (const Error& error) {
                ASSERT_TRUE(std::string(error.what()).find("one of the first") != std::string::npos &&
                            line <= 20)
                    << error.what();
                continue;
            }
            ++begun;
            const int left = static_cast<int>(job.listing->line_of_block.end() -
                                              std::ranges::lower_bound(job.listing->line_of_block, line));
            const int approach = rest.program->block_count() - left;
            const int block = job.program->block_count() - left;
            ASSERT_TRUE(preflight(rest).empty()) << to_text(preflight(rest).front());
            EXPECT_EQ(rest.from_line, line);
            EXPECT_EQ(rest.hash, program_hash(job.listing->text));
            expect_safe(rest, approach, anywhere(*job.machine, random));
            EXPECT_EQ(accessories_after(*rest.program, approach), accessories_after(*job.program, block));
            for (int n = 0; n < left; ++n) {
                const auto at = [n](const Job& one, int first) -> const program::Block& {
                    return one.program->blocks[static_cast<std::size_t>(first + n)];
                };
                ASSERT_EQ(at(rest, approach).target, at(job, block).target);
                ASSERT_EQ(at(rest, approach).kind, at(job, block).kind);
                const int shown = rest.listing->line_of_block[static_cast<std::size_t>(approach + n)];
                ASSERT_EQ(shown, job.listing->line_of_block[static_cast<std::size_t>(block + n)]);
                ASSERT_EQ(rest.listing->line(shown), job.listing->line(shown));
            }
        }
    }
    EXPECT_GT(begun, 100);
}

TEST(ProgramFromLine, IsRunAndLoggedByTheLinesOfTheFile) {
    const test::TemporaryFolder folder;
    test::ManualClock clock;
    const Job job = surface_job("rotary-tilt-listing", "dome");
    drivers::VirtualMachine machine(job.program->start, {}, clock);
    Dispatcher dispatcher(machine, clock, folder.path());
    const Job rest = job_from_line(job, 30, {});
    const JobOutcome outcome = dispatcher.run(rest, {});
    EXPECT_EQ(outcome.end, JobEnd::done) << outcome.sentence;
    const ReadLog log = read_job_log(outcome.log_file);
    EXPECT_EQ(log.start.from_line, 30);
    EXPECT_EQ(log.start.program_hash, program_hash(job.listing->text));
    EXPECT_EQ(log.next_line(), rest.listing->line_count());
    EXPECT_EQ(outcome.position, job.program->blocks.back().target);
}

TEST(ProgramFromLine, GoesDownAsFastAsTheFileThatWasReadDoes) {
    const auto table = std::make_shared<const kinematics::MachineModel>(test::machine("forming-table"));
    const auto last_way_down = [&](const std::string& plunge) {
        std::string text = "G21 G90\nG0 Z5\nG0 X5 Y5\n" + plunge + "\n";
        for (int n = 0; n < 20; ++n) {
            text += fmt::format("G1 X{} F600\n", 6 + n);
        }
        const Job rest = job_from_line(planned_job(text + "M2\n", "part.ngc", table), 20, {});
        const auto& blocks = rest.program->blocks;
        const auto way = std::find_if(blocks.begin(), blocks.end(), [](const program::Block& block) {
            return block.kind == BlockKind::feed && block.target[2] < 0.0;
        });
        return way->feed;
    };
    EXPECT_NEAR(last_way_down("G1 Z-1 F120"), 2.0, 1e-12);
    EXPECT_NEAR(last_way_down("G1 X5.5 Z-1 F120"), program::ProgramSettings{}.plunge_feed, 1e-12)
        << "a ramp is no plunge";
}

TEST(ProgramFromLine, RefusesLinesThatCannotBeBegun) {
    const Job job = pocketing_job();
    const auto refusal = [&](int line, std::optional<double> clearance = {}) {
        try {
            RunFromSettings settings;
            settings.clearance = clearance;
            (void)job_from_line(job, line, settings);
        } catch (const Error& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_THAT(refusal(0), HasSubstr("the program has"));
    EXPECT_THAT(refusal(10'000), HasSubstr("the program has"));
    EXPECT_THAT(refusal(2), HasSubstr("line 2 is one of the first 7 lines"));
    EXPECT_THAT(refusal(7), HasSubstr("line 7 is one of the first 7 lines"));
    EXPECT_EQ(refusal(8), "");
    EXPECT_THAT(refusal(30, -50.0), HasSubstr("is below"));
    EXPECT_EQ(refusal(30, 55.0), "");
}

} // namespace
} // namespace millwright::jobs
