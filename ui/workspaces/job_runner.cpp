#include "ui/workspaces/job_runner.h"

#include "core/base/error.h"

#include <mutex>
#include <stop_token>
#include <thread>
#include <utility>

namespace millwright::actions {

/// One job with its machine, its thread and what is known of it.
class JobRunner::Run {
public:
    /// On `driver`, or without one on a virtual machine of its own.
    Run(jobs::Job job,
        std::shared_ptr<drivers::Driver> driver,
        double speed,
        const std::filesystem::path& log_folder,
        std::function<void()> wake,
        Ended ended)
        : job_(std::move(job)), wake_(std::move(wake)), ended_(std::move(ended)),
          own_(driver ? nullptr
                      : std::make_shared<drivers::VirtualMachine>(
                            job_.program->start, drivers::VirtualSpeed{speed}, clock_)),
          driver_(driver ? std::move(driver) : own_), dispatcher_(*driver_, clock_, log_folder) {
        view_.running = true;
        view_.name = job_.name;
        view_.project = job_.project;
        view_.listing = job_.listing;
        view_.from_line = job_.from_line;
        thread_ = std::jthread([this](const std::stop_token& stop) { work(stop); });
    }

    void hold() { dispatcher_.hold(); }
    void resume() { dispatcher_.resume(); }
    void stop() {
        call_off();
        dispatcher_.stop();
    }
    void emergency_stop() {
        driver_->emergency_stop();
        call_off();
    }
    void set_speed(double speed) {
        if (own_) {
            own_->set_speed(drivers::VirtualSpeed{speed});
        }
    }
    void set_overrides(const drivers::Overrides& wanted) { dispatcher_.set_overrides(wanted); }
    void set_single_block(bool on) { dispatcher_.set_single_block(on); }
    void wait() {
        if (thread_.joinable()) {
            thread_.join();
        }
    }

    void forget_failure() {
        const std::scoped_lock lock(mutex_);
        if (!view_.running) {
            view_.failure.reset();
        }
    }

    [[nodiscard]] JobView view() const {
        const std::scoped_lock lock(mutex_);
        return view_;
    }

private:
    /// Where nothing moves yet, the job does not begin: a stop reaches no driver that is not connected.
    void call_off() {
        if (driver_->status().activity == drivers::Activity::none) {
            thread_.request_stop();
        }
    }

    template <class Change> void publish(Change&& change) {
        {
            const std::scoped_lock lock(mutex_);
            change(view_);
        }
        wake_();
    }

    void work(const std::stop_token& stop) {
        try {
            const jobs::JobOutcome outcome =
                dispatcher_.run(job_, Progress(nullptr, stop), [this](const jobs::JobReport& report) {
                    publish([&](JobView& view) { view.report = report; });
                });
            publish([&](JobView& view) { view.outcome = outcome; });
            tell_end({outcome, {}});
        } catch (const Cancelled&) {
            const Diagnostic stopped{{}, "the job was stopped before it began", {}};
            publish([&](JobView& view) { view.failure = stopped; });
            tell_end({std::nullopt, stopped.message});
        } catch (const Error& error) {
            publish([&](JobView& view) { view.failure = error.diagnostic(); });
            tell_end({std::nullopt, error.what()});
        } catch (const std::exception& defect) {
            publish([&](JobView& view) { view.failure = Diagnostic{{}, defect.what(), {}}; });
            tell_end({std::nullopt, defect.what()});
        }
        if (own_) {
            own_->close();
        }
        publish([](JobView& view) { view.running = false; });
    }

    void tell_end(const JobEnding& ending) const {
        if (ended_) {
            ended_(ending);
        }
    }

    jobs::Job job_;
    std::function<void()> wake_;
    Ended ended_;
    SteadyClock clock_;
    std::shared_ptr<drivers::VirtualMachine> own_; ///< null on a connected machine
    std::shared_ptr<drivers::Driver> driver_;
    jobs::Dispatcher dispatcher_;
    mutable std::mutex mutex_;
    JobView view_;
    std::jthread thread_; // last: it is joined before what it uses goes
};

JobRunner::JobRunner(std::filesystem::path log_folder, std::function<void()> wake)
    : log_folder_(std::move(log_folder)), wake_(std::move(wake)) {}

JobRunner::~JobRunner() = default;

void JobRunner::start(jobs::Job job, double speed, Ended ended) {
    start(std::move(job), nullptr, speed, std::move(ended));
}

void JobRunner::start(jobs::Job job, std::shared_ptr<drivers::Driver> driver, Ended ended) {
    start(std::move(job), std::move(driver), 1.0, std::move(ended));
}

void JobRunner::start(jobs::Job job, std::shared_ptr<drivers::Driver> driver, double speed, Ended ended) {
    expects(!view().running, "one job at a time");
    run_.reset();
    run_ =
        std::make_unique<Run>(std::move(job), std::move(driver), speed, log_folder_, wake_, std::move(ended));
}

void JobRunner::hold() {
    if (run_) {
        run_->hold();
    }
}

void JobRunner::resume() {
    if (run_) {
        run_->resume();
    }
}

void JobRunner::stop() {
    if (run_) {
        run_->stop();
    }
}

void JobRunner::emergency_stop() {
    if (run_) {
        run_->emergency_stop();
    }
}

void JobRunner::set_speed(double speed) {
    if (run_) {
        run_->set_speed(speed);
    }
}

void JobRunner::set_overrides(const drivers::Overrides& wanted) {
    if (run_) {
        run_->set_overrides(wanted);
    }
}

void JobRunner::set_single_block(bool on) {
    if (run_) {
        run_->set_single_block(on);
    }
}

void JobRunner::forget_failure() {
    if (run_) {
        run_->forget_failure();
    }
}

JobView JobRunner::view() const {
    return run_ ? run_->view() : JobView{};
}

void JobRunner::wait() {
    if (run_) {
        run_->wait();
    }
}

} // namespace millwright::actions
