#include "core/drivers/points/points_driver.h"

#include "core/base/error.h"
#include "core/drivers/point_sender.h"
#include "core/drivers/table_axes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <utility>

namespace millwright::drivers {

using kinematics::AxisPositions;

namespace {

DriverState driver_state_of(PlayState state) {
    switch (state) {
    case PlayState::ready: // its thread is about to begin
    case PlayState::playing:
        return DriverState::running;
    case PlayState::holding:
        return DriverState::holding;
    case PlayState::done:
        return DriverState::idle;
    case PlayState::stopped:
        return DriverState::stopped;
    case PlayState::emergency_stop:
        return DriverState::alarm;
    }
    return DriverState::alarm;
}

/// Of the program, in execution or next.
int block_of(const PointTrack& track, std::int64_t points) {
    return track.blocks[static_cast<std::size_t>(std::max<std::int64_t>(points, 1)) - 1];
}

int executed_blocks(const PointTrack& track, std::int64_t points) {
    if (points == 0) {
        return 0;
    }
    const auto next = static_cast<std::size_t>(points);
    const int block = block_of(track, points);
    const bool ended = track.ends_blocks && (next == track.blocks.size() || track.blocks[next] > block);
    return ended ? block + 1 : block;
}

void add_progress(DriverStatus& status, const PlayStatus& played, const PointTrack& track, int blocks) {
    const bool done = played.state == PlayState::done;
    status.block = done ? blocks - 1 : block_of(track, played.points);
    status.executed_blocks = done ? blocks : executed_blocks(track, played.points);
    status.sent_blocks = done ? blocks : played.sent > 0 ? block_of(track, played.sent) + 1 : 0;
    status.planned_time = played.time;
}

} // namespace

PointsDriver::PointsDriver(std::unique_ptr<links::Link> link,
                           Clock& clock,
                           std::shared_ptr<const kinematics::MachineModel> model,
                           const Vec3& position,
                           PlayerOptions options)
    : link_(std::move(link)), clock_(clock), model_(std::move(model)), options_(std::move(options)),
      index_(table_axes(*model_)), position_(position) {
    static_cast<void>(PointSender({.record = options_.format}, *model_)); // throws for what is no record
}

PointsDriver::~PointsDriver() {
    close();
}

AxisPositions PointsDriver::axes_of(const Vec3& point) const {
    AxisPositions axes = AxisPositions::Zero(model_->axis_count());
    for (std::size_t k = 0; k < index_.size(); ++k) {
        axes[static_cast<Eigen::Index>(index_[k])] = point[static_cast<Eigen::Index>(k)];
    }
    return axes;
}

std::shared_ptr<PointPlayer> PointsDriver::player() const {
    const std::scoped_lock lock(mutex_);
    return player_;
}

PlayStatus PointsDriver::played() const {
    const auto player = this->player();
    return player ? player->status() : PlayStatus{};
}

Capabilities PointsDriver::capabilities() const {
    Capabilities able;
    able.takes = Capabilities::Takes::points;
    able.reports.position = able.reports.spindle = false;
    able.reports.execution = !link_ || !options_.format.answer.empty();
    return able;
}

DriverStatus PointsDriver::status() const {
    const std::scoped_lock lock(mutex_);
    DriverStatus status;
    if (!connected_) {
        return status;
    }
    status.state = locked_ ? DriverState::alarm : DriverState::idle;
    status.message = locked_ ? "emergency stop" : "";
    status.position = axes_of(position_);
    status.position_known = false; // assumed
    status.velocity = status.work_offset = AxisPositions::Zero(model_->axis_count());
    if (!player_) {
        return status;
    }
    const PlayStatus played = player_->status();
    status.position_known = played.points > 0 && !options_.format.relative;
    status.state = locked_ ? DriverState::alarm : driver_state_of(played.state);
    const bool goes_on = status.state == DriverState::running || status.state == DriverState::holding;
    status.activity = goes_on ? Activity::program : Activity::none;
    status.position = axes_of(played.position);
    status.message = status.state == DriverState::alarm || status.state == DriverState::holding
                         ? played.sentence
                         : std::string();
    status.link_lost = status.state == DriverState::alarm && link_ && link_->lost().has_value();
    if (played.unsure) {
        status.position_doubt = fmt::format(
            "point {} had been sent, and it is not known whether the table executed it", played.sent);
    }
    add_progress(status, played, player_->track(), blocks_);
    return status;
}

void PointsDriver::connect() {
    const std::scoped_lock lock(mutex_);
    if (!connected_) {
        if (link_) {
            link_->open();
        }
        connected_ = true;
    }
}

void PointsDriver::start(Work work) {
    if (!work.points) {
        throw Error("the points driver runs points only");
    }
    const DriverState now = status().state;
    if (now != DriverState::idle && now != DriverState::stopped) {
        throw Error(fmt::format("the table is {} and cannot accept points", in_words(now)));
    }
    auto player = std::make_shared<PointPlayer>(link_.get(), clock_, work.points, *model_, options_);
    constexpr double near = 1e-4; // mm: as it is written
    const std::scoped_lock lock(mutex_);
    const Vec3 here = player_ ? player_->status().position : position_;
    const Vec3& first = work.points->points.front();
    if (!((here - first).cwiseAbs().maxCoeff() <= near)) {
        throw Error(fmt::format(
            "the points start at X {:.3f} Y {:.3f} Z {:.3f}, but the table is at X {:.3f} Y {:.3f} Z {:.3f}",
            first.x(),
            first.y(),
            first.z(),
            here.x(),
            here.y(),
            here.z()));
    }
    if (locked_) { // since it was asked above
        throw Error("emergency stop", {}, "inspect the table, then reset it");
    }
    thread_ = {};
    player_ = std::move(player);
    blocks_ = static_cast<int>(work.listing->line_of_block.size());
    thread_ = std::jthread(
        [plays = player_](const std::stop_token& stop) { static_cast<void>(plays->play(stop)); });
}

void PointsDriver::hold() {
    if (const auto player = this->player()) {
        player->hold();
    }
}

void PointsDriver::resume() {
    if (const auto player = this->player()) {
        player->resume();
    }
}

void PointsDriver::stop() {
    if (const auto player = this->player()) {
        player->stop();
    }
}

void PointsDriver::emergency_stop() {
    const std::scoped_lock lock(mutex_);
    locked_ = connected_;
    if (player_) {
        player_->emergency_stop();
    }
}

void PointsDriver::reset() {
    const std::scoped_lock lock(mutex_);
    if (link_ && link_->lost()) {
        link_->open();
    }
    locked_ = false;
    if (player_) { // the last track is over
        position_ = player_->status().position;
        thread_ = {};
        player_.reset();
    }
}

void PointsDriver::close() noexcept {
    stop();
    const std::scoped_lock lock(mutex_);
    thread_ = {};
    if (link_) {
        link_->close();
    }
    connected_ = false;
}

} // namespace millwright::drivers
