#include "ui/actions/table_player.h"

#include "core/plot/decode_within.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

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

/// From where the table stands up to where it travels, and on to the beginning of the first stroke.
std::vector<Vec3> points_from(const Vec3& stands,
                              double fastest,
                              const plot::Strokes& strokes,
                              const plot::DecodeSettings& decoding) {
    const double step = decoding.velocity * decoding.period;
    const double way = decoding.pen_up_z - stands.z();
    const auto steps = static_cast<std::int64_t>(std::ceil(std::abs(way) / step));
    std::vector<Vec3> points;
    for (std::int64_t n = 0; n < steps; ++n) {
        points.push_back(stands +
                         Vec3::UnitZ() * (way * static_cast<double>(n) / static_cast<double>(steps)));
    }
    const std::vector<Vec3> rest = plot::decode_within(fastest, strokes, decoding, stands.head<2>());
    points.insert(points.end(), rest.begin(), rest.end());
    return points;
}

std::shared_ptr<machine::PointPlayer> player_of(const TableChoice& choice,
                                                const plot::Strokes& strokes,
                                                const kinematics::MachineModel& model,
                                                const std::optional<Vec3>& stands,
                                                machine::Clock& clock,
                                                std::int64_t& total) {
    plot::DecodeSettings decoding = choice.decoding;
    constexpr std::int64_t most = 5'000'000;
    decoding.most_points = most;
    const double fastest = fastest_of(decoding, model);
    auto points =
        std::make_shared<const std::vector<Vec3>>(stands ? points_from(*stands, fastest, strokes, decoding)
                                                         : plot::decode_within(fastest, strokes, decoding));
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
    const std::optional<Vec3> stands = place_of(choice.port);
    player_.reset();
    failure_.reset();
    try {
        player_ = player_of(choice, strokes, *model, stands, clock_, total_);
        port_ = choice.port;
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

/// For the eyes alone everything begins anew.
std::optional<Vec3> TablePlayer::place_of(const std::string& port) {
    if (player_ && !port_.empty() && player_->status().sent > 0) {
        stands_ = {port_, player_->status().position};
    }
    return stands_ && stands_->port == port ? std::optional(stands_->at) : std::nullopt;
}

void TablePlayer::stop() {
    const std::scoped_lock lock(mutex_);
    if (player_) {
        player_->stop();
    }
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
