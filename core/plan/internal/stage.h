// A stage of the derivation of a plan: what it reads, what it makes, and how. The stages in their order are
// in stages.h, derivation.h runs them.
#pragma once

#include "core/base/progress.h"
#include "core/plan/plan.h"

#include <array>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

namespace millwright::plan {

/// How well a result is made; a later one replaces an earlier one.
enum class Quality {
    carried, ///< a grid from before the last change, on the surface of now
    coarse,  ///< few samples per move, for a person who drags
    exact    ///< as for a report
};

enum class StageKind {
    surface,
    trims,
    region,
    cutting_setup,
    singular_points,
    grid,
    path,
    program,
    cut,
    weight,
    time,
    unsequenced,
    compared_cut
};

/// Names a stage. Of grid, time and compared_cut there is one for each method; others have `uniform`.
struct StageKey {
    StageKind kind = StageKind::surface;
    project::GridMethod method = project::GridMethod::uniform;

    friend bool operator==(const StageKey&, const StageKey&) = default;
};

/// What a person entered, and the state of the machine's file.
struct Source {
    project::Project project;
    Folders folders;
    std::filesystem::file_time_type machine_written;
};

/// The last grid of each method that there was, by GridMethod: a first guess for what has changed.
using EarlierGrids = std::array<std::shared_ptr<const Evaluation>, project::every_grid_method.size()>;

/// What a stage works with: its result goes into `plan`, where those of earlier stages are.
struct StageWork {
    Plan& plan;
    const Source& source;
    const EarlierGrids& earlier;
    Quality quality;
    const Progress& progress;

    [[nodiscard]] const project::Project& project() const { return source.project; }
    [[nodiscard]] const CuttingSetup& cutting_setup() const { return *plan.cutting_setup; }
};

struct Stage {
    StageKey key;
    std::string_view title = {}; ///< what is being done, for people; empty if it takes no time
    double share = 0.0;          ///< of the work, relative to the other stages
    bool asked = true;           ///< else only a result that still holds is kept

    /// The earlier stages whose results it reads: it is stale when one of them was made again.
    std::vector<StageKey> reads = {};
    /// Whether what it reads of the project itself is equal, so that a result of `then` holds `now`.
    std::function<bool(const Source& then, const Source& now)> same = {};
    /// False if there is nothing of that quality; an exact result may be nothing. Throws Error or Cancelled.
    std::function<bool(const StageWork& work)> make = {};
    /// Takes the result out of the plan.
    std::function<void(Plan& plan)> clear = {};

    std::vector<Quality> qualities = {Quality::exact}; ///< in which it is made, the best last
    bool graded = false; ///< it is made again in each better quality; else what is made is exact
    bool stays = false;  ///< a stale result that is not exact is shown until the next one is there
    /// Results of this quality are shown as soon as they are there, not with those of the stages that follow.
    std::optional<Quality> shown_early = {};
    /// The compared grid whose own a failure is, and reported with it; nothing: without this there is no
    /// plan.
    std::optional<project::GridMethod> fault_of = {};
};

} // namespace millwright::plan
