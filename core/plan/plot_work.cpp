#include "core/plan/plot_work.h"

#include "core/base/files.h"
#include "core/plan/internal/background.h"
#include "core/plan/internal/failure.h"
#include "core/plan/internal/plot_derivation.h"
#include "core/plan/internal/posted_plot.h"

#include <cstdlib>
#include <mutex>
#include <system_error>
#include <utility>

namespace millwright::plan {

namespace fs = std::filesystem;

std::string plot_program_text(const PlotResult& result, const fs::path& assets) {
    expects(result.path != nullptr, "there is a path to write");
    return posted_plot(result, *result.path, assets).released.listing.text;
}

class PlotWorker::Worker {
public:
    Worker(fs::path assets, std::function<void()> wake)
        : assets_(std::move(assets)), wake_(std::move(wake)), background_(wake_) {}
    Worker(const Worker&) = delete;
    Worker& operator=(const Worker&) = delete;
    ~Worker() {
        background_.clear();
        background_.wait_idle();
        std::error_code ignored;
        if (!folder_.empty()) {
            fs::remove_all(folder_, ignored);
        }
    }

    void request(PlotResult start) {
        background_.replace(
            [this, start = std::move(start)](const Progress& progress) mutable { derive(start, progress); });
    }
    void request_program() {
        background_.append([this](const Progress& progress) { derive_program(progress); });
    }
    void cancel() { background_.clear(); }

    [[nodiscard]] std::shared_ptr<const PlotResult> latest() const {
        const std::scoped_lock lock(mutex_);
        return latest_;
    }
    [[nodiscard]] Activity activity() const { return background_.activity(); }
    void wait_idle() const { background_.wait_idle(); }

private:
    void publish(const PlotResult& now) {
        auto copy = std::make_shared<PlotResult>(now);
        {
            const std::scoped_lock lock(mutex_);
            copy->revision = ++revision_;
            latest_ = std::move(copy);
        }
        wake_();
    }

    /// For the programs of this worker alone.
    void make_folder() {
        if (!folder_.empty()) {
            return;
        }
        std::error_code failure;
        std::string place = (fs::temp_directory_path(failure) / "millwright-plot-XXXXXX").string();
        if (failure || ::mkdtemp(place.data()) == nullptr) {
            throw Error("cannot create a folder for the program", place);
        }
        folder_ = place;
    }

    void derive(PlotResult& now, const Progress& progress) {
        progress.report(0.0, "Cutting " + now.input.file.filename().string());
        PlotDerivation derivation(now, assets_, progress);
        now.failure = failure_of([&] {
            derivation.make_path();
            publish(now);
            progress.check();
            derivation.make_look();
            derivation.check_speeds();
            publish(now);
            progress.check();
            if (derivation.wants_program()) {
                make_folder();
                derivation.make_program(folder_);
                derivation.time_as_drawn();
            } else {
                now.program.clear();
            }
        });
        if (now.failure) {
            now.program.clear();
        }
        progress.check(); // no longer needed: what is there stays
        now.finished = true;
        publish(now);
    }

    void derive_program(const Progress& progress) {
        const auto before = latest();
        if (!before || !before->finished || before->failure || !before->program.empty()) {
            return;
        }
        PlotResult now = *before;
        PlotDerivation derivation(now, assets_, progress);
        now.failure = failure_of([&] {
            make_folder();
            derivation.make_program(folder_);
        });
        progress.check();
        publish(now);
    }

    fs::path assets_;
    fs::path folder_; ///< of the worker's thread; empty before its first program
    std::function<void()> wake_;
    mutable std::mutex mutex_; ///< guards what follows
    std::shared_ptr<const PlotResult> latest_;
    std::uint64_t revision_ = 0;
    Background background_; // last: its thread ends before the rest goes
};

PlotWorker::PlotWorker(fs::path assets, std::function<void()> wake)
    : worker_(std::make_unique<Worker>(std::move(assets), std::move(wake))) {}

PlotWorker::~PlotWorker() = default;

void PlotWorker::request(const project::PlotInput& input) {
    PlotResult start;
    start.input = input;
    if (const auto before = latest(); before && before->input.file == input.file) {
        start.program = before->program; // can be played until the new one is there
    }
    worker_->request(std::move(start));
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
