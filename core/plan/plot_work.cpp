#include "core/plan/plot_work.h"

#include "core/base/published.h"
#include "core/plan/internal/background.h"
#include "core/plan/internal/plot_derivation.h"

#include <utility>

namespace millwright::plan {

namespace fs = std::filesystem;

class PlotWorker::Worker {
public:
    Worker(fs::path assets, std::function<void()> wake)
        : wake_(std::move(wake)), derivation_(std::move(assets)), background_(wake_) {}
    Worker(const Worker&) = delete;
    Worker& operator=(const Worker&) = delete;
    ~Worker() = default;

    void request(PlotResult start, bool anew) {
        background_.replace([this, anew, start = std::move(start)](const Progress& progress) {
            if (anew) {
                derivation_.forget();
            }
            derivation_.run(
                start, [&](const PlotResult& now) { publish(now, progress); }, progress);
        });
    }
    void request_program() {
        background_.append([this](const Progress& progress) {
            derivation_.run_program([&](const PlotResult& now) { publish(now, progress); }, progress);
        });
    }
    void cancel() {
        background_.end_with([this](const Progress& progress) { end_reading(progress); });
    }

    [[nodiscard]] std::shared_ptr<const PlotResult> latest() const { return published_.latest(); }
    [[nodiscard]] Activity activity() const { return background_.activity(); }
    void wait_idle() const { background_.wait_idle(); }

private:
    void publish(const PlotResult& now, const Progress& progress) {
        published_.publish(now, progress);
        wake_();
    }

    /// A program whose motion was given up says so.
    void end_reading(const Progress& progress) {
        const auto before = latest();
        if (!before || !before->opened || before->opened->finished) {
            return;
        }
        PlotResult now = *before;
        auto opened = std::make_shared<OpenedProgram>(*before->opened);
        opened->cancelled = true;
        opened->finished = true;
        now.opened = std::move(opened);
        publish(now, progress);
    }

    std::function<void()> wake_;
    Published<PlotResult> published_;
    PlotDerivation derivation_; // for the thread alone
    Background background_;     // last: its thread ends before the rest goes
};

PlotWorker::PlotWorker(fs::path assets, std::function<void()> wake)
    : worker_(std::make_unique<Worker>(std::move(assets), std::move(wake))) {}

PlotWorker::~PlotWorker() = default;

std::uint64_t PlotWorker::request(const project::PlotInput& input) {
    return ask(input, false);
}

std::uint64_t PlotWorker::request_anew(const project::PlotInput& input) {
    return ask(input, true);
}

std::uint64_t PlotWorker::ask(const project::PlotInput& input, bool anew) {
    PlotResult start;
    start.request = ++requests_;
    start.input = input;
    if (const auto before = latest(); before && before->input.file == input.file) {
        start.program = before->program; // can be played until the new one is there
        start.opened = before->opened && before->opened->finished ? before->opened : nullptr;
    }
    worker_->request(std::move(start), anew);
    return requests_;
}

void PlotWorker::request_program() {
    worker_->request_program();
}

void PlotWorker::cancel() {
    worker_->cancel();
}

std::shared_ptr<const PlotResult> PlotWorker::latest() const {
    return worker_->latest();
}

Activity PlotWorker::activity() const {
    return worker_->activity();
}

void PlotWorker::wait_idle() const {
    worker_->wait_idle();
}

} // namespace millwright::plan
