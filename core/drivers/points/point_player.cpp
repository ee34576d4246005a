#include "core/drivers/points/point_player.h"

#include "core/base/error.h"
#include "core/drivers/table_axes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace millwright::drivers {

using kinematics::MachineModel;

namespace {

constexpr double player_glance = 0.02; // s: a stop is seen no later

void expect_within(double value, double least, double most, const char* what) {
    if (!(value >= least && value <= most)) {
        throw Error(fmt::format("a {} of {} is not between {} and {}", what, value, least, most));
    }
}

std::shared_ptr<const PointTrack> checked_track(std::shared_ptr<const PointTrack> track) {
    expect_within(track->period, 0.0005, 10.0, "period");
    if (track->points.empty()) {
        throw Error("there are no points to run");
    }
    return track;
}

PlayerOptions checked_options(const PlayerOptions& options) {
    expect_within(options.speed, 0.01, 100.0, "speed");
    return options;
}

/// An axis that no record names would stay where it is.
void expect_all_named(const std::vector<Vec3>& points, const std::string& pattern) {
    for (Eigen::Index k = 0; k < 3; ++k) {
        const char letter = "XYZ"[k];
        const auto changes = [&](const Vec3& point) { return std::abs(point[k] - points.front()[k]) > 0.0; };
        if (pattern.find({'{', letter, '}'}) == std::string::npos && std::ranges::any_of(points, changes)) {
            throw Error(fmt::format("the record '{}' omits {}, which the points change", pattern, letter));
        }
    }
}

} // namespace

PointPlayer::PointPlayer(links::Link* link,
                         Clock& clock,
                         std::shared_ptr<const PointTrack> track,
                         const MachineModel& model,
                         const PlayerOptions& options)
    : link_(link), clock_(clock), track_(checked_track(std::move(track))), options_(checked_options(options)),
      index_(table_axes(model)), axes_(kinematics::AxisPositions::Zero(model.axis_count())),
      sender_({options.format, track_->period, point_decimals}, model) {
    expect_all_named(track_->points, options.format.pattern);
    status_.position = track_->points.front();
    if (link_ != nullptr && !sender_.asks()) {
        links::expect_carried(*link_, longest_record(), interval());
    }
}

/// Of the machine, at point `n`.
const kinematics::AxisPositions& PointPlayer::axes_at(std::size_t n) {
    for (std::size_t k = 0; k < index_.size(); ++k) {
        axes_[static_cast<Eigen::Index>(index_[k])] = track_->points[n][static_cast<Eigen::Index>(k)];
    }
    return axes_;
}

/// Bytes, of a thousand along the track.
std::size_t PointPlayer::longest_record() {
    constexpr std::size_t looked_at = 1000;
    const std::size_t count = track_->points.size();
    std::size_t longest = 0;
    for (std::size_t n = 0; n < count; n += std::max<std::size_t>(1, count / looked_at)) {
        sender_.begin(axes_at(n == 0 ? 0 : n - 1));
        longest = std::max(longest, sender_.to(axes_at(n)).size());
    }
    return longest;
}

PlayStatus PointPlayer::status() const {
    const std::scoped_lock lock(mutex_);
    PlayStatus now = status_;
    now.jitter = meter_.jitter();
    now.unsure = now.state == PlayState::emergency_stop && sender_.owed();
    return now;
}

bool PointPlayer::goes_on() const {
    const std::scoped_lock lock(mutex_);
    return status_.state == PlayState::playing || status_.state == PlayState::holding;
}

void PointPlayer::end(PlayState state, std::string sentence) {
    const std::scoped_lock lock(mutex_);
    const bool over = status_.state == PlayState::done || status_.state == PlayState::stopped ||
                      status_.state == PlayState::emergency_stop;
    if (!over) {
        status_.state = state;
        status_.sentence = std::move(sentence);
    }
}

void PointPlayer::hold() {
    const std::scoped_lock lock(mutex_);
    if (status_.state == PlayState::playing || status_.state == PlayState::ready) {
        status_.state = PlayState::holding;
    }
}

void PointPlayer::resume() {
    const std::scoped_lock lock(mutex_);
    if (status_.state == PlayState::holding) {
        status_.state = PlayState::playing;
        status_.sentence.clear();
    }
}

void PointPlayer::stop() {
    end(PlayState::stopped, "stopped");
}

void PointPlayer::emergency_stop() {
    end(PlayState::emergency_stop, "emergency stop");
}

/// What the table says that it should not; empty: nothing.
std::string PointPlayer::complaint() {
    if (link_ == nullptr) {
        return {};
    }
    if (const auto why = link_->lost()) {
        return links::loss_sentence(*why);
    }
    const std::string bytes = link_->read();
    const std::scoped_lock lock(mutex_);
    for (auto heard = sender_.hear(bytes); heard; heard = sender_.hear()) {
        if (std::string why = complaint_of(*heard); !why.empty()) {
            return why;
        }
        take_answer();
    }
    return {};
}

/// Empty for an answer as it should be.
std::string PointPlayer::complaint_of(const PointSender::Heard& heard) const {
    if (heard.line != options_.format.answer) {
        return fmt::format("the table sent '{}'", heard.line);
    }
    return heard.kind == PointSender::Answer::unasked ? "the table answered a point that was not sent" : "";
}

/// The table has the point that was sent last. With the mutex held.
void PointPlayer::take_answer() {
    status_.points = status_.sent;
    status_.position = track_->points[static_cast<std::size_t>(status_.sent) - 1];
    status_.time = static_cast<double>(status_.sent - 1) * track_->period;
}

/// What ends it, whatever it is at.
void PointPlayer::heed(const std::stop_token& stop) {
    if (const std::string why = complaint(); !why.empty()) {
        end(PlayState::emergency_stop, why);
    }
    if (stop.stop_requested()) {
        emergency_stop();
    }
}

/// To the last point, if there is to be one.
void PointPlayer::wait_for_answer(const std::stop_token& stop) {
    const double end_of_patience = sent_at_ + options_.format.patience;
    const auto waits = [this] {
        const std::scoped_lock lock(mutex_);
        return sender_.owed();
    };
    while (waits() && goes_on()) {
        heed(stop);
        const double left = end_of_patience - clock_.now();
        if (waits() && !(left > 0.0)) {
            return end(PlayState::emergency_stop,
                       fmt::format("the table did not answer point {} within {} s",
                                   status().sent,
                                   options_.format.patience));
        }
        if (waits()) {
            link_->wait(std::min(left, player_glance));
        }
    }
}

/// In glances, so that a stop is soon seen.
void PointPlayer::wait_until(double time, const std::stop_token& stop) {
    for (double left = time - clock_.now(); left > 0.0 && !stop.stop_requested();
         left = time - clock_.now()) {
        clock_.wait(std::min(left, player_glance));
    }
}

/// While it is held. What was due meanwhile is due so much later.
void PointPlayer::rest(const std::stop_token& stop, const Listener& listener) {
    const double from = clock_.now();
    while (status().state == PlayState::holding) {
        heed(stop);
        if (listener) {
            listener(status());
        }
        clock_.wait(player_glance);
    }
    begin_ += clock_.now() - from;
}

/// Those that stand before point `n`.
void PointPlayer::rest_at_stops(std::size_t n, const std::stop_token& stop, const Listener& listener) {
    for (auto next = static_cast<std::size_t>(status().stops);
         next < track_->stops.size() && track_->stops[next].before <= n && goes_on();
         ++next) {
        wait_out(begin_ + static_cast<double>(n) * interval(), stop);
        {
            const std::scoped_lock lock(mutex_);
            if (status_.state == PlayState::playing || status_.state == PlayState::holding) {
                status_.state = PlayState::holding;
                status_.sentence = track_->stops[next].why;
            }
        }
        rest(stop, listener);
        begin_ = std::max(begin_, clock_.now() - static_cast<double>(n) * interval());
        const std::scoped_lock lock(mutex_);
        status_.stops += status_.state == PlayState::playing ? 1 : 0;
    }
}

PointPlayer::Sending PointPlayer::send(std::size_t n, double due) {
    const std::scoped_lock lock(mutex_);
    if (status_.state != PlayState::playing) {
        return status_.state == PlayState::holding ? Sending::held : Sending::over;
    }
    const kinematics::AxisPositions& axes = axes_at(n);
    if (n == 0) {
        sender_.begin(axes);
    }
    meter_.add(clock_.now() - due);
    if (link_ != nullptr) {
        link_->write(sender_.to(axes));
    }
    sent_at_ = clock_.now();
    status_.sent = static_cast<std::int64_t>(n) + 1;
    if (!sender_.owed()) {
        take_answer();
    }
    return Sending::sent;
}

PlayStatus PointPlayer::play(const std::stop_token& stop, const Listener& listener) {
    {
        const std::scoped_lock lock(mutex_);
        if (std::exchange(begun_, true)) {
            throw Error("these points have already been run");
        }
        if (status_.state == PlayState::ready) {
            status_.state = PlayState::playing;
        }
    }
    begin_ = reported_at_ = clock_.now();
    for (std::size_t n = 0; n < track_->points.size();) {
        rest_at_stops(n, stop, listener);
        const double due = begin_ + static_cast<double>(n) * interval();
        wait_until(due, stop);
        wait_for_answer(stop);
        heed(stop);
        switch (send(n, due)) {
        case Sending::sent:
            ++n;
            break;
        case Sending::held:
            rest(stop, listener);
            continue;
        case Sending::over:
            return status();
        }
        constexpr double between_reports = 0.1;
        if (listener && clock_.now() - reported_at_ >= between_reports) {
            reported_at_ = clock_.now();
            listener(status());
        }
    }
    rest_at_stops(track_->points.size(), stop, listener);
    wait_out(begin_ + static_cast<double>(track_->points.size()) * interval(), stop);
    end(PlayState::done, {});
    return status();
}

/// The last point has its period too, in which it leaves and the table may complain.
void PointPlayer::wait_out(double due, const std::stop_token& stop) {
    if (link_ == nullptr) {
        return;
    }
    wait_for_answer(stop);
    constexpr double patience = 0.05; // s: longer than a wire takes
    wait_until(std::max(due, clock_.now() + patience), stop);
    heed(stop);
}

} // namespace millwright::drivers
