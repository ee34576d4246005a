// The engine that runs the stages of a plan: what still holds is kept, what is stale is made.
#pragma once

#include "core/base/error.h"
#include "core/plan/internal/stages.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

namespace millwright::plan {

/// What there is of a plan by now.
struct Publication {
    const Plan& plan;
    std::optional<Diagnostic> failure; ///< why there will be no more, or what is wrong with a compared grid
    bool program_exact = false;        ///< the program, and what the cutter does on it, are as for a report
    bool exact = false;                ///< all that was asked for is there, and as for a report
};

/// Remembers the last plan. Used by one thread at a time.
class Derivation {
public:
    using Publish = std::function<void(const Publication&)>;
    using Stages = std::function<std::vector<Stage>(const project::Project& project, const Scope& scope)>;

    /// `stages`: as stages_of().
    explicit Derivation(Stages stages = stages_of) : stages_of_(std::move(stages)) {}

    /// Coarse results first, then exact ones. Publishes one or several times. Throws Cancelled only.
    void derive(const project::Project& project,
                const Folders& folders,
                const Scope& scope,
                const Publish& publish,
                const Progress& progress);

    /// Exact results alone. Throws Error or Cancelled.
    [[nodiscard]] Plan finish(const project::Project& project,
                              const Folders& folders,
                              const Scope& scope,
                              const Progress& progress);

private:
    /// A stage and its result.
    struct Entry {
        Stage stage;
        std::uint64_t made = 0; ///< numbers the result; 0: there is none
        Quality quality = Quality::exact;
        std::vector<std::uint64_t> read = {}; ///< numbers of the results that it was made from
    };

    void begin(const project::Project& project, const Folders& folders, const Scope& scope);
    void keep_earlier_grids();
    void take_over(const std::vector<Entry>& last, const std::optional<Source>& source);
    void run(Quality quality, const Publish& publish, const Progress& progress);
    void make(std::size_t n, Quality quality, const Progress& progress);
    void make_result(Entry& entry, Quality quality, const Progress& progress);
    void drop_stale();
    void drop(Entry& entry);
    void publish_changes(const Publish& publish);
    void publish_now(const Publish& publish, std::optional<Diagnostic> failure);

    [[nodiscard]] const Entry* find(const StageKey& key) const;
    [[nodiscard]] std::vector<std::uint64_t> numbers_read(const Stage& stage) const;
    [[nodiscard]] bool is_stale(const Entry& entry) const;
    [[nodiscard]] bool is_wanted(const Entry& entry, Quality quality) const;
    [[nodiscard]] bool is_due(const Entry& entry, Quality quality) const;
    [[nodiscard]] bool is_exact(const Entry& entry) const;
    [[nodiscard]] bool is_guess(const Entry& entry) const;
    [[nodiscard]] bool all_exact() const;
    [[nodiscard]] double work_left(Quality quality) const;
    [[nodiscard]] std::optional<Diagnostic> first_failure() const;

    Stages stages_of_;
    std::optional<Source> source_;
    Plan plan_;
    std::vector<Entry> entries_; ///< in the order of stages_of()
    EarlierGrids earlier_;
    std::uint64_t count_ = 0; ///< of results made so far
    bool published_ = true;   ///< nothing has changed since the last publication
};

} // namespace millwright::plan
