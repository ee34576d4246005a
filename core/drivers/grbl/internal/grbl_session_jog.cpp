// Jogs: fed in short lines, ended by whoever lets go.
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/drivers/grbl/internal/axis_units.h"
#include "core/drivers/grbl/internal/grbl_session.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace millwright::drivers::grbl {

namespace {

constexpr char jog_cancel_byte = '\x85';
constexpr double cancel_repeat_time = 0.125; // s after which a cancel that had no effect is sent again

std::string jog_line(const internal::JogSlice& slice, std::string_view letters) {
    constexpr double seconds_per_minute = 60.0;
    std::string text = "$J=G91G21";
    for (Eigen::Index n = 0; n < slice.way.size(); ++n) {
        const bool goes = std::abs(slice.way[n]) > 0.0;
        text += goes ? letters[static_cast<std::size_t>(n)] + fixed(slice.way[n], 4) : std::string();
    }
    return text + "F" + fixed(std::max(0.001, slice.speed * seconds_per_minute), 3) + "\n";
}

} // namespace

void GrblSession::jog(const Jog& jog, double now) {
    if (stage_ != Stage::jogging || jogging_.stopping) {
        require_rest("jog");
    } else if (held_at_machine()) {
        throw Error(fmt::format("{} cannot accept a jog: {}", name(), why_held(report_->state)));
    }
    if (change_) {
        change_->confirmed = false;
    }
    if (stage_ != Stage::jogging) {
        jogging_.feed.begin(eigen_of(readout_.machine_position));
        proof_closed_ = true;
        jogging_.refused = false;
        jogging_.feed.add(in_axis_units(jog, readout_.axes));
        window_ = Window(readout_.buffer_bytes, true);
        message_.clear();
        last_answer_ = last_heard_ = next_poll_ = now;
        idle_unanswered_ = 0;
        stage_ = Stage::jogging;
        rest_reports_ = 0;
        jogging_.stopping = false;
    } else {
        jogging_.feed.add(in_axis_units(jog, readout_.axes));
    }
    jogging_.until = jog.dead_man > 0.0 ? std::optional(now + jog.dead_man) : std::nullopt;
    pump_jog();
}

void GrblSession::stop_jog(double now) {
    if (stage_ == Stage::jogging && !jogging_.stopping) {
        jogging_.stopping = true;
        jogging_.until.reset();
        jogging_.feed.cancel();
        rest_reports_ = 0;
        cancel_jog(now);
        next_poll_ = now;
    }
}

void GrblSession::cancel_jog(double now) {
    output_ += jog_cancel_byte;
    last_brake_ = now;
}

/// One line at a time, so that none waits in the controller when the jog is cancelled.
void GrblSession::pump_jog() {
    if (stage_ != Stage::jogging || jogging_.stopping || !window_.empty()) {
        return;
    }
    if (const auto slice = jogging_.feed.next(eigen_of(readout_.machine_position), feed(), jog_limits())) {
        std::string text = jog_line(*slice, readout_.axes);
        output_ += text;
        window_.push({LineKind::jog, std::move(text), -1, 0.0});
        rest_reports_ = 0;
    }
}

internal::JogLimits GrblSession::jog_limits() const {
    constexpr double seconds_per_minute = 60.0;
    constexpr int first_rate = 110;
    constexpr int first_acceleration = 120;
    const auto setting = [this](int number, double otherwise) {
        const auto found = readout_.settings.find(number);
        return found != readout_.settings.end() && found->second > 0.0 ? found->second : otherwise;
    };
    internal::JogLimits limits;
    limits.spare_time = facts().jog_time;
    const Eigen::Index axes = std::ssize(readout_.axes);
    limits.rate = limits.acceleration = kinematics::AxisPositions::Zero(axes);
    for (Eigen::Index n = 0; n < axes; ++n) {
        const int axis = static_cast<int>(n);
        constexpr double slow = 600.0; // mm/min and mm/s^2, or degrees, for a controller that reports none
        constexpr double weak = 10.0;
        limits.rate[n] = setting(first_rate + axis, slow) / seconds_per_minute;
        limits.acceleration[n] = setting(first_acceleration + axis, weak);
    }
    return limits;
}

void GrblSession::watch_jog(double now) {
    if (stage_ != Stage::jogging) {
        return;
    }
    if (jogging_.until && now > *jogging_.until) {
        stop_jog(now);
    }
    if (jogging_.stopping && now - last_brake_ > cancel_repeat_time) {
        cancel_jog(now);
    }
}

} // namespace millwright::drivers::grbl
