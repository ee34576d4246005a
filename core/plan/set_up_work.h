// The search for the best place of the part on the table, in the background, with its map.
#pragma once

#include "core/base/error.h"
#include "core/plan/pipeline.h"
#include "core/plan/set_up_study.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>

namespace millwright::plan {

/// What a search found. Immutable once published.
struct SetUpResult {
    project::Project project; ///< that it was made for
    SetUpStudySettings settings;
    toolpath::SetUpPlace now = toolpath::SetUpPlace::Zero(); ///< where the part stood
    std::optional<SetUpStudy> study;                         ///< nothing where it failed
    std::optional<Diagnostic> failure;
    std::uint64_t revision = 0; ///< grows with every publication
};

/// One search at a time, on a thread of its own. Called from the owner's thread; every member but wait_idle
/// returns at once.
class SetUpWorker {
public:
    /// `wake` is called from the worker whenever something new can be looked at.
    explicit SetUpWorker(std::function<void()> wake);
    SetUpWorker(const SetUpWorker&) = delete;
    SetUpWorker& operator=(const SetUpWorker&) = delete;
    ~SetUpWorker();

    /// What runs is dropped; what was found last stays until the new result is there.
    void request(const project::Project& project, const Folders& folders, const SetUpStudySettings& settings);
    void cancel();

    /// Null before the first result.
    [[nodiscard]] std::shared_ptr<const SetUpResult> latest() const;
    [[nodiscard]] Activity activity() const;
    void wait_idle() const;

private:
    class Worker;
    std::unique_ptr<Worker> worker_;
};

/// Whether a place that was found for `then` is one for `now`: the part, the machine and what the search
/// looks at are the same, wherever the part stands.
[[nodiscard]] bool same_but_for_place(const project::Project& then, const project::Project& now);

} // namespace millwright::plan
