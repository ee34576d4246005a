// Many seeded runs of an emulated PMAC with its arm over a wire that fails, in computed time. In each a
// program, jogs or a homing meet one kind of fault. What must hold:
//   once the run has ended, all motion has ended soon, and none begins again, also when what was broken is in
//     order again: not before a person gives power back;
//   a killed motor stays without power;
//   the arm never leaves its limits by more than it brakes;
//   done is said only of a program that came to its end, at its place.
#include "tests/core/drivers/fault_campaign.h"

#include "tests/core/pmac/driver/pmac_wire.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

namespace millwright::pmac::internal {
namespace {

using test::jog_of;
using test::pick;
using test::PmacWire;
using test::Random;

enum class PmacFault {
    none,
    drop,
    garble,
    duplicate,
    delay,
    disconnect,
    stall_to_host,
    stall_to_card,
    reset,
    amplifiers,
    no_power,
    encoder,
    emergency_stop
};
constexpr int pmac_fault_count = 13;

links::FaultSpec faults_of(PmacFault kind, Random& random, std::uint64_t seed) {
    links::FaultSpec spec;
    spec.seed = seed;
    spec.toward_host = kind != PmacFault::stall_to_card;
    spec.toward_controller = kind != PmacFault::stall_to_host;
    const std::int64_t moment = 50 + pick(random, 15'000);
    const double rate = std::pow(10.0, -2.0 - 0.001 * pick(random, 2000));
    switch (kind) {
    case PmacFault::drop:
        spec.drop = rate;
        break;
    case PmacFault::garble:
        spec.garble = rate;
        break;
    case PmacFault::duplicate:
        spec.duplicate = rate;
        break;
    case PmacFault::delay:
        spec.delay = 0.001 * (1 + pick(random, 60));
        break;
    case PmacFault::disconnect:
        spec.disconnect = moment;
        break;
    case PmacFault::stall_to_host:
    case PmacFault::stall_to_card:
        spec.stall = moment / 2;
        break;
    default:
        break;
    }
    return spec;
}

class PmacCampaignRun {
public:
    explicit PmacCampaignRun(std::uint64_t seed)
        : random_(seed), kind_(static_cast<PmacFault>(seed % pmac_fault_count)),
          wire_(faults_of(kind_, random_, seed)), fault_at_(0.1 + 0.001 * pick(random_, 2500)) {}

    /// What is wrong; empty: nothing.
    std::string run() {
        begin();
        const double start = wire_.now;
        bool broke = false;
        constexpr double longest = 12.0;
        while (wire_.now - start < longest && !at_rest()) {
            wire_.step();
            if (!broke && wire_.now - start >= fault_at_) {
                broke = true;
                breaks();
            }
            watch_limits();
        }
        if (!at_rest()) {
            if (broke && link_works()) {
                wrong("the fault was not noticed");
            }
            wire_.session.emergency_stop(wire_.now); // held by a character that was garbled, or lost in it
        }
        const drivers::DriverState state = wire_.state();
        done_ = program_
                    ? state == drivers::DriverState::idle && wire_.session.status().executed_blocks == lines_
                    : state == drivers::DriverState::idle ||
                          state == drivers::DriverState::stopped; // its key was let go
        check_end();
        check_quiet();
        return wrong_;
    }
    [[nodiscard]] bool done() const { return done_; }

private:
    Random random_;
    PmacFault kind_;
    PmacWire wire_;
    double fault_at_; ///< s
    bool program_ = false, done_ = false;
    int lines_ = 0;
    std::array<double, 4> target_{}; ///< degrees
    std::string wrong_;

    void wrong(const std::string& what) {
        if (wrong_.empty()) {
            wrong_ = fmt::format(
                "kind {}: {} ({})", static_cast<int>(kind_), what, wire_.session.status().message);
        }
    }
    [[nodiscard]] bool at_rest() {
        const drivers::DriverState state = wire_.state();
        return state == drivers::DriverState::idle || state == drivers::DriverState::stopped ||
               state == drivers::DriverState::alarm;
    }

    [[nodiscard]] bool link_works() const {
        return kind_ == PmacFault::reset || kind_ == PmacFault::amplifiers || kind_ == PmacFault::no_power ||
               kind_ == PmacFault::encoder || kind_ == PmacFault::emergency_stop;
    }

    void begin() {
        if (pick(random_, 2) == 0) {
            const Eigen::Index axis = pick(random_, 4);
            wire_.session.jog(jog_of(axis, 2.0 + pick(random_, 10), 5.0, pick(random_, 2) == 0 ? 0.5 : 0.0),
                              wire_.now);
            return;
        }
        program_ = true;
        std::vector<std::string> lines{"ABS", "LINEAR", "FRAX(X,Y,Z,A)", "F20"};
        for (int n = 2 + pick(random_, 4); n > 0; --n) {
            std::string line;
            for (std::size_t axis = 0; axis < target_.size(); ++axis) {
                target_[axis] = pick(random_, 20) - 10;
                line += fmt::format("{}{:.0f}", "XYZA"[axis], target_[axis]);
            }
            lines.push_back(line);
        }
        lines_ = static_cast<int>(lines.size());
        wire_.session.start(lines, wire_.now);
    }

    void breaks() {
        switch (kind_) {
        case PmacFault::reset:
            wire_.card.power_cycle();
            break;
        case PmacFault::amplifiers:
            wire_.card.raise_alarm();
            break;
        case PmacFault::no_power:
            wire_.card.emergency_stop();
            break;
        case PmacFault::encoder:
            wire_.card.unplug_encoder(1 + pick(random_, 4));
            break;
        case PmacFault::emergency_stop:
            wire_.session.emergency_stop(wire_.now);
            break;
        default:
            break;
        }
    }

    void watch_limits() {
        for (std::size_t axis = 0; axis < target_.size(); ++axis) {
            constexpr double most = 25.0; // degrees: nothing was sent further than 12
            if (std::abs(wire_.card.command(static_cast<int>(axis) + 1)) /
                    test::wire_settings().axes[axis].counts_per_degree >
                most) {
                wrong("an axis went where it was not sent");
            }
        }
    }

    void check_end() {
        if (!done_ || !program_) {
            return;
        }
        wire_.pass(0.3);
        for (std::size_t axis = 0; axis < target_.size(); ++axis) {
            if (kind_ != PmacFault::encoder && std::abs(wire_.degrees(axis) - target_[axis]) > 0.1) {
                wrong(fmt::format(
                    "done, and axis {} is at {} instead of {}", axis, wire_.degrees(axis), target_[axis]));
            }
        }
    }

    /// What is broken is made whole, and nothing is touched.
    void check_quiet() {
        constexpr double soon = 0.6; // s: the card's own kill, and coasting
        wire_.pass(soon);
        const double end = wire_.card.time();
        const bool alarm = wire_.state() == drivers::DriverState::alarm;
        wire_.card.clear_faults();
        for (int channel = 1; channel <= 4; ++channel) {
            wire_.card.unplug_encoder(channel, false);
        }
        std::array<double, 4> rest{};
        for (std::size_t axis = 0; axis < rest.size(); ++axis) {
            rest[axis] = wire_.degrees(axis);
        }
        wire_.pass(2.0);
        // a motor with power goes back to its place when it gets its drive again, inside the band in which
        // the card says that it is there (Ix28)
        constexpr double band = 10.5, settled = 1.0; // counts, s
        for (std::size_t axis = 0; axis < rest.size(); ++axis) {
            const double way = std::abs(wire_.degrees(axis) - rest[axis]) *
                               test::wire_settings().axes[axis].counts_per_degree;
            if (way > band || wire_.card.last_motion() > end + settled) {
                wrong(fmt::format("axis {} moved {} counts after the end, {}, {}",
                                  axis,
                                  way,
                                  to_text(wire_.state()),
                                  program_ ? "program" : "jog"));
            }
        }
        // over a link that is dead or lies what stands still cannot be killed
        if (alarm && link_works() && wire_.powered()) {
            wrong("an alarm, and a motor has power");
        }
    }
};

void campaign(std::uint64_t first, int runs) {
    std::array<int, pmac_fault_count> done{};
    std::array<int, pmac_fault_count> all{};
    for (std::uint64_t seed = first; seed < first + static_cast<std::uint64_t>(runs); ++seed) {
        PmacCampaignRun run(seed);
        EXPECT_EQ(run.run(), "") << "seed " << seed;
        done[seed % pmac_fault_count] += run.done() ? 1 : 0;
        ++all[seed % pmac_fault_count];
    }
    for (std::size_t kind = 0; kind < pmac_fault_count; ++kind) {
        fmt::print("kind {:2}: {:3} of {:3} ended well\n", kind, done[kind], all[kind]);
    }
    EXPECT_EQ(done[0], all[0]);
    EXPECT_LT(done[static_cast<std::size_t>(PmacFault::amplifiers)],
              all[static_cast<std::size_t>(PmacFault::amplifiers)]);
}

TEST(PmacFaultCampaign, NeverMovesAfterAFault) {
    campaign(1, 40 * pmac_fault_count);
}

TEST(PmacFaultCampaignInFull, NeverMovesAfterAFaultInRuns1To5000) {
    campaign(1, 5000);
}

TEST(PmacFaultCampaignInFull, NeverMovesAfterAFaultInRuns5001To10000) {
    campaign(5001, 5000);
}

} // namespace
} // namespace millwright::pmac::internal
