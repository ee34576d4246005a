// A session with a PMAC and an emulated card with its arm, with a wire between them.
#pragma once

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/pmac/driver/arm_axes.h"
#include "core/pmac/driver/internal/pmac_session.h"
#include "core/pmac/emulator/pmac_emulator.h"
#include "tests/core/drivers/session_wire.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace millwright::test {

struct PmacHolder {
    explicit PmacHolder(pmac::PmacEmulatorOptions options) : card(std::move(options)) {}
    pmac::PmacEmulator card;
};

/// The axes of the thesis with soft limits of 90 degrees; protections as they come from the factory.
inline pmac::PmacSettings wire_settings(std::string_view letters = "XYZA",
                                        std::shared_ptr<const arm::ArmModel> arm = nullptr,
                                        pmac::Parting parting = pmac::Parting::takes_power) {
    pmac::PmacSettings settings = pmac::arm_settings_of(letters);
    settings.arm = std::move(arm);
    settings.parting = parting;
    for (pmac::PmacAxis& axis : settings.axes) {
        axis.min_deg = -90.0;
        axis.max_deg = 90.0;
    }
    return settings;
}

/// What is sent before: what a person's file would say.
inline const std::string arm_setup = "I100=1\nI200=1\nI300=1\nI400=1\nI902=10\nI907=10\nI912=10\nI917=10\n"
                                     "I123=10\nI223=10\nI323=10\nI423=10\n"
                                     "#1->120X\n#2->222Y\n#3->150Z\n#4->150A\n";

/// A feed in X that takes long enough to be interrupted.
inline const std::vector<std::string> long_x_feed{"INC", "LINEAR", "FRAX(X)", "F10", "X80"};

/// What a refused request says; empty if it was taken.
inline std::string refusal(const auto& request) {
    try {
        request();
    } catch (const Error& refused) {
        return refused.what();
    }
    return "";
}

class PmacWire : public PmacHolder, public SessionWire<pmac::internal::PmacSession, pmac::PmacEmulator> {
public:
    /// Connected; if `homed`, with power and its zero set at its position.
    explicit PmacWire(const links::FaultSpec& faults = {},
                      bool homed = true,
                      std::string_view letters = "XYZA",
                      pmac::PmacEmulatorOptions options = {},
                      const std::string& more_setup = {},
                      std::shared_ptr<const arm::ArmModel> arm = nullptr,
                      pmac::Parting parting = pmac::Parting::takes_power)
        : PmacHolder(std::move(options)),
          SessionWire(
              card, pmac::internal::PmacSession(wire_settings(letters, std::move(arm), parting)), 0.002) {
        for (const char c : arm_setup + more_setup) {
            card.receive(std::string(1, c == '\n' ? '\r' : c));
        }
        greet();
        if (homed) {
            session.enable(now);
            run_until([this] { return session.enabled(); }, 2.0);
            (void)session.command({"ZZ"}, false);
            run_until([this] { return state() == drivers::DriverState::idle && session.position_known(); },
                      5.0);
        }
        begin_faults(faults);
    }

    /// As a driver does before it drops the link.
    void leave() {
        session.leave(now);
        ASSERT_TRUE(run_until([this] { return state() != drivers::DriverState::stopping; }, 15.0));
        session.closed();
    }
    /// The link is made once more.
    void come_back() { greet(); }
    /// Lets the same time pass for both.
    void pass(double seconds) {
        run_until([] { return false; }, seconds);
    }
    [[nodiscard]] double degrees(std::size_t axis) const {
        const pmac::PmacAxis one = wire_settings("XYZAB").axes[axis];
        return card.position(one.motor) / one.counts_per_degree;
    }
    [[nodiscard]] bool powered() const {
        return card.enabled(1) || card.enabled(2) || card.enabled(3) || card.enabled(4);
    }
    [[nodiscard]] bool standing() const {
        for (int channel = 1; channel <= 4; ++channel) {
            if (std::abs(card.speed(channel)) > 1.0) {
                return false;
            }
        }
        return true;
    }
};

/// Of one axis, deg and deg/s.
inline drivers::Jog jog_of(Eigen::Index axis, double way_deg, double speed_deg, double dead_man = 0.0) {
    drivers::Jog jog;
    jog.way = kinematics::AxisPositions::Zero(4);
    jog.way[axis] = from_degrees(way_deg);
    jog.speed = from_degrees(speed_deg);
    jog.dead_man = dead_man;
    return jog;
}

} // namespace millwright::test
