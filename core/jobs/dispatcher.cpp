#include "core/jobs/dispatcher.h"

#include "core/base/error.h"
#include "core/jobs/internal/position_estimate.h"
#include "core/jobs/internal/running_job.h"
#include "core/jobs/program_check.h"
#include "core/jobs/tool_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

namespace millwright::jobs {

namespace {

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

Dispatcher::Dispatcher(drivers::Driver& driver, Clock& clock, std::filesystem::path log_folder)
    : driver_(driver), clock_(clock), log_folder_(std::move(log_folder)) {}

Dispatcher::~Dispatcher() = default;

JobOutcome Dispatcher::run(const Job& asked, const Progress& progress, const Listener& listener) {
    const Turn turn(*this);
    throw_first_with_count(preflight(asked));
    driver_.connect();
    const drivers::Capabilities able = driver_.capabilities();
    const Job job = able.takes_text() ? for_axes_of(asked, able.axes) : asked;
    const drivers::DriverStatus before = driver_.status();
    expect_rest(before);
    check_position(job, before);
    expect_fit(job, able);
    internal::PathEstimate estimate;
    std::optional<drivers::ToolChanges> changes;
    internal::PositionEnvelope envelope = check(job, able, before, estimate, changes);
    constexpr double planning = 0.02; // of the progress
    std::shared_ptr<const motion::Trajectory> trajectory;
    if (job.program != nullptr && !job.points) {
        trajectory = std::make_shared<const motion::Trajectory>(motion::plan(
            *job.program, *job.machine, job.planner, progress.part(0.0, planning), before.position));
    }

    progress.check(); // before there is a log that would have no end
    JobLog log(log_folder_, job.name);
    log.write(start_of(job, trajectory.get(), able, before));
    progress.check();
    internal::RunningJob running({driver_, clock_, [this] { return take_requests(); }, [this] { stop(); }},
                                 job,
                                 log,
                                 trajectory,
                                 before,
                                 std::move(envelope),
                                 std::move(estimate));
    drivers::Work work{job.program, trajectory, job.listing, {}, job.points, std::move(changes)};
    if (able.program.piecewise) {
        work.ahead = running.ahead();
    }
    return to_the_end(running, std::move(work), progress.part(planning, 1.0), listener);
}

/// What goes wrong on our side brings the machine to rest, and is said in the log.
JobOutcome Dispatcher::to_the_end(internal::RunningJob& running,
                                  drivers::Work work,
                                  const Progress& progress,
                                  const Listener& listener) {
    try {
        driver_.start(std::move(work));
        return running.to_the_end(progress, listener);
    } catch (const JobLogError& failure) {
        bring_to_rest();
        throw Error(running.log_lost(failure.reason()));
    } catch (const std::exception& failure) {
        bring_to_rest();
        running.log_failure(failure.what());
        throw;
    } catch (...) { // cancelled, which is no std::exception
        bring_to_rest();
        running.log_failure("it was cancelled");
        throw;
    }
}

void Dispatcher::expect_rest(const drivers::DriverStatus& before) const {
    if (before.state != drivers::DriverState::idle && before.state != drivers::DriverState::stopped) {
        throw Error(fmt::format("the machine is {} and cannot start a job", drivers::in_words(before.state)),
                    {},
                    before.message);
    }
}

void Dispatcher::expect_fit(const Job& job, const drivers::Capabilities& able) const {
    if (job.program == nullptr && !able.takes_text()) {
        throw Error("the " + driver_.name() + " driver cannot run G-code that Millwright did not generate");
    }
    if ((job.points != nullptr) != able.takes_points()) {
        throw Error(fmt::format("the {} driver {}",
                                driver_.name(),
                                able.takes_points() ? "runs points only" : "cannot run points"));
    }
}

LogStart Dispatcher::start_of(const Job& job,
                              const motion::Trajectory* trajectory,
                              const drivers::Capabilities& able,
                              const drivers::DriverStatus& before) const {
    return {.job = job.name,
            .project = lasting_name(job.project),
            .machine = job.machine ? job.machine->name() : std::string(),
            .driver = driver_.name(),
            .program_hash = job.hash.empty() ? program_hash(job.listing->text) : job.hash,
            .started_at = job.started_at,
            .address = driver_.address(),
            .axes = job.program == nullptr ? able.axes : job.program->axes,
            .blocks = job.block_count(),
            .planned_time = internal::planned_time(job, trajectory),
            .options = job.options,
            .from_line = job.from_line,
            .position_confirmed = before.position_confirmed,
            .firmware = driver_.firmware(),
            .answers = able.reports.execution};
}

/// Whole programs count from stored offsets, and these from what the controller takes for its position; a
/// line in the middle is gone to by that in any case.
void Dispatcher::check_position(const Job& job, const drivers::DriverStatus& status) const {
    if (job.from_line > 1 && !status.position_known && !driver_.capabilities().reports.position) {
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

/// After something went wrong on our side. A machine that does not come to rest is cut off. What fails here
/// is no reason to leave the log without its end.
void Dispatcher::bring_to_rest() noexcept {
    constexpr double patience = 10.0; // s
    try {
        driver_.stop();
        for (double waited = 0.0; !internal::ended(driver_.status().state); waited += internal::poll_time) {
            if (waited > patience) {
                driver_.emergency_stop();
                return;
            }
            clock_.wait(internal::poll_time);
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

/// What a controller would have to find out by moving: read by its own rules, from its position. Throws what
/// is wrong with it; returns where it can lead.
internal::PositionEnvelope Dispatcher::check(const Job& job,
                                             const drivers::Capabilities& able,
                                             const drivers::DriverStatus& before,
                                             internal::PathEstimate& estimate,
                                             std::optional<drivers::ToolChanges>& changes) const {
    if (!able.takes_text() || !able.dialect) {
        return {};
    }
    const std::vector<drivers::StoredOffset> offsets = driver_.stored_offsets();
    ProgramCheck found = check_program(controller_text(job),
                                       job.project,
                                       {*able.dialect,
                                        able.axes,
                                        before.position,
                                        offsets,
                                        before.modes,
                                        able.mist,
                                        able.program.piecewise,
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

std::vector<internal::JobRequest> Dispatcher::take_requests() {
    const std::scoped_lock lock(mutex_);
    return std::exchange(requests_, {});
}

} // namespace millwright::jobs
