// What a PMAC reports of each motor beyond position and status: how far it lags, what its amplifier is given,
// and by which I-variables it may move.
#pragma once

#include "core/drivers/driver.h"
#include "core/pmac/driver/pmac_settings.h"
#include "core/pmac/driver/protections.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace millwright::pmac::internal {

class MotorReadings {
public:
    explicit MotorReadings(std::vector<PmacAxis> axes);

    /// Asks for Ix00, Ix02, Ix11, Ix13, Ix14, Ix16, Ix17, Ix22, Ix23, Ix25 and Ix69 of an axis.
    [[nodiscard]] std::string rating_line(std::size_t axis) const;
    void read_rating(std::size_t axis, const std::vector<std::string>& lines);
    /// Asks for what changes; empty until every rating is known.
    [[nodiscard]] std::string reading_line() const;
    void read(const std::vector<std::string>& lines);
    /// The card understands no such question, or answers otherwise: it is not asked again.
    void give_up() { told_ = false; }
    /// Ix22 in counts/ms, as it was sent.
    void set_jog_speed(std::size_t axis, double counts_per_ms) { jog_speeds_[axis] = counts_per_ms; }
    /// Ix22 in counts/ms; nullopt until it is reported.
    [[nodiscard]] std::optional<double> jog_speed(std::size_t axis) const { return jog_speeds_[axis]; }
    /// The way in which a motor looks for its home, by the sign of Ix23: 1 or -1; 1 where it was not
    /// reported.
    [[nodiscard]] double way_home(std::size_t axis) const { return ways_home_[axis]; }

    /// In the order of the axes; empty until they are reported.
    [[nodiscard]] const std::vector<drivers::MotorReading>& motors() const { return motors_; }
    /// As the card last reported (protections.h); there is a sentence, too, if it did not report.
    [[nodiscard]] std::vector<std::string> protections_off() const;
    /// The card's and the joints', the narrower ones.
    [[nodiscard]] std::vector<drivers::MachineLimits::Axis> limits() const;

private:
    [[nodiscard]] double radians(std::size_t axis, double counts) const;

    std::vector<PmacAxis> axes_;
    std::vector<int> outputs_;                         ///< addresses of the converters; -1: not reported yet
    std::vector<drivers::MachineLimits::Axis> limits_; ///< of the card: rad, s
    std::vector<std::optional<double>> jog_speeds_;
    std::vector<double> ways_home_;
    std::vector<std::optional<MotorProtections>> protections_; ///< nullopt: not reported
    std::vector<drivers::MotorReading> motors_;
    bool told_ = true;
};

} // namespace millwright::pmac::internal
