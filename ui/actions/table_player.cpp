#include "ui/actions/table_player.h"

#include "core/plot/decode_within.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace millwright::actions {

namespace {

/// The slowest axis, which no rounding of the samples exceeds; velocities that were asked for may.
double fastest_of(const plot::DecodeSettings& decoding, const kinematics::MachineModel& model) {
    double slowest = std::numeric_limits<double>::max();
    for (const char letter : {'X', 'Y', 'Z'}) {
        const int axis = model.axis_index(letter);
        slowest = axis < 0 ? slowest : std::min(slowest, model.axis(axis).max_velocity);
    }
    return std::max({slowest,
                     decoding.velocity,
                     decoding.travel_velocity.value_or(0.0),
                     decoding.plunge_velocity.value_or(0.0)});
}

std::shared_ptr<machine::PointPlayer> player_of(const TableChoice& choice,
                                                const plot::Strokes& strokes,
                                                const kinematics::MachineModel& model,
                                                machine::Clock& clock,
                                                std::int64_t& total) {
    plot::DecodeSettings decoding = choice.decoding;
    constexpr std::int64_t most = 5'000'000;
    decoding.most_points = most;
    auto points = std::make_shared<const std::vector<Vec3>>(
        plot::decode_within(fastest_of(decoding, model), strokes, decoding));
    machine::PlayerOptions options;
    options.period = choice.decoding.period;
    options.speed = choice.speed;
    options.format = choice.record;
    const double period = machine::machine_period(options, !choice.port.empty());
    if (const auto faults = machine::check_points(*points, period, model, "the points"); !faults.empty()) {
        throw Error(faults.front());
    }
    total = std::ssize(*points);
    return std::make_shared<machine::PointPlayer>(
        choice.port.empty() ? nullptr : machine::make_link(choice.port), clock, points, model, options);
}

} // namespace

void TablePlayer::play(const TableChoice& choice,
                       const plot::Strokes& strokes,
                       const std::shared_ptr<const kinematics::MachineModel>& model) {
    if (playing()) {
        throw Error("the table is moving", {}, "stop it, or wait for its end");
    }
    thread_ = {};
    const std::scoped_lock lock(mutex_);
    player_.reset();
    failure_.reset();
    try {
        player_ = player_of(choice, strokes, *model, clock_, total_);
    } catch (const Error& error) {
        failure_ = error.diagnostic();
        return;
    }
    thread_ = std::jthread([this, player = player_](const std::stop_token& stop) {
        try {
            (void)player->play(stop, [this](const machine::PlayStatus&) { wake_(); });
        } catch (const Error& error) {
            const std::scoped_lock failed(mutex_);
            failure_ = error.diagnostic();
        }
        wake_();
    });
}

void TablePlayer::emergency_stop() {
    const std::scoped_lock lock(mutex_);
    if (player_) {
        player_->emergency_stop();
    }
}

TableView TablePlayer::view() const {
    const std::scoped_lock lock(mutex_);
    TableView view;
    view.failure = failure_;
    if (player_) {
        view.there = true;
        view.total = total_;
        view.status = player_->status();
    }
    return view;
}

void TablePlayer::wait() {
    if (thread_.joinable()) {
        thread_.join();
    }
}

} // namespace millwright::actions
