#include "core/plan/internal/derivation.h"

#include "core/plan/internal/failure.h"

#include <algorithm>
#include <utility>

namespace millwright::plan {

void Derivation::derive(const project::Project& project,
                        const Folders& folders,
                        const Scope& scope,
                        const Publish& publish,
                        const Progress& progress) {
    try {
        begin(project, folders, scope);
        if (find({StageKind::program})->made != 0 && !all_exact()) {
            publish_now(publish, std::nullopt); // that there will be more
        }
        run(Quality::carried, publish, progress.part(0.0, 0.05));
        run(Quality::coarse, publish, progress.part(0.05, 0.2));
        run(Quality::exact, publish, progress.part(0.2, 1.0));
        publish_now(publish, first_failure());
    } catch (const Error& error) {
        publish_now(publish, error.diagnostic());
    }
}

Plan Derivation::finish(const project::Project& project,
                        const Folders& folders,
                        const Scope& scope,
                        const Progress& progress) {
    begin(project, folders, scope);
    run(Quality::exact, {}, progress);
    return plan_;
}

void Derivation::begin(const project::Project& project, const Folders& folders, const Scope& scope) {
    keep_earlier_grids();
    const std::optional<Source> before = std::exchange(source_, source_of(project, folders));
    const std::vector<Entry> last = std::exchange(entries_, {});
    for (Stage& stage : stages_of_(project, scope)) {
        entries_.push_back({std::move(stage)});
    }
    for (GridResult& grid : plan_.grids) {
        grid.failure.reset();
    }
    take_over(last, before);
}

void Derivation::keep_earlier_grids() {
    for (std::size_t n = 0; n < earlier_.size(); ++n) {
        if (const auto& grid = plan_.grids[n].evaluation) {
            earlier_[n] = grid;
        }
    }
}

/// What holds of the results of `last`, which were made from `source`; the others leave the plan.
void Derivation::take_over(const std::vector<Entry>& last, const std::optional<Source>& source) {
    const auto result_of = [&](const StageKey& key) {
        return std::ranges::find(last, key, [](const Entry& entry) { return entry.stage.key; });
    };
    for (const Entry& entry : last) {
        if (!find(entry.stage.key)) {
            entry.stage.clear(plan_);
        }
    }
    for (Entry& entry : entries_) {
        const auto old = result_of(entry.stage.key);
        const bool holds = source && old != last.end() && old->made != 0 && old->quality == Quality::exact &&
                           old->read == numbers_read(entry.stage) && entry.stage.same(*source, *source_);
        if (holds) {
            entry.made = old->made;
            entry.read = old->read;
        } else {
            entry.stage.clear(plan_);
        }
    }
}

void Derivation::run(Quality quality, const Publish& publish, const Progress& progress) {
    const double work = work_left(quality);
    double done = 0.0;
    for (std::size_t n = 0; n < entries_.size(); ++n) {
        if (!is_due(entries_[n], quality)) {
            continue;
        }
        const double from = work > 0.0 ? std::min(done / work, 1.0) : 0.0;
        done += entries_[n].stage.share;
        make(n, quality, progress.part(from, work > 0.0 ? std::min(done / work, 1.0) : 0.0));
        if (entries_[n].stage.shown_early == quality) {
            publish_changes(publish);
        }
    }
    if (quality != Quality::exact) {
        publish_changes(publish);
    }
}

/// A fault of a compared grid is its own. What is made coarsely, or of something coarse, is only a help
/// meanwhile, and so is its fault: if the exact result has it, too, it is found there.
void Derivation::make(std::size_t n, Quality quality, const Progress& progress) {
    Entry& entry = entries_[n];
    if (const auto owner = entry.stage.fault_of) {
        const auto failure = failure_of([&] { make_result(entry, quality, progress); });
        if (failure && quality == Quality::exact) {
            plan_.grid(*owner).failure = failure;
            drop(entry);
            drop_stale();
        }
        return;
    }
    try {
        make_result(entry, quality, progress);
    } catch (const Error&) {
        if (quality == Quality::exact || !is_guess(entry)) {
            throw;
        }
    }
}

void Derivation::make_result(Entry& entry, Quality quality, const Progress& progress) {
    progress.check();
    const auto is_missing = [&](const StageKey& key) { return find(key)->made == 0; };
    if (quality == Quality::coarse && std::ranges::any_of(entry.stage.reads, is_missing)) {
        return; // it failed, or there is none before the exact one
    }
    const bool is_named = quality == Quality::exact || (quality == Quality::coarse && !entry.stage.fault_of);
    if (is_named && !entry.stage.title.empty()) {
        progress.report(0.0, entry.stage.title);
    }
    std::vector<std::uint64_t> read = numbers_read(entry.stage);
    const bool found = entry.stage.make({plan_, *source_, earlier_, quality, progress});
    if (!found && quality != Quality::exact) {
        return;
    }
    entry.made = ++count_;
    entry.quality = entry.stage.graded ? quality : Quality::exact;
    entry.read = std::move(read);
    published_ = published_ && !(entry.stage.share > 0.0);
    drop_stale();
}

void Derivation::drop_stale() {
    for (Entry& entry : entries_) {
        const bool is_shown = entry.stage.stays && entry.quality != Quality::exact;
        if (entry.made != 0 && is_stale(entry) && !is_shown) {
            drop(entry);
        }
    }
}

void Derivation::drop(Entry& entry) {
    entry.made = 0;
    entry.stage.clear(plan_);
}

void Derivation::publish_changes(const Publish& publish) {
    if (publish && !published_) {
        publish_now(publish, std::nullopt);
    }
}

void Derivation::publish_now(const Publish& publish, std::optional<Diagnostic> failure) {
    published_ = true;
    const Entry& program = *find({StageKind::program});
    const Entry& cut = *find({StageKind::cut});
    const bool program_exact = is_exact(program) && (!cut.stage.asked || is_exact(cut));
    const bool exact = !failure && all_exact();
    publish({plan_, std::move(failure), program_exact, exact});
}

const Derivation::Entry* Derivation::find(const StageKey& key) const {
    const auto found = std::ranges::find(entries_, key, [](const Entry& entry) { return entry.stage.key; });
    return found == entries_.end() ? nullptr : &*found;
}

std::vector<std::uint64_t> Derivation::numbers_read(const Stage& stage) const {
    std::vector<std::uint64_t> numbers;
    for (const StageKey& key : stage.reads) {
        const Entry* entry = find(key);
        expects(entry != nullptr, "a stage reads what another one makes");
        numbers.push_back(entry->made);
    }
    return numbers;
}

bool Derivation::is_stale(const Entry& entry) const {
    return entry.read != numbers_read(entry.stage);
}

bool Derivation::is_wanted(const Entry& entry, Quality quality) const {
    const Stage& stage = entry.stage;
    const bool failed = stage.fault_of && plan_.grid(*stage.fault_of).failure;
    return stage.asked && !failed && std::ranges::count(stage.qualities, quality) > 0;
}

bool Derivation::is_due(const Entry& entry, Quality quality) const {
    return is_wanted(entry, quality) && (entry.made == 0 || (entry.stage.graded && entry.quality < quality));
}

bool Derivation::is_exact(const Entry& entry) const {
    return entry.made != 0 && entry.quality == Quality::exact &&
           std::ranges::all_of(entry.stage.reads, [&](const StageKey& key) {
               const Entry& read = *find(key);
               return read.made == 0 || is_exact(read);
           });
}

/// Made before its exact result, it may differ from that.
bool Derivation::is_guess(const Entry& entry) const {
    return entry.stage.graded ||
           std::ranges::any_of(entry.stage.reads, [&](const StageKey& key) { return !is_exact(*find(key)); });
}

bool Derivation::all_exact() const {
    return std::ranges::all_of(entries_,
                               [&](const Entry& entry) { return !entry.stage.asked || is_exact(entry); });
}

/// Of the stages that are due, and of those that read what they make.
double Derivation::work_left(Quality quality) const {
    double work = 0.0;
    std::vector<StageKey> made;
    for (const Entry& entry : entries_) {
        const auto again = [&](const StageKey& key) { return std::ranges::count(made, key) > 0; };
        const bool follows = is_wanted(entry, quality) && std::ranges::any_of(entry.stage.reads, again);
        if (follows || is_due(entry, quality)) {
            made.push_back(entry.stage.key);
            work += entry.stage.share;
        }
    }
    return work;
}

std::optional<Diagnostic> Derivation::first_failure() const {
    const auto failed =
        std::ranges::find_if(plan_.grids, [](const GridResult& grid) { return grid.failure.has_value(); });
    return failed == plan_.grids.end() ? std::nullopt : failed->failure;
}

} // namespace millwright::plan
