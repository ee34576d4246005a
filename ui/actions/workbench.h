// What a panel may look at in one frame. Panels show it and ask for actions; they change nothing.
#pragma once

#include "core/project/pipeline.h"
#include "ui/actions/document.h"
#include "ui/actions/job_runner.h"
#include "ui/actions/session.h"

#include <memory>
#include <string>
#include <vector>

namespace millwright::actions {

struct Workbench {
    const project::Project& project;
    const Session& session;
    const Document& document;
    std::shared_ptr<const project::PublishedPlan> plan;        ///< null before the first
    std::shared_ptr<const project::WatchedAdaptation> watched; ///< null while none is watched
    project::Activity activity;
    JobView job;
    std::string undo_title, redo_title; ///< empty if there is nothing
    std::filesystem::path assets;

    /// Null-safe access to what is shown.
    [[nodiscard]] std::shared_ptr<const project::Evaluation> shown() const;
    [[nodiscard]] std::shared_ptr<const project::Evaluation> evaluation(project::GridMethod method) const;
    [[nodiscard]] std::shared_ptr<const motion::Trajectory> trajectory() const;
    [[nodiscard]] std::shared_ptr<const gcode::Program> program() const;
    [[nodiscard]] std::shared_ptr<const gcode::Listing> listing() const;
    /// Of the plan: why it stops short of a program; empty if it does not.
    [[nodiscard]] std::string failure() const;
    [[nodiscard]] bool changed() const { return !(project == document.saved); }
    /// The block that is being executed, stepped or scrubbed, and where on the tool path that is. Follows the
    /// running job, else the playback.
    [[nodiscard]] std::optional<viewport::Moment> moment() const;
    [[nodiscard]] int block() const;   ///< -1 without a program
    [[nodiscard]] double time() const; ///< s of the trajectory
};

} // namespace millwright::actions
