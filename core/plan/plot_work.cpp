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
        : assets_(std::move(assets)), wake_(std::move(wake)), background_(wake_) {}
    Worker(const Worker&) = delete;
    Worker& operator=(const Worker&) = delete;
    ~Worker() = default;

    void request(PlotResult start) {
        background_.replace(
            [this, start = std::move(start)](const Progress& progress) mutable { derive(start, progress); });
    }
    void request_program() {
        background_.append([this](const Progress& progress) { derive_program(progress); });
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

    void derive(PlotResult& now, const Progress& progress) {
        PlotDerivation(now, assets_, progress).run([&] { publish(now, progress); });
    }

    void derive_program(const Progress& progress) {
        const auto before = latest();
        if (!before || !before->finished || before->failure || before->program) {
            return;
        }
        PlotResult now = *before;
        PlotDerivation(now, assets_, progress).run_program([&] { publish(now, progress); });
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

    fs::path assets_;
    std::function<void()> wake_;
    Published<PlotResult> published_;
    Background background_; // last: its thread ends before the rest goes
};

PlotWorker::PlotWorker(fs::path assets, std::function<void()> wake)
    : worker_(std::make_unique<Worker>(std::move(assets), std::move(wake))) {}

PlotWorker::~PlotWorker() = default;

std::uint64_t PlotWorker::request(const project::PlotInput& input) {
    PlotResult start;
    start.request = ++requests_;
    start.input = input;
    if (const auto before = latest(); before && before->input.file == input.file) {
        start.program = before->program; // can be played until the new one is there
        start.opened = before->opened && before->opened->finished ? before->opened : nullptr;
    }
    worker_->request(std::move(start));
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
