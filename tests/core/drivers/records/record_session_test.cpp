// The driver's side of records and an emulated table with a wire between them, in computed time.
#include "core/drivers/records/internal/record_session.h"

#include "core/emulators/table/table_emulator.h"
#include "core/jobs/file_job.h"
#include "tests/core/drivers/session_wire.h"
#include "tests/core/jobs/answered_records.h"
#include "tests/support/machines.h"
#include "tests/support/scratch_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <random>

namespace millwright::drivers::records {
namespace {

using kinematics::AxisPositions;
using kinematics::MachineModel;
using test::answered_records;
using testing::HasSubstr;

const std::shared_ptr<const MachineModel>& table_model() {
    static const auto model = std::make_shared<const MachineModel>(test::machine("forming-table"));
    return model;
}

jobs::Job job_of(const std::string& text) {
    const test::ScratchFolder folder;
    const auto file = folder / "part.ngc";
    std::ofstream(file) << text;
    return jobs::file_job(file, table_model(), {.start = AxisPositions::Zero(3)});
}

/// A way around with `count` corners that no two neighbours share.
std::string zigzag_without_equal_neighbours(int count) {
    std::string text = "G21 G90\nG0 X5 Y5\nG1 F600\n";
    for (int n = 1; n < count; ++n) {
        text += "X" + std::to_string(5 + n) + " Y" + std::to_string(5 + n % 2) + "\n";
    }
    return text + "M2\n";
}

class Wire : public test::SessionWire<RecordSession, emulators::TableEmulator> {
public:
    explicit Wire(emulators::TableEmulator& table,
                  const RecordFormat& format,
                  AxisPositions at = AxisPositions::Zero(3),
                  const links::FaultSpec& faults = {},
                  bool known = true)
        : SessionWire(
              table, RecordSession(table_model(), std::move(at), {.format = format, .known = known}), 0.01) {
        greet();
        begin_faults(faults);
    }
    void start(const jobs::Job& job) { session.start({job.program, nullptr, job.listing, {}}, now); }
};

emulators::TableEmulator table_of(const RecordFormat& format, emulators::TableOptions options = {}) {
    options.keep = true;
    return {format, *table_model(), options};
}

std::vector<AxisPositions> moves_of(const jobs::Job& job, int from = 0) {
    std::vector<AxisPositions> targets;
    AxisPositions at = job.program->start;
    for (int n = 0; n < job.program->block_count(); ++n) {
        const auto& block = job.program->blocks[static_cast<std::size_t>(n)];
        if (n >= from && block.moves() && (block.target - at).norm() > 1e-6) {
            targets.push_back(block.target);
        }
        at = block.target;
    }
    return targets;
}

void expect_same_way(const emulators::TableEmulator& table, const std::vector<AxisPositions>& targets) {
    ASSERT_EQ(table.positions().size(), targets.size());
    for (std::size_t n = 0; n < targets.size(); ++n) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            EXPECT_NEAR(table.positions()[n][axis], targets[n][static_cast<Eigen::Index>(axis)], 1e-4) << n;
        }
    }
}

TEST(RecordSession, GivesEachMoveOnceAndInOrder) {
    const jobs::Job job = job_of(zigzag_without_equal_neighbours(20));
    for (const bool relative : {false, true}) {
        for (const bool takes_time : {false, true}) {
            emulators::TableEmulator table = table_of(answered_records(relative), {.takes_time = takes_time});
            Wire wire(table, answered_records(relative));
            wire.start(job);
            ASSERT_TRUE(wire.run_to_end());
            EXPECT_EQ(wire.state(), DriverState::idle);
            EXPECT_EQ(wire.session.status().executed_blocks, job.block_count());
            expect_same_way(table, moves_of(job));
        }
    }
}

// X and Y were not named yet: the tool goes straight up from its position.
TEST(RecordSession, LeavesAxesWhereTheyAreThatNobodyHasNamed) {
    const AxisPositions at = AxisPositions{{300.0, 300.0, -1.0}};
    const test::ScratchFolder folder;
    for (const char* text :
         {"G21 G90\nG0 Z5\nG0 X37 Y74\nM2\n",
          "# millwright path 1: absolute; x mm, y mm, z mm, speed mm/s (0: rapid), move, tool\n"
          "37,74,5,0,rapid,1\n37,74,-1,2,plunge,1\n"}) {
        const auto file = folder / "part";
        std::ofstream(file) << text;
        const jobs::Job job = jobs::file_job(file, table_model(), {.start = at});
        emulators::TableEmulator table = table_of(answered_records());
        Wire wire(table, answered_records(), at);
        wire.start(job);
        ASSERT_TRUE(wire.run_to_end());
        ASSERT_GE(table.positions().size(), 2U);
        EXPECT_NEAR(table.positions()[0][0], 300.0, 1e-9) << text;
        EXPECT_NEAR(table.positions()[0][1], 300.0, 1e-9) << text;
        EXPECT_NEAR(table.positions()[0][2], 5.0, 1e-9) << text;
        EXPECT_NEAR(table.positions()[1][0], 37.0, 1e-9) << text;
        EXPECT_NEAR(table.positions()[1][2], 5.0, 1e-9) << text;
    }
}

// 3 mm in x at 2 mm/s: the words of the thesis. A rapid goes as fast as the axes: 10 mm/s, 200 mm/s^2.
TEST(RecordSession, SaysWhereHowFastAndWithWhichAcceleration) {
    emulators::TableEmulator table = table_of(answered_records(true));
    Wire wire(table, answered_records(true));
    wire.start(job_of("G21 G91\nG0 Y4\nG1 X3 F120\nG1 X3 Y-4 F6000\nM2\n"));
    ASSERT_TRUE(wire.run_to_end());
    EXPECT_EQ(wire.sent,
              "t 0.0000 4.0000 0.0000 200.0000 10.0000\n"
              "t 3.0000 0.0000 0.0000 200.0000 2.0000\n"
              "t 3.0000 -4.0000 0.0000 250.0000 12.5000\n"); // Y at its limits, 10 and 200
}

TEST(RecordSession, WaitsWhereNothingIsAnswered) {
    const RecordFormat silent;
    emulators::TableEmulator table = table_of(silent);
    Wire wire(table, silent);
    const double begin = wire.now;
    wire.start(job_of("G21 G90\nG1 X20 F600\nM2\n"));
    ASSERT_TRUE(wire.run_to_end());
    // 20 mm at 10 mm/s, and up to it and down again with 200 mm/s^2.
    EXPECT_NEAR(wire.now - begin, 2.05, 0.03);
    EXPECT_EQ(wire.state(), DriverState::idle);
}

TEST(RecordSession, IsHeldWithinOneRecordAndGoesOn) {
    const jobs::Job job = job_of(zigzag_without_equal_neighbours(20));
    emulators::TableEmulator table = table_of(answered_records(true), {.takes_time = true});
    Wire wire(table, answered_records(true));
    wire.start(job);
    ASSERT_TRUE(wire.run_until([&] { return table.records() == 4; }, 60.0));
    const auto records = wire.session.records();
    wire.session.hold(wire.now);
    EXPECT_FALSE(wire.run_until([&] { return wire.session.records() > records; }, 60.0));
    EXPECT_EQ(wire.state(), DriverState::holding);
    EXPECT_EQ(table.records(), records);
    wire.session.resume(wire.now);
    ASSERT_TRUE(wire.run_to_end());
    expect_same_way(table, moves_of(job));
}

TEST(RecordSession, IsStoppedWithinOneRecord) {
    emulators::TableEmulator table = table_of(answered_records(), {.takes_time = true});
    Wire wire(table, answered_records());
    wire.start(job_of(zigzag_without_equal_neighbours(20)));
    ASSERT_TRUE(wire.run_until([&] { return table.records() == 4; }, 60.0));
    const auto records = wire.session.records();
    wire.session.stop(wire.now);
    ASSERT_TRUE(wire.run_to_end());
    EXPECT_EQ(wire.state(), DriverState::stopped);
    EXPECT_EQ(table.records(), records);
    EXPECT_EQ(wire.session.status().position[table_model()->axis_index('X')],
              table.position()[static_cast<std::size_t>(table_model()->axis_index('X'))]);
}

TEST(RecordSession, SendsNothingAfterAnEmergencyStop) {
    emulators::TableEmulator table = table_of(answered_records(), {.takes_time = true});
    Wire wire(table, answered_records());
    wire.start(job_of(zigzag_without_equal_neighbours(20)));
    ASSERT_TRUE(wire.run_until([&] { return table.records() == 4; }, 60.0));
    wire.session.emergency_stop(wire.now);
    wire.sent.clear();
    EXPECT_FALSE(wire.run_until([&] { return !wire.sent.empty(); }, 60.0));
    EXPECT_EQ(wire.state(), DriverState::alarm);
    EXPECT_THROW(wire.start(job_of(zigzag_without_equal_neighbours(3))), Error);
}

TEST(RecordSession, TakesARefusalForAnAlarmAndGoesOnFromThere) {
    const jobs::Job job = job_of(zigzag_without_equal_neighbours(20));
    emulators::TableEmulator table = table_of(answered_records(true), {.refuses = 7});
    Wire wire(table, answered_records(true));
    wire.start(job);
    ASSERT_TRUE(wire.run_to_end());
    EXPECT_EQ(wire.state(), DriverState::alarm);
    EXPECT_THAT(wire.session.status().message, HasSubstr("the machine answered 'error' to record 7"));
    EXPECT_EQ(table.records(), 6);
}

// The second one was taken for the answer to the next record, so that all that followed was claimed a record
// too early, up to the end of the program.
TEST(RecordSession, AnAnswerThatComesTwiceIsNoticedBeforeTheNextRecord) {
    for (const bool takes_time : {false, true}) {
        emulators::TableEmulator table =
            table_of(answered_records(), {.doubles = 4, .takes_time = takes_time});
        Wire wire(table, answered_records());
        wire.start(job_of(zigzag_without_equal_neighbours(20)));
        ASSERT_TRUE(wire.run_to_end());
        EXPECT_EQ(wire.state(), DriverState::alarm);
        EXPECT_THAT(wire.session.status().message, HasSubstr("sent 'ok' before record 5 was sent"));
        EXPECT_EQ(wire.session.records(), 4);
        EXPECT_EQ(table.records(), 4);
        EXPECT_THAT(wire.session.status().position_doubt, HasSubstr("more often than it receives records"));
        wire.session.reset(wire.now);
        EXPECT_THROW(wire.start(job_of(zigzag_without_equal_neighbours(20))), Error);
    }
}

TEST(RecordSession, TheLastAnswerOfAProgramComesOnceToo) {
    emulators::TableEmulator table = table_of(answered_records(), {.doubles = 3});
    Wire wire(table, answered_records());
    wire.start(job_of("G21 G90\nG0 X5 Y5\nG1 X6 F600\nX7\nM2\n"));
    ASSERT_TRUE(wire.run_to_end());
    EXPECT_EQ(wire.state(), DriverState::alarm);
}

// Each of 1 s. The table answers when it is there, so what comes after 0.1 s is no answer to this record.
TEST(RecordSession, ASecondAnswerThatComesLateIsNoAnswerToTheNextRecord) {
    emulators::TableEmulator table = table_of(answered_records(), {.takes_time = true});
    Wire wire(table, answered_records());
    std::string text = "G21 G90\nG1 X10 F600\n";
    for (int n = 2; n < 10; ++n) {
        text += "X" + std::to_string(10 * n) + "\n";
    }
    wire.start(job_of(text + "M2\n"));
    ASSERT_TRUE(wire.run_until([&] { return wire.session.records() == 5; }, 60.0));
    ASSERT_FALSE(wire.run_until([&] { return wire.session.records() > 5; }, 0.1));
    wire.session.receive("ok\n", wire.now);
    EXPECT_EQ(wire.state(), DriverState::alarm);
    EXPECT_THAT(wire.session.status().message, HasSubstr("record 5 after 0.1"));
    EXPECT_THAT(wire.session.status().message, HasSubstr("although its move takes 1.00 s"));
    EXPECT_EQ(wire.session.status().executed_blocks, 4);
}

TEST(AnswerPace, TimeTellsNothingOfATableThatAnswersWhatItHasTaken) {
    AnswerPace buffered; // the first at once, then as places come free
    for (const double after : {0.01, 0.01, 1.0, 1.0, 1.0, 1.0, 0.01}) {
        EXPECT_TRUE(buffered.fits(1.0, after));
    }
    AnswerPace when_there;
    for (const double after : {1.1, 0.5, 1.05}) { // by hand at twice the speed
        EXPECT_TRUE(when_there.fits(1.0, after));
    }
    EXPECT_TRUE(when_there.fits(0.1, 0.01)); // too short to tell
    EXPECT_FALSE(when_there.fits(1.0, 0.1));
}

// The spindle is a person's, and the table was sent nothing of it.
TEST(RecordSession, NothingIsExecutedBeforeTheTableHasObeyedSomething) {
    emulators::TableEmulator table = table_of(answered_records(), {.refuses = 1});
    Wire wire(table, answered_records());
    const jobs::Job job = job_of("G21 G90\nM3 S10000\nG0 X5 Y5\nG1 X6 F600\nM5\nM2\n");
    wire.start(job);
    ASSERT_TRUE(wire.run_to_end());
    EXPECT_EQ(wire.state(), DriverState::alarm);
    EXPECT_EQ(wire.session.status().executed_blocks, 0);
    emulators::TableEmulator obeys = table_of(answered_records());
    Wire second(obeys, answered_records());
    second.start(job);
    ASSERT_TRUE(second.run_to_end());
    EXPECT_EQ(second.session.status().executed_blocks, job.block_count());
}

TEST(RecordSession, DoesNotGuessWhereARelativeTableStands) {
    emulators::TableEmulator table = table_of(answered_records(true), {.silent_from = 3});
    Wire wire(table, answered_records(true));
    wire.start(job_of(zigzag_without_equal_neighbours(20)));
    ASSERT_TRUE(wire.run_to_end());
    EXPECT_THAT(wire.session.status().message, HasSubstr("no answer to record 3 within 5 s"));
    wire.session.reset(wire.now);
    EXPECT_THROW(wire.start(job_of(zigzag_without_equal_neighbours(20))), Error);
    wire.session.stands_at(AxisPositions{Vec3(1.0, 2.0, 3.0)});
    EXPECT_TRUE(wire.session.status().position_doubt.empty());
    EXPECT_EQ(wire.session.status().position, AxisPositions(Vec3(1.0, 2.0, 3.0)));
}

// The table is sent nothing more, but goes where the last record says: from what is shown the next way could
// lead through the work.
TEST(RecordSession, BeginsNothingAfterARecordThatWasOnItsWayBeforeAPersonHasLooked) {
    const jobs::Job job = job_of(zigzag_without_equal_neighbours(20));
    emulators::TableEmulator table = table_of(answered_records(), {.takes_time = true});
    Wire wire(table, answered_records());
    wire.start(job);
    ASSERT_TRUE(wire.run_until([&] { return wire.session.records() == 5; }, 60.0));
    const AxisPositions shown = wire.session.status().position;
    wire.session.emergency_stop(wire.now);
    EXPECT_THROW(wire.session.stands_at(shown), Error);
    EXPECT_FALSE(wire.run_until([] { return false; }, 60.0));
    const std::vector<double> stands = table.positions().back();
    EXPECT_GT((AxisPositions(Vec3(stands[0], stands[1], stands[2])) - shown).norm(), 1.0);
    EXPECT_THAT(wire.session.status().position_doubt, HasSubstr("record 5 had been sent"));
    wire.session.reset(wire.now);
    EXPECT_EQ(wire.state(), DriverState::idle);
    EXPECT_THROW(wire.start(job), Error);
    EXPECT_EQ(wire.session.records(), 5);

    const AxisPositions seen = Vec3(stands[0], stands[1], stands[2]);
    wire.session.stands_at(seen);
    auto rest = std::make_shared<program::Program>(*job.program);
    rest->start = seen;
    wire.session.start({rest, nullptr, job.listing, {}}, wire.now);
    ASSERT_TRUE(wire.run_to_end(3600.0));
    EXPECT_EQ(wire.state(), DriverState::idle);
}

// The late answer is none to a record that is sent later, and no fault.
TEST(RecordSession, UnlockedWhileARecordIsOnItsWayItWaitsForItsEnd) {
    emulators::TableEmulator table = table_of(answered_records(), {.takes_time = true});
    Wire wire(table, answered_records());
    wire.start(job_of(zigzag_without_equal_neighbours(20)));
    ASSERT_TRUE(wire.run_until([&] { return wire.session.records() == 2; }, 60.0));
    wire.session.emergency_stop(wire.now);
    wire.session.reset(wire.now);
    EXPECT_EQ(wire.state(), DriverState::stopping);
    EXPECT_THROW(wire.session.stands_at(AxisPositions::Zero(3)), Error);
    ASSERT_TRUE(wire.run_until([&] { return wire.state() != DriverState::stopping; }, 60.0));
    EXPECT_EQ(wire.state(), DriverState::idle);
    EXPECT_EQ(table.records(), 2);
    EXPECT_FALSE(wire.run_until([&] { return wire.state() != DriverState::idle; }, 60.0));
    EXPECT_THROW(wire.start(job_of(zigzag_without_equal_neighbours(20))), Error);
    wire.session.stands_at(AxisPositions{Vec3(5.0, 5.0, 0.0)});
}

TEST(RecordSession, ARecordThatIsNeverAnsweredIsOverAfterThePatience) {
    RecordFormat format = answered_records();
    emulators::TableEmulator table = table_of(format, {.silent_from = 1});
    Wire wire(table, format);
    wire.start(job_of(zigzag_without_equal_neighbours(20)));
    ASSERT_TRUE(wire.run_until([&] { return wire.session.records() == 1; }, 60.0));
    wire.session.emergency_stop(wire.now);
    wire.session.reset(wire.now);
    EXPECT_EQ(wire.state(), DriverState::stopping);
    const double from = wire.now;
    ASSERT_TRUE(wire.run_until([&] { return wire.state() == DriverState::idle; }, 60.0));
    EXPECT_GT(wire.now - from, format.patience);
}

TEST(RecordSession, AStopBetweenTwoRecordsLeavesNoDoubt) {
    emulators::TableEmulator table = table_of(answered_records());
    Wire wire(table, answered_records());
    wire.start(job_of("G21 G90\nG1 X20 F600\nM0\nG1 X10\nM2\n"));
    ASSERT_TRUE(wire.run_until([&] { return wire.state() == DriverState::holding; }, 60.0));
    wire.session.emergency_stop(wire.now);
    EXPECT_TRUE(wire.session.status().position_doubt.empty());
    EXPECT_EQ(wire.session.status().position[0], 20.0);
}

TEST(RecordSession, WhereItStandsIsAssumedUntilItWentSomewhereOrAPersonSaysIt) {
    for (const bool told : {false, true}) {
        emulators::TableEmulator table = table_of(answered_records());
        Wire wire(table, answered_records(), AxisPositions::Zero(3), {}, false);
        EXPECT_FALSE(wire.session.status().position_known);
        if (told) {
            wire.session.stands_at(AxisPositions{Vec3(5.0, 56.0, -1.0)});
        } else {
            wire.start(job_of("G21 G90\nG1 X20 F600\nM2\n"));
            EXPECT_THROW(wire.session.stands_at(AxisPositions{Vec3(5.0, 56.0, -1.0)}), Error);
            ASSERT_TRUE(wire.run_to_end());
        }
        EXPECT_TRUE(wire.session.status().position_known);
    }
}

TEST(RecordSession, WaitsForAPersonWhereTheProgramDoes) {
    emulators::TableEmulator table = table_of(answered_records());
    Wire wire(table, answered_records());
    wire.start(job_of("G21 G90\nG1 X20 F600\nM0\nG1 X10\nM2\n"));
    ASSERT_TRUE(wire.run_until([&] { return wire.state() == DriverState::holding; }, 60.0));
    EXPECT_FALSE(wire.run_until([&] { return table.records() > 1; }, 60.0));
    wire.session.resume(wire.now);
    ASSERT_TRUE(wire.run_to_end());
    EXPECT_EQ(table.records(), 2);
}

TEST(RecordSession, WaitsAtM1OnlyWhileItsSwitchIsOn) {
    for (const bool on : {false, true}) {
        emulators::TableEmulator table = table_of(answered_records());
        Wire wire(table, answered_records());
        wire.session.set_optional_stop(on);
        wire.start(job_of("G21 G90\nG1 X20 F600\nM1\nG1 X10\nM2\n"));
        EXPECT_EQ(wire.run_until([&] { return wire.state() == DriverState::holding; }, 60.0), on);
        if (on) {
            EXPECT_EQ(wire.session.status().message, "optional stop at line 3: M1");
            wire.session.resume(wire.now);
        }
        ASSERT_TRUE(wire.run_to_end());
        EXPECT_EQ(table.records(), 2);
    }
}

TEST(RecordSession, GivesNoBlockThatIsNotAllowed) {
    const jobs::Job job = job_of(zigzag_without_equal_neighbours(20));
    emulators::TableEmulator table = table_of(answered_records());
    Wire wire(table, answered_records());
    int allowed = 5;
    wire.session.start(
        {job.program, nullptr, job.listing, [&](int wanted) { return std::min(wanted, allowed); }}, wire.now);
    EXPECT_FALSE(wire.run_until([&] { return wire.session.status().sent_blocks > 5; }, 60.0));
    allowed = job.block_count();
    ASSERT_TRUE(wire.run_to_end());
    expect_same_way(table, moves_of(job));
}

/// Without what the first and the last of `positions` share with their neighbours.
std::vector<std::vector<double>> without_repeats(std::vector<std::vector<double>> positions) {
    positions.erase(std::unique(positions.begin(), positions.end()), positions.end());
    return positions;
}

// Wires that stall or break, tables that lose their answers, are switched off or stop: each time a person
// looks, and the rest of the program is given. What is claimed was obeyed, and in the end each position was
// gone to, in order. A position whose answer was lost is gone to again, from itself.
TEST(RecordSession, LosesAndDoublesNothingInThousandFaults) {
    std::mt19937 random(4);
    const jobs::Job job = job_of(zigzag_without_equal_neighbours(30));
    const auto targets = moves_of(job);
    const auto any = [&](int least, int most) {
        return std::uniform_int_distribution<std::int64_t>(least, most)(random);
    };
    int faults = 0;
    for (int run = 0; run < 1000; ++run) {
        emulators::TableEmulator table = table_of(answered_records(), {.takes_time = run % 2 == 0});
        int done = 0;
        AxisPositions at = AxisPositions::Zero(3);
        for (int attempt = 0; done < job.block_count(); ++attempt) {
            ASSERT_LT(attempt, 200);
            links::FaultSpec faults_now;
            faults_now.seed = random();
            switch (any(0, 4)) {
            case 0:
                faults_now.stall = any(0, 400);
                break;
            case 1:
                faults_now.disconnect = any(0, 400);
                break;
            case 2:
                faults_now.alarm = any(0, 400);
                break;
            case 3:
                faults_now.reset = any(0, 400);
                break;
            default:
                faults_now.drop = 0.02;
                faults_now.toward_controller = false;
            }
            Wire wire(table, answered_records(), at, faults_now);
            auto rest = std::make_shared<program::Program>(*job.program);
            rest->start = at;
            rest->blocks.erase(rest->blocks.begin(), rest->blocks.begin() + done);
            const auto before = table.records();
            wire.session.start({rest, nullptr, job.listing, {}}, wire.now);
            ASSERT_TRUE(wire.run_to_end(3600.0));
            const DriverStatus status = wire.session.status();
            EXPECT_GE(table.records() - before, wire.session.records() - 1);
            faults += status.state == DriverState::alarm ? 1 : 0;
            done += status.executed_blocks;
            at = status.position;
            table.power_cycle();
        }
        const auto positions = without_repeats(table.positions());
        ASSERT_EQ(positions.size(), targets.size()) << run;
        for (std::size_t n = 0; n < targets.size(); ++n) {
            for (std::size_t axis = 0; axis < 3; ++axis) {
                ASSERT_NEAR(positions[n][axis], targets[n][static_cast<Eigen::Index>(axis)], 1e-4) << run;
            }
        }
    }
    EXPECT_GT(faults, 1000);
}

TEST(RecordSession, RefusesWhatATableCannotDo) {
    const auto five_axes = std::make_shared<const MachineModel>(test::machine("rotary-tilt-gui"));
    EXPECT_THROW(RecordSession(five_axes, AxisPositions::Zero(five_axes->axis_count()), {}), Error);
    emulators::TableEmulator table = table_of(answered_records());
    Wire wire(table, answered_records());
    EXPECT_THROW(wire.session.start({}, wire.now), Error);
    EXPECT_THROW(wire.session.home(wire.now), Error);
    EXPECT_THROW(wire.session.jog({}, wire.now), Error);
}

TEST(RecordText, AnAxisThatNoRecordTellsMustNotMove) {
    const jobs::Job job = job_of("G21 G90\nG0 Z5\nG0 X5\nG1 Z-1 F60\nG1 X9\nM2\n");
    RecordFormat format;
    for (const char* pattern : {"t {X} {Y}", "t {X} {X} {s}"}) {
        format.pattern = pattern;
        const RecordText text(format, *table_model(), 4);
        try {
            text.expect_all_told(*job.program, *table_model());
            ADD_FAILURE() << pattern;
        } catch (const Error& error) {
            EXPECT_STREQ(error.what(),
                         "the program moves Z, which the record does not contain (add {Z} to the record)");
        }
    }
    format.pattern = "t {X} {Z}";
    EXPECT_NO_THROW(RecordText(format, *table_model(), 4).expect_all_told(*job.program, *table_model()));
}

} // namespace
} // namespace millwright::drivers::records
