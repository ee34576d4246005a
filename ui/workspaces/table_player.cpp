#include "ui/workspaces/table_player.h"

#include "core/jobs/point_job.h"
#include "core/links/link.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <ctime>
#include <utility>

namespace millwright::actions {

namespace {

/// In the words of the pane, whose points have no lines.
void expect_playable(const jobs::Job& job) {
    const auto faults = drivers::check_points(*job.points, *job.machine, "the points");
    if (!faults.empty()) {
        const Diagnostic& first = faults.front();
        throw Error(Diagnostic{.place = {},
                               .message = fmt::format("point {}: {}", first.place.line, first.message),
                               .hint = first.hint.empty()
                                           ? "set another Origin under Work"
                                           : "set a lower Velocity, or a Time scale of 1 or less"});
    }
}

std::string date_and_time() {
    return fmt::format("{:%Y-%m-%d %H:%M:%S}", fmt::localtime(std::time(nullptr)));
}

jobs::Job table_job(const TableChoice& choice, const TableWork& work, const std::optional<Vec3>& start) {
    const double speed = choice.port.empty() ? 1.0 : choice.speed;
    if (work.points) {
        jobs::Job job = jobs::point_file_job(
            work.points->text, work.points->read, work.file, work.model, choice.decoding.period / speed);
        expect_playable(job);
        job.started_at = date_and_time();
        return job;
    }
    constexpr std::int64_t most = 5'000'000;
    jobs::PathPoints settings{
        .decoding = choice.decoding, .start = start, .speed = speed, .spindle_rpm = work.spindle_rpm};
    settings.decoding.most_points = most;
    jobs::Job job = jobs::path_points_job(*work.path, work.file, work.model, settings);
    expect_playable(job);
    job.started_at = date_and_time();
    return job;
}

} // namespace

Vec3 TableWork::usual_start() const {
    return points && !points->read.points.empty() ? points->read.points.front() : jobs::usual_start(*path);
}

void TablePlayer::play(const TableChoice& choice, TableWork work) {
    if (playing()) {
        throw Error("the table is moving", {}, "stop it, or wait until it has finished");
    }
    thread_ = {};
    const std::optional<Vec3> start = place(choice.port);
    auto play = std::make_shared<Play>();
    play->choice = choice;
    play->driver = std::make_shared<drivers::PointsDriver>(
        choice.port.empty() ? nullptr : links::make_link(choice.port),
        clock_,
        work.model,
        start.value_or(work.usual_start()),
        // Shown faster, a table that is not there moves no faster.
        drivers::PlayerOptions{.speed = choice.port.empty() ? choice.speed : 1.0, .format = choice.record});
    play->dispatcher = std::make_unique<jobs::Dispatcher>(*play->driver, clock_, log_folder_);
    const std::scoped_lock lock(mutex_);
    place_before_ = last_place();
    play_ = play;
    playing_ = true;
    total_ = 0;
    duration_ = 0.0;
    failure_.reset();
    outcome_.reset();
    thread_ = std::jthread([this, play, work = std::move(work), start](const std::stop_token& stop) {
        run(play, work, start, stop);
    });
}

void TablePlayer::run(const std::shared_ptr<Play>& play,
                      const TableWork& work,
                      const std::optional<Vec3>& start,
                      const std::stop_token& stop) {
    std::optional<Diagnostic> failure;
    std::optional<jobs::JobOutcome> outcome;
    try {
        const jobs::Job job = table_job(play->choice, work, start);
        {
            const std::scoped_lock lock(mutex_);
            total_ = std::ssize(job.points->points);
            duration_ = job.points->duration();
        }
        outcome =
            play->dispatcher->run(job, Progress(nullptr, stop), [this](const jobs::JobReport&) { wake_(); });
    } catch (const Error& error) {
        failure = error.diagnostic();
    } catch (const Cancelled&) {
        failure = Diagnostic{{}, "playback was stopped before it began", {}};
    } catch (const std::exception& defect) {
        failure = Diagnostic{{}, defect.what(), {}};
    }
    play->driver->close();
    {
        const std::scoped_lock lock(mutex_);
        playing_ = false;
        failure_ = std::move(failure);
        outcome_ = std::move(outcome);
    }
    wake_();
}

std::shared_ptr<TablePlayer::Play> TablePlayer::current() const {
    const std::scoped_lock lock(mutex_);
    return playing_ ? play_ : nullptr;
}

/// A play that was refused, or that nothing was sent for, moved no table. With the mutex held.
std::optional<TablePlayer::Place> TablePlayer::last_place() const {
    if (play_ && !play_->choice.port.empty()) {
        const drivers::PlayStatus played = play_->driver->played();
        if (played.sent > 0) {
            return Place{play_->choice.port, played.position};
        }
    }
    return place_before_;
}

std::optional<Vec3> TablePlayer::place(const std::string& port) const {
    const std::scoped_lock lock(mutex_);
    const std::optional<Place> last = last_place();
    return last && last->port == port ? std::optional(last->at) : std::nullopt;
}

void TablePlayer::hold() {
    if (const auto play = current()) {
        play->dispatcher->hold();
    }
}

void TablePlayer::resume() {
    if (const auto play = current()) {
        play->dispatcher->resume();
    }
}

/// Where nothing moves yet, the job does not begin.
void TablePlayer::stop() {
    if (const auto play = current()) {
        if (play->driver->status().activity == drivers::Activity::none) {
            thread_.request_stop();
        }
        play->dispatcher->stop();
    }
}

void TablePlayer::emergency_stop() {
    if (const auto play = current()) {
        play->driver->emergency_stop();
        if (play->driver->status().activity == drivers::Activity::none) {
            thread_.request_stop();
        }
    }
}

TableView TablePlayer::view() const {
    const std::scoped_lock lock(mutex_);
    TableView view;
    view.playing = playing_;
    view.failure = failure_;
    view.outcome = outcome_;
    if (play_) {
        view.total = total_;
        view.duration = duration_;
        view.status = play_->driver->played();
        view.there = playing_ || view.status.sent > 0;
    }
    return view;
}

std::string TablePlayer::port() const {
    const std::scoped_lock lock(mutex_);
    return play_ ? play_->choice.port : std::string();
}

double TablePlayer::time_left() const {
    const std::scoped_lock lock(mutex_);
    if (!playing_ || !play_) {
        return 0.0;
    }
    const auto left = static_cast<double>(total_ - play_->driver->played().points);
    return left * play_->choice.decoding.period / play_->choice.speed;
}

void TablePlayer::wait() {
    if (thread_.joinable()) {
        thread_.join();
    }
}

} // namespace millwright::actions
