#include "core/jobs/internal/running_job.h"

#include "core/base/sentences.h"
#include "core/jobs/job_report.h"

#include <algorithm>
#include <exception>
#include <utility>

namespace millwright::jobs::internal {

SharedLog::SharedLog(JobLog& log, const Clock& clock, double start, int blocks, LogRecord before)
    : log_(log), clock_(clock), start_(start), blocks_(blocks), last_(std::move(before)), since_(start) {}

void SharedLog::write(const LogRecord& record) {
    const std::scoped_lock lock(mutex_);
    try {
        log_.write(record);
    } catch (...) {
        failure_ = failure_ ? failure_ : std::current_exception();
        throw;
    }
    last_ = record;
}

int SharedLog::allow(int wanted) noexcept {
    const std::scoped_lock lock(mutex_);
    if (closed_ || failure_ || wanted <= allowed_) {
        return allowed_;
    }
    try {
        const double now = clock_.now();
        LogRecord ahead;
        ahead.event = LogEvent::ahead;
        ahead.time = std::max(0.0, now - start_);
        ahead.executed_blocks = last_.executed_blocks;
        ahead.line = last_.line;
        ahead.position = last_.position;
        ahead.position_doubt = last_.position_doubt;
        ahead.allowed_blocks = std::min(wanted + sent_soon(wanted, now), blocks_);
        log_.write(ahead);
        allowed_ = ahead.allowed_blocks;
    } catch (...) {
        failure_ = std::current_exception();
    }
    return allowed_;
}

/// At the rate of the last tenths of a second. What fills the controller's buffer at the start is no rate.
int SharedLog::sent_soon(int wanted, double now) {
    constexpr double soon = 0.02;      // s
    constexpr double shortest = 0.1;   // s over which a rate is taken
    constexpr double longest = 0.3;    // s
    constexpr double most_ahead = 100; // blocks
    const double elapsed = now - since_;
    const double rate = (wanted - wanted_then_) / std::max(elapsed, shortest);
    if (elapsed > longest) {
        since_ = now - shortest;
        wanted_then_ = wanted - static_cast<int>(rate * shortest);
    }
    return static_cast<int>(std::clamp(rate * soon, 0.0, most_ahead));
}

void SharedLog::rethrow_failure() const {
    const std::scoped_lock lock(mutex_);
    if (failure_) {
        std::rethrow_exception(failure_);
    }
}

void SharedLog::close() {
    const std::scoped_lock lock(mutex_);
    closed_ = true;
}

bool ended(drivers::DriverState state) {
    return state == drivers::DriverState::idle || state == drivers::DriverState::stopped ||
           state == drivers::DriverState::alarm || state == drivers::DriverState::disconnected;
}

double planned_time(const Job& job, const motion::Trajectory* trajectory) {
    return trajectory != nullptr ? trajectory->duration() : job.points ? job.points->duration() : 0.0;
}

RunningJob::RunningJob(JobSurroundings around,
                       const Job& job,
                       JobLog& log,
                       std::shared_ptr<const motion::Trajectory> trajectory,
                       drivers::DriverStatus before,
                       PositionEnvelope envelope,
                       PathEstimate estimate)
    : driver_(around.driver), clock_(around.clock), take_requests_(std::move(around.take_requests)),
      stop_(std::move(around.stop)), job_(job), file_(log.file()), trajectory_(std::move(trajectory)),
      envelope_(std::move(envelope)), estimate_(std::move(estimate)), able_(driver_.capabilities()),
      start_(clock_.now()), last_(std::move(before)), doubt_before_(last_.position_doubt) {
    last_.own_lines.clear();
    last_.executed_blocks = last_.sent_blocks = 0; // those are of the program before
    last_.block = -1;
    log_ = std::make_shared<SharedLog>(log, clock_, start_, blocks(), record(LogEvent::executed, 0.0, last_));
}

JobOutcome RunningJob::to_the_end(const Progress& progress,
                                  const std::function<void(const JobReport&)>& listener) {
    while (true) {
        if (progress.cancelled() && !std::exchange(cancelled_, true)) {
            stop_();
        }
        const drivers::DriverStatus status = driver_.status();
        remember(status);
        write_requests();
        write_executed();
        write_own_lines();
        write_waiting();
        log_->rethrow_failure();
        tell(progress, listener);
        watch_reach(status);
        if (ended(status.state)) {
            return outcome(status);
        }
        clock_.wait(poll_time);
    }
}

void RunningJob::log_failure(const std::string& why) noexcept {
    try {
        remember(driver_.status());
        write_end(with_full_stop("The job was aborted: " + why));
    } catch (const std::exception&) {
        // The failure itself is on its way to the user, and a log without an end promises nothing.
    }
}

Diagnostic RunningJob::log_lost(const std::string& reason) {
    remember(driver_.status());
    const std::string why = log_lost_sentence(last_, blocks(), "its log cannot be written: " + reason);
    const std::string done = done_text(last_.executed_blocks, blocks(), able_.reports.execution);
    try {
        LogRecord fault = record(LogEvent::fault, elapsed(), last_);
        fault.text = why;
        log_->write(fault);
        write_end(with_clause(capitalised(why), done + "."));
    } catch (const std::exception&) {
        // The last line that it has stays right.
    }
    return {{file_}, with_clause(why, done), "inspect the machine, and free disk space before the next job"};
}

void RunningJob::write_end(std::string text) {
    LogRecord end = record(LogEvent::end, elapsed(), last_);
    end.end = JobEnd::fault;
    end.text = std::move(text);
    log_->write(end);
}

void RunningJob::remember(const drivers::DriverStatus& status) {
    if (status.state != drivers::DriverState::disconnected) {
        const drivers::DriverStatus before = std::exchange(last_, status);
        estimate_place(status);
        last_.planned_time = able_.takes_text() ? time_of_place() : last_.planned_time;
        if (status.position_doubt != doubt_before_) { // what a controller says now is no position
            last_.block = before.block;
            last_.fraction = before.fraction;
            last_.position = before.position;
            last_.work_offset = before.work_offset;
        }
        return;
    }
    last_.state = status.state;
    last_.message = status.message;
}

/// By the reported position, where the controller proves late what it has executed.
void RunningJob::estimate_place(const drivers::DriverStatus& status) {
    const auto& lines = job_.listing->line_of_block;
    const int sent = std::min(status.sent_blocks, static_cast<int>(std::ssize(lines)));
    const int executed = std::clamp(status.executed_blocks, 0, sent);
    if (!estimate_.knows_path() || executed >= sent || status.position.size() < 3) {
        return;
    }
    const PathPlace place = estimate_.place_at(status.position.head<3>(),
                                               lines[static_cast<std::size_t>(executed)],
                                               lines[static_cast<std::size_t>(sent - 1)]);
    if (const int block = job_.listing->block_at_line(place.line); block >= status.block) {
        last_.block = block;
        last_.fraction = place.fraction;
    }
}

/// How far a controller that follows its own plan would be in ours, as far as its place is known.
double RunningJob::time_of_place() const {
    const int block = std::max({0, last_.executed_blocks, last_.block});
    if (!trajectory_ || last_.executed_blocks >= blocks() || block >= trajectory_->block_count()) {
        return planned();
    }
    return trajectory_->time_at(block, block == last_.block ? last_.fraction : 0.0);
}

LogRecord RunningJob::record(LogEvent event, double time, const drivers::DriverStatus& status) const {
    LogRecord line;
    line.event = event;
    line.time = time;
    line.executed_blocks = status.executed_blocks;
    line.position_doubt = status.position_doubt;
    const auto next = static_cast<std::size_t>(status.executed_blocks);
    const auto& lines = job_.listing->line_of_block;
    // In the approach: the line that it leads to, since those above are not of the file.
    line.line = std::max(next < lines.size() ? lines[next] : job_.listing->line_count(), job_.from_line);
    line.position = job_.program != nullptr ? status.position : status.work_position();
    return line;
}

/// A machine that is where no line sends it is stopped.
void RunningJob::watch_reach(const drivers::DriverStatus& status) {
    if (!beyond_.empty()) {
        return;
    }
    beyond_ = envelope_.watch(status, clock_.now());
    if (!beyond_.empty()) {
        driver_.break_off(beyond_);
        last_.message = beyond_;
    }
}

void RunningJob::write_requests() {
    for (const JobRequest& request : take_requests_()) {
        const double time = std::max(0.0, request.clock_time - start_);
        if (request.status.state != drivers::DriverState::disconnected) {
            LogRecord line = record(request.event, time, request.status);
            line.text = request.text;
            log_->write(line);
            logged_blocks_ = std::max(logged_blocks_, request.status.executed_blocks);
        }
    }
}

void RunningJob::write_executed() {
    if (last_.executed_blocks > logged_blocks_) {
        logged_blocks_ = last_.executed_blocks;
        log_->write(record(able_.reports.execution ? LogEvent::executed : LogEvent::sent, elapsed(), last_));
    }
}

/// What was sent besides the program, as such.
void RunningJob::write_own_lines() {
    for (; own_lines_ < std::size(last_.own_lines); ++own_lines_) {
        LogRecord line = record(LogEvent::own, elapsed(), last_);
        line.text = last_.own_lines[own_lines_];
        log_->write(line);
    }
}

/// Once for each time that the machine begins to wait without having been asked to.
void RunningJob::write_waiting() {
    const bool for_tool = last_.tool_change && last_.tool_change->waits; // jogs do not end it
    const bool waits = for_tool || last_.state == drivers::DriverState::holding;
    const std::string why = waits ? last_.message : std::string();
    if (why != waits_for_ && !why.empty()) {
        LogRecord line = record(LogEvent::waiting, elapsed(), last_);
        line.text = why;
        log_->write(line);
    }
    waits_for_ = why;
}

void RunningJob::tell(const Progress& progress, const std::function<void(const JobReport&)>& listener) const {
    const JobReport report{
        last_, blocks(), elapsed(), planned(), able_.reports.execution, line_of(last_.block)};
    progress.report(report.fraction(), report.progress_text());
    if (listener) {
        listener(report);
    }
}

int RunningJob::line_of(int block) const {
    const auto& lines = job_.listing->line_of_block;
    return block >= 0 && block < std::ssize(lines) ? lines[static_cast<std::size_t>(block)] : 0;
}

JobEnd RunningJob::end_of(const drivers::DriverStatus& status) const {
    if (!beyond_.empty()) {
        return JobEnd::fault;
    }
    if (status.state == drivers::DriverState::idle && status.executed_blocks == blocks()) {
        return JobEnd::done;
    }
    if (status.state == drivers::DriverState::stopped) {
        return cancelled_ ? JobEnd::cancelled : JobEnd::stopped;
    }
    return JobEnd::fault;
}

JobOutcome RunningJob::outcome(const drivers::DriverStatus& status) {
    write_own_lines();
    write_requests(); // one that came between the last look at them and the end
    last_.message = beyond_.empty() ? last_.message : beyond_;
    JobOutcome result;
    result.end = end_of(status);
    result.executed_blocks = last_.executed_blocks;
    result.blocks = blocks();
    result.elapsed = elapsed();
    result.position = last_.position;
    result.sentence = end_sentence(result.end, last_, result, line_of(last_.block), able_.reports.execution);
    if (last_.position_doubt != doubt_before_ && !last_.position_doubt.empty()) {
        result.sentence += " " + drivers::doubt_sentence(last_.position_doubt);
    }
    result.log_file = file_;
    if (result.end == JobEnd::fault) {
        LogRecord fault = record(LogEvent::fault, result.elapsed, last_);
        fault.text = last_.message;
        log_->write(fault);
    }
    LogRecord end = record(LogEvent::end, result.elapsed, last_);
    end.end = result.end;
    end.text = result.sentence;
    log_->write(end);
    return result;
}

} // namespace millwright::jobs::internal
