// A PMAC with its motors behind the Driver interface: jogs, homing, motion programs, on-line commands. What
// ends motion when, and what is claimed: docs/reference/pmac.md.
#pragma once

#include "core/base/error.h"
#include "core/drivers/session_driver.h"
#include "core/pmac/driver/pmac_settings.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace millwright::pmac {

namespace internal {
class PmacSession;
}

/// Of a line that would give power to motors without, before a person has let lines do that. Nothing was
/// sent.
class PowerRefused final : public Error {
public:
    using Error::Error;
};

class PmacDriver final : public drivers::SessionDriver {
public:
    /// `clock` must outlive it. Throws Error for axes or motors that no PMAC has, or that are given twice.
    PmacDriver(std::unique_ptr<links::Link> link, const Clock& clock, PmacSettings settings = arm_settings());
    PmacDriver(const PmacDriver&) = delete;
    PmacDriver& operator=(const PmacDriver&) = delete;
    ~PmacDriver() override;

    // connect() throws Error if no PMAC answers. The motors keep the power that they have. A program and
    // homing need motors with power; a program needs a known position, too. Jog::speed is rad/s, and no more
    // than PmacAxis::jog_deg_per_s.

    [[nodiscard]] std::string name() const override { return "pmac"; }
    [[nodiscard]] drivers::Capabilities capabilities() const override;
    /// By the card's I-variables, rad; axes with a motor's whole table.
    [[nodiscard]] drivers::MachineLimits limits() const override;
    /// The listing's lines are those of a motion program, without OPEN and CLOSE.
    void start(drivers::Work work) override;
    /// On-line commands, and buffers from OPEN to CLOSE, which may come in several calls: their lines are
    /// sent with CLOSE. Throws Error for jogs without an end (J+), and while motors move for lines that need
    /// rest; PowerRefused.
    int command(const std::string& lines) override;
    /// Lines that wait for the CLOSE of their buffer, from its OPEN on.
    [[nodiscard]] std::vector<std::string> kept_lines() const;
    /// Whether `lines` are more than questions and stops.
    [[nodiscard]] static bool needs_rest(const std::string& lines);
    int load(const std::vector<std::string>& lines) override;
    /// Closes the loops of all motors where they stand. Throws Error unless at rest.
    void enable() override;
    /// From now on lines may close loops of motors without power, which are refused else: a person has
    /// looked.
    void let_lines_give_power();
    /// What close() does about power, in place of what the settings say.
    void set_parting(Parting parting);
    /// Every motor has found its zero since the card started.
    [[nodiscard]] bool position_known() const;
    [[nodiscard]] bool enabled() const;
    /// Which of its own protections the card has off (protections.h), or that it did not tell; nothing while
    /// it is being asked, as after each command.
    [[nodiscard]] std::optional<std::vector<std::string>> protections_off() const;
    /// After close(): what a person should know of motors that may have kept their power; "" if the card told
    /// that they are as PmacSettings::parting says.
    [[nodiscard]] std::string farewell() const;
    [[nodiscard]] bool any_power() const; ///< of its motors, as the card last reported

private:
    [[nodiscard]] internal::PmacSession& talk() const;

    PmacSettings settings_;
};

} // namespace millwright::pmac
