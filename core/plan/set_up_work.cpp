#include "core/plan/set_up_work.h"

#include "core/base/published.h"
#include "core/plan/internal/background.h"
#include "core/plan/internal/failure.h"
#include "core/project/surface.h"

#include <utility>

namespace millwright::plan {

class SetUpWorker::Worker {
public:
    explicit Worker(std::function<void()> wake) : wake_(std::move(wake)), background_(wake_) {}

    void
    request(const project::Project& project, const Folders& folders, const SetUpStudySettings& settings) {
        background_.replace([=, this](const Progress& progress) {
            SetUpResult found;
            found.project = project;
            found.settings = settings;
            found.failure = failure_of([&] {
                progress.report(0.0, "Searching for the best part position");
                const CuttingSetup cutting_setup =
                    cutting_setup_of(project, folders, project::machined_region(project.surface, progress));
                found.now = set_up_cost(cutting_setup, settings).start();
                found.study = set_up_study(cutting_setup, settings, progress);
            });
            publish(std::move(found));
        });
    }
    void cancel() { background_.clear(); }

    [[nodiscard]] std::shared_ptr<const SetUpResult> latest() const { return published_.latest(); }
    [[nodiscard]] Activity activity() const { return background_.activity(); }
    void wait_idle() const { background_.wait_idle(); }

private:
    void publish(SetUpResult found) {
        published_.publish(std::move(found));
        wake_();
    }

    std::function<void()> wake_;
    Published<SetUpResult> published_;
    Background background_; // last: its thread ends before the rest goes
};

SetUpWorker::SetUpWorker(std::function<void()> wake) : worker_(std::make_unique<Worker>(std::move(wake))) {}

SetUpWorker::~SetUpWorker() = default;

void SetUpWorker::request(const project::Project& project,
                          const Folders& folders,
                          const SetUpStudySettings& settings) {
    worker_->request(project, folders, settings);
}

void SetUpWorker::cancel() {
    worker_->cancel();
}

std::shared_ptr<const SetUpResult> SetUpWorker::latest() const {
    return worker_->latest();
}

Activity SetUpWorker::activity() const {
    return worker_->activity();
}

void SetUpWorker::wait_idle() const {
    worker_->wait_idle();
}

bool same_but_for_place(const project::Project& then, const project::Project& now) {
    project::MachineInput there = then.machine;
    there.workpiece_offset = now.machine.workpiece_offset;
    return then.surface == now.surface && there == now.machine && then.grid.direction == now.grid.direction;
}

} // namespace millwright::plan
