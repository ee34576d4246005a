#include "ui/actions/table_player.h"

#include "core/plot/decode_path.h"
#include "core/plot/decode_within.h"

#include <fmt/format.h>

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

/// From where the table stands to `height`, where it travels.
std::vector<Vec3> way_up(const Vec3& stands, double height, const plot::DecodeSettings& decoding) {
    const double step = decoding.velocity * decoding.period;
    const double way = height - stands.z();
    const auto steps = static_cast<std::int64_t>(std::ceil(std::abs(way) / step));
    std::vector<Vec3> points;
    for (std::int64_t n = 0; n < steps; ++n) {
        points.push_back(stands +
                         Vec3::UnitZ() * (way * static_cast<double>(n) / static_cast<double>(steps)));
    }
    return points;
}

std::vector<Vec3> joined(std::vector<Vec3> points, const std::vector<Vec3>& rest) {
    points.insert(points.end(), rest.begin(), rest.end());
    return points;
}

/// In the words of the pane, whose points have no lines.
void expect_playable(const std::vector<Vec3>& points, double period, const kinematics::MachineModel& model) {
    const auto faults = machine::check_points(points, period, model, "the points");
    if (!faults.empty()) {
        const Diagnostic& first = faults.front();
        throw Error(Diagnostic{.place = {},
                               .message = fmt::format("point {}: {}", first.place.line, first.message),
                               .hint = first.hint.empty()
                                           ? "set another Origin under Work"
                                           : "set a lower Velocity, or a Time scale of 1 or less"});
    }
}

} // namespace

void TablePlayer::play(const TableChoice& choice,
                       const plot::Strokes& strokes,
                       const std::shared_ptr<const kinematics::MachineModel>& model) {
    play_points(
        choice,
        [&](const plot::DecodeSettings& decoding, double fastest, const std::optional<Vec3>& stands) {
            return stands ? joined(way_up(*stands, decoding.pen_up_z, decoding),
                                   plot::decode_within(fastest, strokes, decoding, stands->head<2>()))
                          : plot::decode_within(fastest, strokes, decoding);
        },
        *model);
}

void TablePlayer::play(const TableChoice& choice,
                       const plot::CutPath& path,
                       const std::shared_ptr<const kinematics::MachineModel>& model) {
    if (std::ranges::find(path, plot::CutMove::tool_change, &plot::CutPoint::move) != path.end()) {
        throw Error("it changes its tool, and points do not stop for that", {}, "send its program");
    }
    play_points(
        choice,
        [&](const plot::DecodeSettings& decoding, double fastest, const std::optional<Vec3>& stands) {
            return stands ? joined(way_up(*stands, path.front().at.z(), decoding),
                                   plot::decode_path(path, decoding, fastest, stands->head<2>()))
                          : plot::decode_path(path, decoding, fastest);
        },
        *model);
}

void TablePlayer::play_points(const TableChoice& choice,
                              const Points& points,
                              const kinematics::MachineModel& model) {
    if (playing()) {
        throw Error("the table is moving", {}, "stop it, or wait for its end");
    }
    thread_ = {};
    const std::scoped_lock lock(mutex_);
    const std::optional<Vec3> stands = place_of(choice.port);
    player_.reset();
    failure_.reset();
    try {
        constexpr std::int64_t most = 5'000'000;
        plot::DecodeSettings decoding = choice.decoding;
        decoding.most_points = most;
        const auto made =
            std::make_shared<const std::vector<Vec3>>(points(decoding, fastest_of(decoding, model), stands));
        machine::PlayerOptions options;
        options.period = choice.decoding.period;
        options.speed = choice.speed;
        options.format = choice.record;
        expect_playable(*made, machine::machine_period(options, !choice.port.empty()), model);
        total_ = std::ssize(*made);
        player_ = std::make_shared<machine::PointPlayer>(
            choice.port.empty() ? nullptr : machine::make_link(choice.port), clock_, made, model, options);
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
