#include "core/plan/stock_work.h"

#include "core/plan/internal/background.h"
#include "core/plan/internal/failure.h"

#include <mutex>
#include <utility>

namespace millwright::plan {

/// Three threads: what was found last can be looked at along the timeline while the next one is worked out.
class StockWorker::Worker {
public:
    explicit Worker(std::function<void()> wake)
        : wake_(std::move(wake)), forecasting_(wake_), drawing_(wake_), simulating_(wake_) {}

    void request(StockJob job) {
        requested_ = job.program;
        {
            const std::scoped_lock lock(mutex_);
            view_.failure.reset();
        }
        simulating_.replace([this, job = std::move(job)](const Progress& progress) {
            std::shared_ptr<StockSimulation> made;
            const std::optional<Diagnostic> failure =
                failure_of([&] { made = std::make_shared<StockSimulation>(job, progress); });
            progress.check();
            const std::scoped_lock lock(mutex_);
            view_.failure = failure;
            if (made) {
                view_.result = made->result();
                view_.picture = nullptr;
                view_.picture_failure.reset();
                simulation_ = std::move(made);
                wanted_.reset();
            }
        });
    }
    void cancel() { simulating_.clear(); }

    void release() {
        std::shared_ptr<StockSimulation> simulation; // its memory is given back outside of the lock
        std::shared_ptr<const StockPicture> picture;
        const std::scoped_lock lock(mutex_);
        simulation.swap(simulation_);
        picture.swap(view_.picture);
        wanted_.reset();
    }

    void show(int block) {
        {
            const std::scoped_lock lock(mutex_);
            if (!simulation_ || wanted_ == block) {
                return;
            }
            wanted_ = block;
            if (std::exchange(waits_, true)) {
                return; // what waits takes the newest block
            }
        }
        drawing_.append([this](const Progress& progress) { draw(progress); });
    }

    void forecast(std::shared_ptr<const geometry::Surface> surface, StockSettings settings) {
        forecasting_.replace(
            [this, surface = std::move(surface), settings = std::move(settings)](const Progress& progress) {
                std::optional<StockForecast> found;
                // The field that has the stock's text says what is wrong with it.
                (void)failure_of([&] { found = forecast_of(surface.get(), settings, progress); });
                progress.check();
                const std::scoped_lock lock(mutex_);
                view_.forecast = std::move(found);
            });
    }

    [[nodiscard]] std::shared_ptr<const program::Program> requested() const { return requested_; }
    [[nodiscard]] StockView view() const {
        const std::scoped_lock lock(mutex_);
        return view_;
    }
    [[nodiscard]] Activity activity() const { return simulating_.activity(); }
    void wait_idle() const {
        simulating_.wait_idle();
        drawing_.wait_idle();
        forecasting_.wait_idle();
    }

private:
    void draw(const Progress& progress) {
        std::shared_ptr<StockSimulation> simulation;
        int block = 0;
        {
            const std::scoped_lock lock(mutex_);
            waits_ = false;
            simulation = simulation_;
            block = wanted_.value_or(0);
        }
        if (!simulation) { // released since
            return;
        }
        std::shared_ptr<const StockPicture> picture;
        const std::optional<Diagnostic> failure = failure_of([&] {
            picture = std::make_shared<const StockPicture>(simulation->picture_before(block, progress));
        });
        const std::scoped_lock lock(mutex_);
        if (simulation == simulation_) { // else it is of an earlier one
            view_.picture_failure = failure;
            view_.picture = picture ? std::move(picture) : view_.picture;
        }
    }

    std::function<void()> wake_;
    std::shared_ptr<const program::Program> requested_; ///< of the owner's thread
    mutable std::mutex mutex_;                          ///< guards what follows
    StockView view_;
    std::shared_ptr<StockSimulation> simulation_;   ///< used by the thread that draws
    std::optional<int> wanted_;                     ///< the block that a picture was last asked for
    bool waits_ = false;                            ///< a job for it has not begun yet
    Background forecasting_, drawing_, simulating_; // last: their threads end before the rest goes
};

StockWorker::StockWorker(std::function<void()> wake) : worker_(std::make_unique<Worker>(std::move(wake))) {}

StockWorker::~StockWorker() = default;

void StockWorker::request(StockJob job) {
    worker_->request(std::move(job));
}

void StockWorker::cancel() {
    worker_->cancel();
}

void StockWorker::release() {
    worker_->release();
}

void StockWorker::show(int block) {
    worker_->show(block);
}

void StockWorker::forecast(std::shared_ptr<const geometry::Surface> surface, StockSettings settings) {
    worker_->forecast(std::move(surface), std::move(settings));
}

std::shared_ptr<const program::Program> StockWorker::requested() const {
    return worker_->requested();
}

StockView StockWorker::view() const {
    return worker_->view();
}

Activity StockWorker::activity() const {
    return worker_->activity();
}

void StockWorker::wait_idle() const {
    worker_->wait_idle();
}

} // namespace millwright::plan
