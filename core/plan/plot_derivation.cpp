#include "core/plan/internal/plot_derivation.h"

#include "core/plan/internal/failure.h"

#include <string>
#include <utility>

namespace millwright::plan {

PlotDerivation::PlotDerivation(std::filesystem::path assets)
    : assets_(std::move(assets)), entries_(plot_stages().size()) {}

void PlotDerivation::run(const PlotResult& start, const Publish& publish, const Progress& progress) {
    progress.report(0.0, "Cutting " + start.input.file.filename().string());
    begin(start);
    run_due(publish, progress);
}

void PlotDerivation::run_program(const Publish& publish, const Progress& progress) {
    if (!source_ || !result_.finished || result_.failure || entry_of(PlotStageKind::program).made != 0) {
        return;
    }
    asked_for_ = true;
    run_due(publish, progress);
}

void PlotDerivation::forget() {
    source_.reset();
}

/// Keeps the results that hold for the input of `start`; the others leave the result.
void PlotDerivation::begin(const PlotResult& start) {
    const std::optional<PlotSource> before = std::exchange(source_, plot_source_of(start.input, assets_));
    result_.input = start.input;
    result_.request = start.request;
    result_.failure.reset();
    result_.finished = false;
    asked_for_ = false;
    for (std::size_t n = 0; n < entries_.size(); ++n) {
        const PlotStage& stage = plot_stages()[n];
        const Entry& entry = entries_[n];
        const bool holds = before && entry.made != 0 && entry.read == numbers_read(stage) &&
                           (stage.same == nullptr || stage.same(*before, *source_));
        if (!holds) {
            drop(n);
        }
    }
    gather_notices();
    if (entry_of(PlotStageKind::program).made == 0) { // it can be played until the new one is there
        result_.program = start.program;
        result_.opened = start.opened;
    }
}

void PlotDerivation::run_due(const Publish& publish, const Progress& progress) {
    result_.failure = failure_of([&] { run_stages(publish, progress); });
    if (result_.failure) {
        drop_program();
    }
    if (result_.failure || !result_.finished) {
        progress.check(); // no longer needed: what is there stays
        result_.finished = true;
        publish(result_);
    }
}

void PlotDerivation::run_stages(const Publish& publish, const Progress& progress) {
    const double work = work_left();
    double done = 0.0;
    for (std::size_t n = 0; n < entries_.size(); ++n) {
        const PlotStage& stage = plot_stages()[n];
        const bool due = entries_[n].made == 0;
        if (due && stage.of_program && !wants_program()) {
            drop_program();
            return;
        }
        if (due) {
            const double from = work > 0.0 ? done / work : 0.0;
            done += stage.share;
            make(n, publish, progress.part(from, work > 0.0 ? done / work : 0.0));
        }
        result_.finished = result_.finished || stage.finishes;
        if (stage.finishes || (due && stage.shown)) {
            publish(result_);
        }
    }
}

void PlotDerivation::make(std::size_t n, const Publish& publish, const Progress& progress) {
    const PlotStage& stage = plot_stages()[n];
    Entry& entry = entries_[n];
    entry.notices.clear();
    progress.check();
    progress.report(0.0, std::string(stage.title));
    const std::function<void()> show = [&] { publish(result_); };
    stage.make({result_, parts_, entry.notices, assets_, progress, show});
    progress.check(); // no longer needed: what is there stays
    entry.made = ++count_;
    entry.read = numbers_read(stage);
    gather_notices();
}

void PlotDerivation::drop(std::size_t n) {
    entries_[n] = {};
    plot_stages()[n].clear(result_, parts_);
}

void PlotDerivation::drop_program() {
    for (std::size_t n = 0; n < entries_.size(); ++n) {
        if (plot_stages()[n].of_program) {
            drop(n);
        }
    }
    gather_notices();
}

void PlotDerivation::gather_notices() {
    result_.notices.clear();
    for (const Entry& entry : entries_) {
        result_.notices.insert(result_.notices.end(), entry.notices.begin(), entry.notices.end());
    }
}

std::vector<std::uint64_t> PlotDerivation::numbers_read(const PlotStage& stage) const {
    std::vector<std::uint64_t> numbers;
    for (const PlotStageKind kind : stage.reads) {
        numbers.push_back(entries_[static_cast<std::size_t>(kind)].made);
    }
    return numbers;
}

bool PlotDerivation::wants_program() const {
    return asked_for_ || entries_[static_cast<std::size_t>(PlotStageKind::program)].made != 0 ||
           result_.path->size() <= most_points_at_once;
}

double PlotDerivation::work_left() const {
    double work = 0.0;
    for (std::size_t n = 0; n < entries_.size(); ++n) {
        work += entries_[n].made == 0 ? plot_stages()[n].share : 0.0;
    }
    return work;
}

} // namespace millwright::plan
