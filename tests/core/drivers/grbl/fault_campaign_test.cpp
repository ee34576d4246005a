// Many runs of random programs over a wire that fails in every way, in time that passes as fast as it is
// computed. What must hold in each of them:
//   nothing that could begin motion is sent after the run has ended, and the machine stands still;
//   each line of the program is executed once, in order, or the run did not end well;
//   no more is claimed as executed than the emulated controller truly executed;
//   the job log tells the truth at each of its moments, and allowed each line before it was sent.
#include "tests/core/drivers/fault_campaign.h"

#include "core/base/error.h"
#include "core/drivers/grbl/internal/grbl_session.h"
#include "core/jobs/dispatcher.h"
#include "tests/core/drivers/grbl/grbl_wire.h"
#include "tests/core/drivers/grbl/wire_driver.h"
#include "tests/support/scratch_folder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>

namespace millwright::drivers::grbl {
namespace {

using test::GrblWire;
using test::pick;
using test::Random;

enum class GrblFault {
    none,
    drop_to_host,
    garble_to_host,
    duplicate_to_host,
    drop_to_grbl,
    garble_to_grbl,
    duplicate_to_grbl,
    lost_ok,
    delay,
    disconnect,
    stall_to_host,
    stall_to_grbl,
    reset,
    alarm
};
constexpr int grbl_fault_count = 14;

std::string random_grbl_program(Random& random) {
    std::string text = "(run)\nG21G90G94F3000\n";
    const int lines = 15 + pick(random, 25);
    for (int n = 0; n < lines; ++n) {
        const int x = pick(random, 9);
        const int y = pick(random, 9);
        switch (pick(random, 10)) {
        case 0:
            text += fmt::format("G0 X{} Z{}\n", x, y);
            break;
        case 1:
            text += "G91\nG3 X2 Y0 I1 J0\nG90\n";
            break;
        case 2:
            text += fmt::format("G4 P0.{}\n", y);
            break;
        case 3:
            text += fmt::format("M3 S{}00\n", 1 + x);
            break;
        default:
            text += fmt::format("G1 X{} Y{}.{}\n", x, y, n);
            break;
        }
    }
    return text + "M5\nM30\n";
}

links::FaultSpec faults_of(GrblFault kind, Random& random, std::uint64_t seed) {
    links::FaultSpec spec;
    spec.seed = seed;
    const double rate = 0.0002 * (1 + pick(random, 20));
    const std::int64_t moment = 20 + pick(random, 3000);
    spec.toward_host = kind != GrblFault::drop_to_grbl && kind != GrblFault::garble_to_grbl &&
                       kind != GrblFault::duplicate_to_grbl && kind != GrblFault::stall_to_grbl;
    spec.toward_controller = !spec.toward_host || kind == GrblFault::delay || kind == GrblFault::disconnect;
    switch (kind) {
    case GrblFault::drop_to_host:
    case GrblFault::drop_to_grbl:
        spec.drop = rate;
        break;
    case GrblFault::garble_to_host:
    case GrblFault::garble_to_grbl:
        spec.garble = rate;
        break;
    case GrblFault::duplicate_to_host:
    case GrblFault::duplicate_to_grbl:
        spec.duplicate = rate;
        break;
    case GrblFault::lost_ok:
        spec.lost_ok = 0.05;
        break;
    case GrblFault::delay:
        spec.delay = 0.001 * (1 + pick(random, 200));
        break;
    case GrblFault::disconnect:
        spec.disconnect = moment;
        break;
    case GrblFault::stall_to_host:
        spec.stall = moment;
        break;
    case GrblFault::stall_to_grbl:
        spec.stall = moment / 4;
        break;
    case GrblFault::reset:
        spec.reset = moment;
        break;
    case GrblFault::alarm:
        spec.alarm = moment;
        break;
    case GrblFault::none:
        break;
    }
    return spec;
}

/// A person who now and then holds, resumes, overrides, goes block by block, stops. Asked 50 times per
/// second.
class Person {
public:
    Person(jobs::Dispatcher& dispatcher, Driver& driver, Random& random)
        : dispatcher_(dispatcher), driver_(driver), random_(random) {}

    void act(const DriverStatus& now) {
        if (now.state != DriverState::running && now.state != DriverState::holding) {
            return;
        }
        if (now.state == DriverState::holding && pick(random_, 40) == 0) {
            dispatcher_.resume();
        }
        switch (pick(random_, 1500)) {
        case 0:
        case 1:
        case 2:
            dispatcher_.hold();
            break;
        case 3:
            dispatcher_.stop();
            break;
        case 4:
            driver_.emergency_stop();
            break;
        case 5:
        case 6:
            try {
                dispatcher_.set_overrides({.feed = 50 + pick(random_, 100), .rapid = 50, .spindle = 90});
            } catch (const Error&) {
                // the machine has come into an alarm since
            }
            break;
        case 7:
        case 8:
            dispatcher_.set_single_block(true);
            single_block_ = true;
            break;
        default:
            if (single_block_ && pick(random_, 100) == 0) {
                dispatcher_.set_single_block(false);
                single_block_ = false;
            }
            break;
        }
    }

private:
    jobs::Dispatcher& dispatcher_;
    Driver& driver_;
    Random& random_;
    bool single_block_ = false;
};

struct Verdict {
    std::string wrong; ///< empty: everything held
    DriverState end = DriverState::running;
};

class Run {
public:
    Run(std::uint64_t seed, const std::filesystem::path& logs, emulators::EmulatedFirmware firmware)
        : firmware_(firmware), seed_(seed), logs_(logs), random_(seed),
          kind_(static_cast<GrblFault>(seed % grbl_fault_count)), program_(random_grbl_program(random_)),
          lines_(program_lines(test::listing_of(program_), "campaign.ngc")),
          // half of the controllers tell what is in their buffers
          wire_(faults_of(kind_, random_, seed), options(), {}, pick(random_, 2) == 0 ? "$10=3\n" : "") {}

    Verdict run() {
        jobs::Job job = jobs::text_job(program_, "campaign.ngc");
        job.name = fmt::format("run-{}", seed_);
        constexpr double longest = 600.0; // s
        test::WireClock clock(wire_, wire_.now + longest);
        test::WireDriver driver(wire_);
        jobs::Dispatcher dispatcher(driver, clock, logs_);
        Person person(dispatcher, driver, random_);
        const double begin = wire_.grbl.time();
        try {
            const jobs::JobOutcome outcome = dispatcher.run(job, {}, [&](const jobs::JobReport& report) {
                person.act(report.driver);
                check_claim();
            });
            verdict_.end = wire_.state();
            check_log(outcome, begin);
            std::filesystem::remove(outcome.log_file);
        } catch (const Defect& endless) {
            wrong(endless.what());
        }
        check_lines();
        check_claim();
        check_quiet();
        return verdict_;
    }

private:
    emulators::EmulatedFirmware firmware_;
    std::uint64_t seed_;
    std::filesystem::path logs_;
    Random random_;
    GrblFault kind_;
    std::string program_;
    ProgramLines lines_;
    GrblWire wire_;
    Verdict verdict_;

    emulators::GrblEmulatorOptions options() {
        const bool changed = kind_ == GrblFault::drop_to_grbl || kind_ == GrblFault::garble_to_grbl ||
                             kind_ == GrblFault::duplicate_to_grbl;
        return {.firmware = firmware_,
                .line_numbers = pick(random_, 2) == 0,
                .echo = changed || pick(random_, 4) == 0};
    }

    void wrong(const std::string& what) {
        if (verdict_.wrong.empty()) {
            verdict_.wrong = fmt::format(
                "kind {}: {} ({})", static_cast<int>(kind_), what, wire_.session.status().message);
        }
    }

    [[nodiscard]] std::string text_of(std::size_t n, const std::string& truth) const {
        const bool numbered = truth.starts_with('N');
        return (numbered ? fmt::format("N{}", lines_.lines[n].block + 1) : "") + lines_.lines[n].text;
    }

    void check_lines() {
        const emulators::Truth truth = wire_.grbl.truth();
        std::size_t right = 0;
        while (right < std::min(truth.lines.size(), lines_.lines.size()) &&
               truth.lines[right].text == text_of(right, truth.lines[right].text)) {
            ++right;
        }
        const bool all_right = right == truth.lines.size();
        if (!all_right && verdict_.end == DriverState::idle) {
            wrong("a line that is not the program's was not noticed");
        }
        const bool may_be_changed = kind_ == GrblFault::drop_to_grbl || kind_ == GrblFault::garble_to_grbl ||
                                    kind_ == GrblFault::duplicate_to_grbl || kind_ == GrblFault::reset;
        if (!all_right && !may_be_changed) {
            wrong("a line was skipped, repeated or changed");
        }
        if (verdict_.end == DriverState::idle && right != lines_.lines.size()) {
            wrong("the end was reported too early");
        }
    }

    void check_claim() {
        const int claimed = wire_.session.status().executed_blocks;
        const emulators::Truth truth = wire_.grbl.truth();
        int executed = 0;
        while (executed < std::ssize(truth.lines) &&
               truth.lines[static_cast<std::size_t>(executed)].executed >= 0.0) {
            ++executed;
        }
        if (claimed > lines_.blocks_before(executed)) {
            wrong(fmt::format("{} blocks are claimed and {} lines were executed", claimed, executed));
        }
    }

    /// Lines that were executed, one after the other, until `time` of the controller, and lines that it had.
    struct Past {
        int executed = 0, accepted = 0;
    };
    [[nodiscard]] static Past until(const emulators::Truth& truth, double time) {
        Past past;
        while (past.executed < std::ssize(truth.lines)) {
            const double executed = truth.lines[static_cast<std::size_t>(past.executed)].executed;
            if (executed < 0.0 || executed > time) {
                break;
            }
            ++past.executed;
        }
        for (const emulators::TruthLine& line : truth.lines) {
            past.accepted += line.accepted <= time ? 1 : 0;
        }
        return past;
    }

    void check_log(const jobs::JobOutcome& outcome, double begin) {
        const jobs::ReadLog log = jobs::read_job_log(outcome.log_file);
        const emulators::Truth truth = wire_.grbl.truth();
        int before = 0;
        int allowed = 0;
        for (const jobs::LogRecord& record : log.records) {
            const Past past = until(truth, begin + record.time + 1e-6);
            if (record.executed_blocks > lines_.blocks_before(past.executed)) {
                wrong(fmt::format("at {} s the log claims {} blocks and {} lines were executed",
                                  record.time,
                                  record.executed_blocks,
                                  past.executed));
            }
            if (record.executed_blocks < before) {
                wrong("the log takes something back");
            }
            const bool too_many = kind_ != GrblFault::duplicate_to_grbl &&
                                  kind_ != GrblFault::garble_to_grbl && past.accepted > 0 &&
                                  lines_.blocks_before(past.accepted - 1) >= allowed &&
                                  record.event != jobs::LogEvent::ahead;
            if (too_many) {
                wrong("a line was sent before the log allowed it");
            }
            before = record.executed_blocks;
            allowed = std::max(allowed, record.allowed_blocks);
        }
        if (log.end() != outcome.end || log.executed_blocks() != outcome.executed_blocks) {
            wrong("the log does not end as the job did");
        }
        if (outcome.end == jobs::JobEnd::done &&
            until(truth, wire_.grbl.time()).executed != std::ssize(lines_.lines)) {
            wrong("done, and not every line was executed");
        }
    }

    /// Half a minute later.
    void check_quiet() {
        const double end = wire_.grbl.time();
        wire_.sent.clear();
        wire_.run_until([] { return false; }, 30.0);
        const bool deaf = kind_ == GrblFault::stall_to_grbl || kind_ == GrblFault::disconnect;
        const double slack = deaf ? 30.0 : 0.5;
        if (wire_.sent.find_first_not_of("?!\x18") != std::string::npos) {
            wrong("something was sent after the end: " + wire_.sent);
        }
        if (wire_.grbl.truth().last_motion > end + slack) {
            wrong("the machine moved after the end");
        }
    }
};

void run_campaign(std::uint64_t first,
                  int runs,
                  emulators::EmulatedFirmware firmware = emulators::EmulatedFirmware::grbl) {
    std::array<int, grbl_fault_count> done{};
    std::array<int, grbl_fault_count> faults{};
    const test::ScratchFolder logs;
    for (int n = 0; n < runs; ++n) {
        const std::uint64_t seed = first + static_cast<std::uint64_t>(n);
        const Verdict verdict = Run(seed, logs.path(), firmware).run();
        EXPECT_EQ(verdict.wrong, "") << "seed " << seed;
        ++(verdict.end == DriverState::idle ? done : faults)[seed % grbl_fault_count];
    }
    for (std::size_t kind = 0; kind < done.size(); ++kind) {
        fmt::print("kind {:2}: {:5} ended well, {:5} did not\n", kind, done[kind], faults[kind]);
    }
    EXPECT_GT(done[0], 0);
    EXPECT_GT(faults[static_cast<std::size_t>(GrblFault::garble_to_host)], 0);
}

TEST(GrblFaultCampaign, NeverMovesAfterAFaultNorLiesAboutALine) {
    run_campaign(1, 1000);
}

TEST(GrblFaultCampaign, HoldsForOtherFirmware) {
    run_campaign(1, 300, emulators::EmulatedFirmware::grblhal);
    run_campaign(1, 300, emulators::EmulatedFirmware::fluidnc);
}

TEST(GrblFaultCampaignInFull, NeverMovesAfterAFaultNorLiesAboutALineInTenThousandRuns) {
    run_campaign(1, 10'000);
}

} // namespace
} // namespace millwright::drivers::grbl
