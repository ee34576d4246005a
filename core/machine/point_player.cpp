#include "core/machine/point_player.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace millwright::machine {

using kinematics::MachineAxis;
using kinematics::MachineModel;

namespace {

constexpr std::string_view table_letters = "XYZ";

std::array<std::size_t, 3> indices_of(const MachineModel& model) {
    std::array<std::size_t, 3> found{};
    for (std::size_t n = 0; n < found.size(); ++n) {
        const int axis = model.axis_index(table_letters[n]);
        if (axis < 0) {
            throw Error(fmt::format("machine '{}' has no axis {}", model.name(), table_letters[n]));
        }
        found[n] = static_cast<std::size_t>(axis);
    }
    return found;
}

/// What to do about an axis that is too slow: strokes go up and down at a velocity of its own.
std::string slower(char axis) {
    return axis == 'Z' ? "decode it with a lower velocity up and down (--plunge-velocity), or more digits"
                       : "decode it with a lower velocity, with the pen up too (--travel-velocity), samples "
                         "rounded up, or more digits";
}

void expect_within(double value, double least, double most, const char* what) {
    if (!(value >= least && value <= most)) {
        throw Error(fmt::format("{} of {} is not between {} and {}", what, value, least, most));
    }
}

PlayerOptions checked_options(const PlayerOptions& options) {
    expect_within(options.period, 0.0005, 10.0, "a period");
    expect_within(options.speed, 0.01, 100.0, "a speed");
    expect_within(options.decimals, 0, 9, "a number of decimals");
    return options;
}

} // namespace

double machine_period(const PlayerOptions& options, bool linked) {
    return linked ? options.period / options.speed : options.period;
}

std::vector<Diagnostic> check_points(const std::vector<Vec3>& points,
                                     double period,
                                     const MachineModel& model,
                                     const std::filesystem::path& file) {
    const auto index = indices_of(model);
    const int decimals = PlayerOptions().decimals;
    const double digit = std::pow(10.0, -decimals);
    const auto written = [&](std::size_t n, std::size_t k) {
        return std::round(points[n][static_cast<Eigen::Index>(k)] / digit) * digit;
    };
    std::vector<Diagnostic> found;
    std::set<std::pair<std::size_t, bool>> told;
    const auto tell = [&](std::size_t n, std::size_t axis, bool place, std::string sentence) {
        if (told.insert({axis, place}).second) {
            found.push_back({{file, static_cast<int>(n) + 1, 0, -1},
                             std::move(sentence),
                             place ? std::string() : slower(table_letters[axis])});
        }
    };
    for (std::size_t n = 0; n < points.size(); ++n) {
        for (std::size_t k = 0; k < 3; ++k) {
            const MachineAxis& axis = model.axis(static_cast<int>(index[k]));
            const double at = points[n][static_cast<Eigen::Index>(k)];
            if (!(at >= axis.min && at <= axis.max)) {
                tell(n,
                     k,
                     true,
                     fmt::format("axis {} would go to {:.3f}, outside {:.3f} ... {:.3f} mm",
                                 axis.letter,
                                 at,
                                 axis.min,
                                 axis.max));
            }
            const double way = n == 0 ? 0.0 : std::abs(written(n, k) - written(n - 1, k));
            constexpr double last_bits = 1e-3; // of a digit
            if (way > axis.max_velocity * period + last_bits * digit) {
                tell(n,
                     k,
                     false,
                     fmt::format(
                         "axis {} would go {:.{}f} mm in {} s, {:.6g} mm/s, and goes {:.6g} mm/s at the most",
                         axis.letter,
                         way,
                         decimals,
                         period,
                         way / period,
                         axis.max_velocity));
            }
        }
    }
    return found;
}

namespace {

/// An axis that no record tells would stay where it is.
void expect_all_told(const std::vector<Vec3>& points, const std::string& pattern) {
    for (Eigen::Index k = 0; k < 3; ++k) {
        const char letter = "XYZ"[k];
        const auto changes = [&](const Vec3& point) { return std::abs(point[k] - points.front()[k]) > 0.0; };
        if (pattern.find({'{', letter, '}'}) == std::string::npos && std::ranges::any_of(points, changes)) {
            throw Error(
                fmt::format("the record '{}' does not tell {}, which the points change", pattern, letter));
        }
    }
}

} // namespace

PointPlayer::PointPlayer(std::unique_ptr<Link> link,
                         Clock& clock,
                         std::shared_ptr<const std::vector<Vec3>> points,
                         const MachineModel& model,
                         const PlayerOptions& options)
    : link_(std::move(link)), clock_(clock), points_(std::move(points)), options_(checked_options(options)),
      text_(options.format, model, options.decimals),
      path_(options.format.relative, options.period, options.decimals), index_(indices_of(model)),
      axes_(static_cast<std::size_t>(model.axis_count())) {
    if (points_->empty()) {
        throw Error("there is no point to play");
    }
    expect_all_told(*points_, options.format.pattern);
    status_.position = points_->front();
}

PointPlayer::~PointPlayer() {
    if (link_) {
        link_->close();
    }
}

PlayStatus PointPlayer::status() const {
    const std::scoped_lock lock(mutex_);
    PlayStatus now = status_;
    now.jitter = meter_.jitter();
    return now;
}

void PointPlayer::end(PlayState state, std::string sentence) {
    const std::scoped_lock lock(mutex_);
    if (status_.state == PlayState::ready || status_.state == PlayState::playing) {
        status_.state = state;
        status_.sentence = std::move(sentence);
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
    if (!link_) {
        return {};
    }
    if (const auto why = link_->lost()) {
        return loss_sentence(*why);
    }
    inbox_.add(link_->read());
    while (const auto line = inbox_.next()) {
        if (std::string why = heard(*line); !why.empty()) {
            return why;
        }
    }
    return {};
}

std::string PointPlayer::heard(const std::string& line) {
    if (line != options_.format.answer) {
        return fmt::format("the table said '{}'", line);
    }
    if (!std::exchange(awaits_answer_, false)) {
        return "the table answered a point that it was not sent";
    }
    take_answer();
    return {};
}

/// The table has the point that was sent last.
void PointPlayer::take_answer() {
    const std::scoped_lock lock(mutex_);
    status_.points = status_.sent;
    status_.position = (*points_)[static_cast<std::size_t>(status_.sent) - 1];
    status_.time = static_cast<double>(status_.sent - 1) * options_.period;
}

/// To the last point, if there is to be one.
void PointPlayer::wait_for_answer(const std::stop_token& stop) {
    const double end_of_patience = sent_at_ + options_.format.patience;
    while (awaits_answer_ && status().state == PlayState::playing) {
        if (const std::string why = complaint(); !why.empty()) {
            return end(PlayState::emergency_stop, why);
        }
        if (stop.stop_requested()) {
            return emergency_stop();
        }
        const double left = end_of_patience - clock_.now();
        if (awaits_answer_ && !(left > 0.0)) {
            return end(PlayState::emergency_stop,
                       fmt::format("the table did not answer point {} within {} s",
                                   status().sent,
                                   options_.format.patience));
        }
        if (awaits_answer_) {
            constexpr double glance = 0.02;
            link_->wait(std::min(left, glance));
        }
    }
}

/// In glances, so that a stop is soon seen.
void PointPlayer::wait_until(double time, const std::stop_token& stop) {
    constexpr double glance = 0.02;
    for (double left = time - clock_.now(); left > 0.0 && !stop.stop_requested();
         left = time - clock_.now()) {
        clock_.wait(std::min(left, glance));
    }
}

/// False when nothing may be sent any more.
bool PointPlayer::send(std::size_t n, double due) {
    const Vec3& point = (*points_)[n];
    for (std::size_t k = 0; k < 3; ++k) {
        axes_[index_[k]] = point[static_cast<Eigen::Index>(k)];
    }
    if (n == 0) {
        path_.begin(axes_);
    }
    const Record record = path_.to(axes_, std::vector<bool>(axes_.size(), true));
    const std::string text = text_.written(record) + options_.format.ending;
    const std::scoped_lock lock(mutex_);
    if (status_.state != PlayState::playing) {
        return false;
    }
    meter_.add(clock_.now() - due);
    if (link_) {
        link_->write(text);
    }
    sent_at_ = clock_.now();
    status_.sent = static_cast<std::int64_t>(n) + 1;
    awaits_answer_ = link_ != nullptr && !options_.format.answer.empty();
    if (!awaits_answer_) {
        status_.points = status_.sent;
        status_.position = point;
        status_.time = static_cast<double>(n) * options_.period;
    }
    return true;
}

PlayStatus PointPlayer::play(const std::stop_token& stop, const Listener& listener) {
    {
        const std::scoped_lock lock(mutex_);
        if (std::exchange(begun_, true)) {
            throw Error("these points were played before");
        }
        if (status_.state == PlayState::ready) {
            status_.state = PlayState::playing;
        }
    }
    if (link_) {
        link_->open();
    }
    const double interval = options_.period / options_.speed;
    const double begin = clock_.now();
    double told = begin;
    for (std::size_t n = 0; n < points_->size(); ++n) {
        const double due = begin + static_cast<double>(n) * interval;
        wait_until(due, stop);
        wait_for_answer(stop);
        if (const std::string why = complaint(); !why.empty()) {
            end(PlayState::emergency_stop, why);
        }
        if (stop.stop_requested()) {
            emergency_stop();
        }
        if (!send(n, due)) {
            return status();
        }
        constexpr double between_reports = 0.1;
        if (listener && clock_.now() - told >= between_reports) {
            told = clock_.now();
            listener(status());
        }
    }
    hear_out(begin + static_cast<double>(points_->size()) * interval, stop);
    end(PlayState::done, {});
    return status();
}

/// The last point has its period too, in which it leaves and the table may complain.
void PointPlayer::hear_out(double due, const std::stop_token& stop) {
    if (!link_) {
        return;
    }
    wait_for_answer(stop);
    constexpr double patience = 0.05; // s: longer than a wire takes
    wait_until(std::max(due, clock_.now() + patience), stop);
    if (const std::string why = complaint(); !why.empty()) {
        end(PlayState::emergency_stop, why);
    }
}

} // namespace millwright::machine
