#include "core/jobs/dispatcher.h"

#include "core/base/error.h"
#include "core/base/sentences.h"
#include "core/jobs/internal/end_sentence.h"
#include "core/jobs/internal/path_estimate.h"
#include "core/jobs/internal/reach.h"
#include "core/jobs/internal/shared_log.h"
#include "core/jobs/survey.h"
#include "core/jobs/tool_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

namespace millwright::jobs {

namespace {

constexpr double poll_time = 0.02; // s: a fifth of what a person notices

/// Throws what is wrong first, and says how much else there is.
void throw_first_with_count(std::vector<Diagnostic> faults) {
    if (faults.empty()) {
        return;
    }
    if (faults.size() > 1) {
        faults.front().message += fmt::format("; and {} more", faults.size() - 1);
    }
    throw Error(std::move(faults.front()));
}

bool ended(drivers::DriverState state) {
    return state == drivers::DriverState::idle || state == drivers::DriverState::stopped ||
           state == drivers::DriverState::alarm || state == drivers::DriverState::disconnected;
}

double planned_time(const Job& job, const motion::Trajectory* trajectory) {
    return trajectory != nullptr ? trajectory->duration() : job.points ? job.points->duration() : 0.0;
}

} // namespace

/// One job at a time.
class Dispatcher::Turn {
public:
    explicit Turn(Dispatcher& dispatcher) : dispatcher_(dispatcher) {
        const std::scoped_lock lock(dispatcher_.mutex_);
        if (dispatcher_.running_) {
            throw Error("a job is already running", {}, "stop it, or wait until it ends");
        }
        dispatcher_.running_ = true;
        dispatcher_.requests_.clear();
    }
    Turn(const Turn&) = delete;
    Turn& operator=(const Turn&) = delete;
    ~Turn() {
        const std::scoped_lock lock(dispatcher_.mutex_);
        dispatcher_.running_ = false;
    }

private:
    Dispatcher& dispatcher_;
};

/// A job on its way: what has been seen of it, and its log.
class Dispatcher::Watch {
public:
    /// `trajectory`: null where the controller alone plans.
    Watch(Dispatcher& dispatcher,
          const Job& job,
          JobLog& log,
          std::shared_ptr<const motion::Trajectory> trajectory,
          drivers::DriverStatus before,
          internal::Reach reach,
          internal::PathEstimate estimate)
        : dispatcher_(dispatcher), job_(job), file_(log.file()), trajectory_(std::move(trajectory)),
          reach_(std::move(reach)), estimate_(std::move(estimate)), able_(dispatcher.driver_.capabilities()),
          start_(dispatcher.clock_.now()), last_(std::move(before)), doubt_before_(last_.position_doubt) {
        last_.own_lines.clear();
        last_.executed_blocks = last_.sent_blocks = 0; // those are of the program before
        last_.block = -1;
        log_ = std::make_shared<internal::SharedLog>(
            log, dispatcher.clock_, start_, blocks(), record(LogEvent::executed, 0.0, last_));
    }

    Watch(const Watch&) = delete;
    Watch& operator=(const Watch&) = delete;
    ~Watch() { log_->close(); }

    /// For a piecewise driver, which may keep it longer than this lives: what a log does not allow has not
    /// been sent.
    [[nodiscard]] std::function<int(int)> ahead() const {
        return [log = log_](int wanted) { return log->allow(wanted); };
    }

    JobOutcome to_the_end(const Progress& progress, const Listener& listener) {
        while (true) {
            if (progress.cancelled() && !std::exchange(cancelled_, true)) {
                dispatcher_.stop();
            }
            const drivers::DriverStatus status = dispatcher_.driver_.status();
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
            dispatcher_.clock_.wait(poll_time);
        }
    }

    /// The last line of a job that ends by our own failure, if it still can be written.
    void log_failure(const std::string& why) noexcept {
        try {
            remember(dispatcher_.driver_.status());
            write_end(with_full_stop("The job was aborted: " + why));
        } catch (const std::exception&) {
            // The failure itself is on its way to the user, and a log without an end promises nothing.
        }
    }

    /// The same for a log that took no more lines; what there is to say of it. The machine is at rest.
    [[nodiscard]] Diagnostic log_lost(const std::string& reason) {
        remember(dispatcher_.driver_.status());
        const std::string why =
            internal::log_lost_sentence(last_, blocks(), "its log cannot be written: " + reason);
        const std::string done = internal::done_text(last_.executed_blocks, blocks(), able_.answers);
        try {
            LogRecord fault = record(LogEvent::fault, elapsed(), last_);
            fault.text = why;
            log_->write(fault);
            write_end(with_clause(capitalised(why), done + "."));
        } catch (const std::exception&) {
            // The last line that it has stays right.
        }
        return {
            {file_}, with_clause(why, done), "inspect the machine, and free disk space before the next job"};
    }

private:
    Dispatcher& dispatcher_;
    const Job& job_;
    std::filesystem::path file_; ///< of the log
    std::shared_ptr<const motion::Trajectory> trajectory_;
    internal::Reach reach_;
    internal::PathEstimate estimate_;
    std::string beyond_; ///< what was seen of a machine that left the reach; empty: nothing
    drivers::Capabilities able_;
    double start_ = 0.0;
    drivers::DriverStatus
        last_; ///< with the last known position where the link is gone, or the position is lost
    std::string doubt_before_;
    std::shared_ptr<internal::SharedLog> log_;
    int logged_blocks_ = 0;
    std::size_t own_lines_ = 0; ///< that are in the log
    bool cancelled_ = false;
    std::string waits_for_; ///< a person, and why; empty: for nobody

    void write_end(std::string text) {
        LogRecord end = record(LogEvent::end, elapsed(), last_);
        end.end = JobEnd::fault;
        end.text = std::move(text);
        log_->write(end);
    }

    [[nodiscard]] double elapsed() const { return dispatcher_.clock_.now() - start_; }
    [[nodiscard]] int blocks() const { return job_.block_count(); }

    void remember(const drivers::DriverStatus& status) {
        if (status.state != drivers::DriverState::disconnected) {
            const drivers::DriverStatus before = std::exchange(last_, status);
            estimate_place(status);
            last_.planned_time = able_.plans ? time_of_place() : last_.planned_time;
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
    void estimate_place(const drivers::DriverStatus& status) {
        const auto& lines = job_.listing->line_of_block;
        const int sent = std::min(status.sent_blocks, static_cast<int>(std::ssize(lines)));
        const int executed = std::clamp(status.executed_blocks, 0, sent);
        if (!estimate_.knows_path() || executed >= sent || status.position.size() < 3) {
            return;
        }
        const internal::PathPlace place = estimate_.place_at(status.position.head<3>(),
                                                             lines[static_cast<std::size_t>(executed)],
                                                             lines[static_cast<std::size_t>(sent - 1)]);
        if (const int block = job_.listing->block_at_line(place.line); block >= status.block) {
            last_.block = block;
            last_.fraction = place.fraction;
        }
    }

    [[nodiscard]] double planned() const { return planned_time(job_, trajectory_.get()); }

    /// How far a controller that follows its own plan would be in ours, as far as its place is known.
    [[nodiscard]] double time_of_place() const {
        const int block = std::max({0, last_.executed_blocks, last_.block});
        if (!trajectory_ || last_.executed_blocks >= blocks() || block >= trajectory_->block_count()) {
            return planned();
        }
        return trajectory_->time_at(block, block == last_.block ? last_.fraction : 0.0);
    }

    [[nodiscard]] LogRecord record(LogEvent event, double time, const drivers::DriverStatus& status) const {
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
    void watch_reach(const drivers::DriverStatus& status) {
        if (!beyond_.empty()) {
            return;
        }
        beyond_ = reach_.watch(status, dispatcher_.clock_.now());
        if (!beyond_.empty()) {
            dispatcher_.driver_.break_off(beyond_);
            last_.message = beyond_;
        }
    }

    void write_requests() {
        for (const Request& request : dispatcher_.take_requests()) {
            const double time = std::max(0.0, request.clock_time - start_);
            if (request.status.state != drivers::DriverState::disconnected) {
                LogRecord line = record(request.event, time, request.status);
                line.text = request.text;
                log_->write(line);
                logged_blocks_ = std::max(logged_blocks_, request.status.executed_blocks);
            }
        }
    }

    void write_executed() {
        if (last_.executed_blocks > logged_blocks_) {
            logged_blocks_ = last_.executed_blocks;
            log_->write(record(able_.answers ? LogEvent::executed : LogEvent::sent, elapsed(), last_));
        }
    }

    /// What was sent besides the program, as such.
    void write_own_lines() {
        for (; own_lines_ < std::size(last_.own_lines); ++own_lines_) {
            LogRecord line = record(LogEvent::own, elapsed(), last_);
            line.text = last_.own_lines[own_lines_];
            log_->write(line);
        }
    }

    /// Once for each time that the machine begins to wait by itself.
    void write_waiting() {
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

    void tell(const Progress& progress, const Listener& listener) const {
        const JobReport report{last_, blocks(), elapsed(), planned(), able_.answers, line_of(last_.block)};
        progress.report(report.fraction(), report.progress_text());
        if (listener) {
            listener(report);
        }
    }

    [[nodiscard]] int line_of(int block) const {
        const auto& lines = job_.listing->line_of_block;
        return block >= 0 && block < std::ssize(lines) ? lines[static_cast<std::size_t>(block)] : 0;
    }

    [[nodiscard]] JobEnd end_of(const drivers::DriverStatus& status) const {
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

    JobOutcome outcome(const drivers::DriverStatus& status) {
        write_own_lines();
        write_requests(); // one that came between the last look at them and the end
        last_.message = beyond_.empty() ? last_.message : beyond_;
        JobOutcome result;
        result.end = end_of(status);
        result.executed_blocks = last_.executed_blocks;
        result.blocks = blocks();
        result.elapsed = elapsed();
        result.position = last_.position;
        result.sentence =
            internal::end_sentence(result.end, last_, result, line_of(last_.block), able_.answers);
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
};

Dispatcher::Dispatcher(drivers::Driver& driver, Clock& clock, std::filesystem::path log_folder)
    : driver_(driver), clock_(clock), log_folder_(std::move(log_folder)) {}

JobOutcome Dispatcher::run(const Job& asked, const Progress& progress, const Listener& listener) {
    const Turn turn(*this);
    throw_first_with_count(preflight(asked));
    driver_.connect();
    const drivers::Capabilities able = driver_.capabilities();
    const Job job = able.plans ? for_axes_of(asked, able.axes) : asked;
    const drivers::DriverStatus before = driver_.status();
    if (before.state != drivers::DriverState::idle && before.state != drivers::DriverState::stopped) {
        throw Error(fmt::format("the machine is {} and cannot start a job", drivers::in_words(before.state)),
                    {},
                    before.message);
    }
    check_position(job, before);
    constexpr double planning = 0.02; // of the progress
    const bool text_alone = job.program == nullptr;
    if (text_alone && !able.plans) {
        throw Error("the " + driver_.name() + " driver cannot run G-code that Millwright did not generate");
    }
    if ((job.points != nullptr) != able.points) {
        throw Error(fmt::format(
            "the {} driver {}", driver_.name(), able.points ? "runs points only" : "cannot run points"));
    }
    internal::PathEstimate estimate;
    std::optional<drivers::ToolChanges> changes;
    internal::Reach reach = check(job, able, before, estimate, changes);
    std::shared_ptr<const motion::Trajectory> trajectory;
    if (!text_alone && !job.points) {
        trajectory = std::make_shared<const motion::Trajectory>(motion::plan(
            *job.program, *job.machine, job.planner, progress.part(0.0, planning), before.position));
    }

    progress.check(); // before there is a log that would have no end
    JobLog log(log_folder_, job.name);
    log.write(LogStart{.job = job.name,
                       .project = lasting_name(job.project),
                       .machine = job.machine ? job.machine->name() : std::string(),
                       .driver = driver_.name(),
                       .program_hash = job.hash.empty() ? program_hash(job.listing->text) : job.hash,
                       .started_at = job.started_at,
                       .address = driver_.address(),
                       .axes = text_alone ? able.axes : job.program->axes,
                       .blocks = job.block_count(),
                       .planned_time = planned_time(job, trajectory.get()),
                       .options = job.options,
                       .from_line = job.from_line,
                       .position_confirmed = before.position_confirmed,
                       .firmware = driver_.firmware(),
                       .answers = able.answers});
    progress.check();
    Watch watch(*this, job, log, trajectory, before, std::move(reach), std::move(estimate));
    try {
        drivers::Work work{job.program, trajectory, job.listing, {}, job.points, std::move(changes)};
        if (able.piecewise) {
            work.ahead = watch.ahead();
        }
        driver_.start(std::move(work));
        return watch.to_the_end(progress.part(planning, 1.0), listener);
    } catch (const JobLogError& failure) {
        bring_to_rest();
        throw Error(watch.log_lost(failure.reason()));
    } catch (const std::exception& failure) {
        bring_to_rest();
        watch.log_failure(failure.what());
        throw;
    } catch (...) { // cancelled, which is no std::exception
        bring_to_rest();
        watch.log_failure("it was cancelled");
        throw;
    }
}

/// Whole programs count from stored offsets, and these from what the controller takes for its position; a
/// line in the middle is gone to by that in any case.
void Dispatcher::check_position(const Job& job, const drivers::DriverStatus& status) const {
    if (job.from_line > 1 && !status.position_known && driver_.capabilities().told_place) {
        throw Error(fmt::format("the machine does not report its position, and none was entered: line {} "
                                "could start at the wrong position",
                                job.from_line),
                    {},
                    "read the position at the machine and enter it");
    }
    if (job.from_line > 1 && !status.position_doubt.empty()) {
        throw Error(fmt::format("{} Line {} could start at the wrong position",
                                drivers::doubt_sentence(status.position_doubt),
                                job.from_line),
                    {},
                    "home the machine, set a new zero for every axis, or confirm the reported position");
    }
    if (drivers::needs_confirmation(status, driver_.stored_offsets())) {
        throw Error(drivers::doubt_sentence(status.position_doubt) + " Stored work offsets may be wrong",
                    {},
                    "home the machine, set a new zero for every axis, or confirm the reported position");
    }
}

/// After something went wrong on our side. A machine that does not come to rest by itself is cut off. What
/// fails here is no reason to leave the log without its end.
void Dispatcher::bring_to_rest() noexcept {
    constexpr double patience = 10.0; // s
    try {
        driver_.stop();
        for (double waited = 0.0; !ended(driver_.status().state); waited += poll_time) {
            if (waited > patience) {
                driver_.emergency_stop();
                return;
            }
            clock_.wait(poll_time);
        }
    } catch (const std::exception&) {
        // A link that takes no word any more is lost, and its status says so.
    }
}

void Dispatcher::hold() {
    const drivers::DriverStatus now = driver_.status();
    const bool waits = now.tool_change && now.tool_change->waits && !now.tool_change->held;
    if (now.state != drivers::DriverState::holding || waits) { // a second one is no event
        request(LogEvent::hold, {}, [this] { driver_.hold(); });
    }
}

void Dispatcher::resume() {
    if (driver_.status().state == drivers::DriverState::holding) {
        request(LogEvent::resume, {}, [this] { driver_.resume(); });
    }
}

void Dispatcher::stop() {
    request(LogEvent::stop, {}, [this] { driver_.stop(); });
}

void Dispatcher::set_overrides(const drivers::Overrides& wanted) {
    request(LogEvent::overrides,
            fmt::format("feed {} %, rapid {} %, spindle {} %", wanted.feed, wanted.rapid, wanted.spindle),
            [&] { driver_.set_overrides(wanted); });
}

void Dispatcher::set_single_block(bool on) {
    request(LogEvent::single_block, on ? "on" : "off", [&] { driver_.set_single_block(on); });
}

void Dispatcher::set_optional_stop(bool on) {
    request(LogEvent::optional_stop, on ? "on" : "off", [&] { driver_.set_optional_stop(on); });
}

/// What a controller would have to find out by moving: read by its own rules, from where it stands. Throws
/// what is wrong with it; returns where it can lead.
internal::Reach Dispatcher::check(const Job& job,
                                  const drivers::Capabilities& able,
                                  const drivers::DriverStatus& before,
                                  internal::PathEstimate& estimate,
                                  std::optional<drivers::ToolChanges>& changes) const {
    if (!able.plans || !able.dialect) {
        return {};
    }
    const std::vector<drivers::StoredOffset> offsets = driver_.stored_offsets();
    Survey found = survey(controller_text(job),
                          job.project,
                          {*able.dialect,
                           able.axes,
                           before.position,
                           offsets,
                           before.modes,
                           able.mist,
                           able.piecewise,
                           able.firmware,
                           watched_lines(job)});
    if (job.program == nullptr) { // else it was checked block by block
        throw_first_with_count(faults_of(found, driver_.limits(), job.project));
    }
    const drivers::MachineLimits limits = driver_.limits();
    throw_first_with_count(tool_change_faults(job, found, able, {before, offsets, limits, able.laser}));
    if (job.tool_change) {
        changes = tool_changes(job, found);
    }
    if (before.position.size() >= 3) {
        estimate = {std::move(found.path), before.position.head<3>()};
    }
    return {found, able.axes, before, offsets};
}

void Dispatcher::request(LogEvent event, std::string text, const std::function<void()>& command) {
    const std::scoped_lock lock(mutex_); // so that a job cannot end between the command and its note
    command();
    if (running_) {
        requests_.push_back({event, clock_.now(), driver_.status(), std::move(text)});
    }
}

std::vector<Dispatcher::Request> Dispatcher::take_requests() {
    const std::scoped_lock lock(mutex_);
    return std::exchange(requests_, {});
}

} // namespace millwright::jobs
