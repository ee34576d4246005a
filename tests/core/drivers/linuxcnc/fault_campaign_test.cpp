// Many runs of random programs on an emulated LinuxCNC over a link that fails, in time that passes as fast as
// it is computed. TCP neither changes nor loses single bytes, so what fails is the link as a whole, LinuxCNC,
// its machine, or the program. What must hold in each run:
//   nothing that could begin motion is sent after the run has ended, and the machine stands still, unless
//     LinuxCNC goes on over a lost link, which is said;
//   no more is claimed as executed, at any moment in the log, than was truly executed by then;
//   done is said only of a program that LinuxCNC ran to its end, once.
#include "tests/core/drivers/fault_campaign.h"

#include "core/base/error.h"
#include "core/jobs/dispatcher.h"
#include "tests/core/drivers/linuxcnc/linuxcnc_wire.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>

namespace millwright::drivers::linuxcnc {
namespace {

using test::LinuxCncWire;
using test::pick;
using test::Random;

enum class LinuxCncFault {
    none,
    delay,
    disconnect,
    stall_to_host,
    stall_to_linuxcnc,
    reset,
    alarm,
    bad_line,
    aborted
};
constexpr int linuxcnc_fault_count = 9;

/// Each line with G0, G1 or G3 goes somewhere else in X.
std::string random_linuxcnc_program(Random& random, LinuxCncFault kind) {
    constexpr int places = 20;
    std::string text = "(run)\nG21 G90 G94 F6000\n";
    const int lines = 8 + pick(random, 15);
    const int bad = kind == LinuxCncFault::bad_line ? pick(random, lines) : -1;
    int x = 0;
    for (int n = 0; n < lines; ++n) {
        const int other = (x + 1 + pick(random, places - 1)) % places;
        const int y = pick(random, places);
        switch (n == bad ? -1 : pick(random, 9)) {
        case -1:
            text += pick(random, 2) == 0 ? "G1 X9000\n" : "G1 Q9\n";
            break;
        case 0:
            text += fmt::format("G0 X{} Z{}\n", x = other, y);
            break;
        case 1:
            text += "G91\nG3 X2 Y0 I1 J0\nG90\n";
            x += 2;
            break;
        case 2:
            text += fmt::format("G4 P0.{}\n", y);
            break;
        default:
            text += fmt::format("G1 X{} Y{}\n", x = other, y);
            break;
        }
    }
    return text + "M2\n";
}

links::FaultSpec faults_of(LinuxCncFault kind, Random& random, std::uint64_t seed) {
    links::FaultSpec spec;
    spec.seed = seed;
    spec.toward_host = kind != LinuxCncFault::stall_to_linuxcnc;
    spec.toward_controller = kind != LinuxCncFault::stall_to_host;
    const std::int64_t moment = 50 + pick(random, 30'000);
    if (kind == LinuxCncFault::delay) {
        spec.delay = 0.001 * (1 + pick(random, 400));
    } else if (kind == LinuxCncFault::disconnect) {
        spec.disconnect = moment;
    } else if (kind == LinuxCncFault::stall_to_host || kind == LinuxCncFault::stall_to_linuxcnc) {
        spec.stall = moment / 2;
    } else if (kind == LinuxCncFault::reset) {
        spec.reset = moment;
    } else if (kind == LinuxCncFault::alarm) {
        spec.alarm = moment;
    }
    return spec;
}

class LinuxCncCampaignRun {
public:
    LinuxCncCampaignRun(std::uint64_t seed, const std::filesystem::path& logs)
        : random_(seed), kind_(static_cast<LinuxCncFault>(seed % linuxcnc_fault_count)), logs_(logs),
          job_(jobs::text_job(random_linuxcnc_program(random_, kind_), "campaign.ngc")),
          wire_(faults_of(kind_, random_, seed)), abort_at_(10 + pick(random_, 200)) {
        job_.name = fmt::format("run-{}", seed);
    }

    /// What is wrong; empty: nothing.
    std::string run() {
        constexpr double longest = 600.0; // s
        test::WireClock clock(wire_, wire_.now + longest);
        test::LinuxCncWireDriver driver(wire_);
        jobs::Dispatcher dispatcher(driver, clock, logs_);
        const double begin = wire_.linuxcnc.time();
        try {
            outcome_ = dispatcher.run(
                job_, {}, [&](const jobs::JobReport& report) { act(dispatcher, driver, report.driver); });
        } catch (const Defect& endless) {
            wrong(endless.what());
            return wrong_;
        }
        const bool lost = wire_.session.link_lost();
        if (lost && wire_.session.status().message.find("inspect the machine") == std::string::npos) {
            wrong("no warning that LinuxCNC may go on");
        }
        check_log(begin);
        std::filesystem::remove(outcome_.log_file);
        check_end();
        check_quiet();
        return wrong_;
    }
    [[nodiscard]] bool done() const { return outcome_.end == jobs::JobEnd::done; }

private:
    Random random_;
    LinuxCncFault kind_;
    std::filesystem::path logs_;
    jobs::Job job_;
    LinuxCncWire wire_;
    int abort_at_; ///< looks
    int looks_ = 0;
    jobs::JobOutcome outcome_;
    std::string wrong_;

    void wrong(const std::string& what) {
        if (wrong_.empty()) {
            wrong_ = fmt::format(
                "kind {}: {} ({})", static_cast<int>(kind_), what, wire_.session.status().message);
        }
    }

    /// A person, and somebody at the machine. Asked 50 times per second.
    void act(jobs::Dispatcher& dispatcher, Driver& driver, const DriverStatus& now) {
        if (kind_ == LinuxCncFault::aborted && ++looks_ == abort_at_) {
            wire_.linuxcnc.abort_at_the_machine();
        }
        if (now.state == DriverState::holding && pick(random_, 40) == 0) {
            dispatcher.resume();
        }
        switch (now.state == DriverState::running ? pick(random_, 1500) : -1) {
        case 0:
        case 1:
        case 2:
            dispatcher.hold();
            break;
        case 3:
            dispatcher.stop();
            break;
        case 4:
            driver.emergency_stop();
            break;
        case 5:
            dispatcher.set_overrides({.feed = 50 + pick(random_, 100), .rapid = 100, .spindle = 100});
            break;
        default:
            break;
        }
    }

    /// The line of block `count`: if so many blocks were executed, those above it were.
    [[nodiscard]] int line_of(int count) const {
        const auto& lines = job_.listing->line_of_block;
        return count < std::ssize(lines) ? lines[static_cast<std::size_t>(count)]
                                         : job_.listing->line_count() + 1;
    }

    /// Whether every line with motion above `line` had been executed at `time`, once and in order.
    [[nodiscard]] bool executed_above(int line, double time) const {
        std::vector<int> wanted;
        for (const int moving : moving_lines()) {
            if (moving < line) {
                wanted.push_back(moving);
            }
        }
        std::vector<int> truly;
        for (const emulators::LinuxCncTruthLine& one : wire_.linuxcnc.truth().lines) {
            if (one.executed <= time + 1e-6 && one.line < line) {
                truly.push_back(one.line);
            }
        }
        return truly == wanted;
    }

    [[nodiscard]] std::vector<int> moving_lines() const {
        std::vector<int> lines;
        for (int line = 1; line <= job_.listing->line_count(); ++line) {
            const std::string_view text = job_.listing->line(line);
            if (text.starts_with("G0 ") || text.starts_with("G1 ") || text.starts_with("G3 ")) {
                lines.push_back(line);
            }
        }
        return lines;
    }

    void check_log(double begin) {
        const jobs::ReadLog log = jobs::read_job_log(outcome_.log_file);
        int before = 0;
        for (const jobs::LogRecord& record : log.records) {
            if (!executed_above(line_of(record.executed_blocks), begin + record.time)) {
                wrong(fmt::format("at {} s the log claims {} blocks", record.time, record.executed_blocks));
            }
            if (record.executed_blocks < before) {
                wrong("the log takes something back");
            }
            before = record.executed_blocks;
        }
        if (log.end() != outcome_.end || log.executed_blocks() != outcome_.executed_blocks) {
            wrong("the log does not end as the job did");
        }
    }

    void check_end() {
        const emulators::LinuxCncTruth& truth = wire_.linuxcnc.truth();
        if (truth.runs > 1) {
            wrong("the program was run twice");
        }
        if (outcome_.end == jobs::JobEnd::done && truth.ended_runs != 1) {
            wrong("done, and LinuxCNC did not come to the end");
        }
    }

    /// Half a minute later.
    void check_quiet() {
        const bool goes_on = wire_.session.link_lost() || kind_ == LinuxCncFault::stall_to_host ||
                             kind_ == LinuxCncFault::stall_to_linuxcnc;
        const double end = wire_.linuxcnc.time();
        wire_.sent.clear();
        wire_.run_until([] { return false; }, 30.0);
        if (wire_.sent.find("set ") != std::string::npos) {
            wrong("something was sent after the end: " + wire_.sent);
        }
        constexpr double slack = 0.5; // s, in which what was sent before arrives
        if (!goes_on && wire_.linuxcnc.truth().last_motion > end + slack) {
            wrong("the machine moved after the end");
        }
    }
};

void run_linuxcnc_campaign(int runs) {
    std::array<int, linuxcnc_fault_count> done{};
    std::array<int, linuxcnc_fault_count> all{};
    const test::ScratchFolder logs;
    for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(runs); ++seed) {
        LinuxCncCampaignRun run(seed, logs.path());
        EXPECT_EQ(run.run(), "") << "seed " << seed;
        done[seed % linuxcnc_fault_count] += run.done() ? 1 : 0;
        ++all[seed % linuxcnc_fault_count];
    }
    for (std::size_t kind = 0; kind < linuxcnc_fault_count; ++kind) {
        fmt::print("kind {}: {:3} of {:3} ended well\n", kind, done[kind], all[kind]);
    }
    EXPECT_GT(done[static_cast<std::size_t>(LinuxCncFault::none)], 0);
    EXPECT_LT(done[static_cast<std::size_t>(LinuxCncFault::alarm)],
              all[static_cast<std::size_t>(LinuxCncFault::alarm)]);
    EXPECT_EQ(done[static_cast<std::size_t>(LinuxCncFault::bad_line)], 0);
}

TEST(LinuxCncFaultCampaign, NeverMovesAfterAFaultNorLiesAboutALine) {
    run_linuxcnc_campaign(270);
}

TEST(LinuxCncFaultCampaignInFull, NeverMovesAfterAFaultNorLiesAboutALineInThreeThousandRuns) {
    run_linuxcnc_campaign(3000);
}

} // namespace
} // namespace millwright::drivers::linuxcnc
