// The engine that runs the stages of a plot or a picture: what still holds is kept, what is stale is made.
#pragma once

#include "core/base/progress.h"
#include "core/plan/internal/plot_stages.h"
#include "core/plan/plot_work.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

namespace millwright::plan {

/// Remembers the last plot. Used by one thread at a time.
class PlotDerivation {
public:
    using Publish = std::function<void(const PlotResult&)>;

    explicit PlotDerivation(std::filesystem::path assets);

    /// Every stage whose result does not hold any more. `start` has the input, and a program that is shown
    /// until there is a new one. `publish` is called whenever there is more of the result to be looked at.
    /// What goes wrong is the result's failure. Throws Cancelled.
    void run(const PlotResult& start, const Publish& publish, const Progress& progress);
    /// Of a result that is there: its program and what follows from that, if it has none. As run().
    void run_program(const Publish& publish, const Progress& progress);
    /// The next run derives everything anew.
    void forget();

private:
    /// The result of a stage.
    struct Entry {
        std::uint64_t made = 0;               ///< numbers the result; 0: there is none
        std::vector<std::uint64_t> read = {}; ///< numbers of the results that it was made from
        std::vector<Diagnostic> notices = {};
    };

    void begin(const PlotResult& start);
    void run_due(const Publish& publish, const Progress& progress);
    void run_stages(const Publish& publish, const Progress& progress);
    void make(std::size_t n, const Publish& publish, const Progress& progress);
    void drop(std::size_t n);
    void drop_program();
    void gather_notices();
    [[nodiscard]] Entry& entry_of(PlotStageKind kind) { return entries_[static_cast<std::size_t>(kind)]; }
    [[nodiscard]] std::vector<std::uint64_t> numbers_read(const PlotStage& stage) const;
    [[nodiscard]] bool wants_program() const;
    [[nodiscard]] double work_left() const;

    std::filesystem::path assets_;
    std::optional<PlotSource> source_; ///< of the results that are there
    PlotResult result_;
    PlotParts parts_;
    std::vector<Entry> entries_; ///< by PlotStageKind
    std::uint64_t count_ = 0;    ///< of results made so far
    bool asked_for_ = false;     ///< a person asked for the program
};

} // namespace millwright::plan
