// Undo and redo: snapshots of the project, each named after the action that made it.
#pragma once

#include "core/project/project.h"

#include <string>
#include <string_view>
#include <vector>

namespace millwright::project {

class History {
public:
    explicit History(Project start);

    [[nodiscard]] const Project& current() const { return steps_[at_].project; }

    /// Makes `next` current under the action's title; what was undone before is dropped. A step that changes
    /// nothing is none. Steps with the same non-empty `merge_key` right after each other become one (a drag).
    void commit(Project next, std::string title, std::string merge_key = {});
    /// Makes another project current, as a step of its own: undo goes back to the one before.
    void begin(Project other, std::string title);
    /// Which of the projects begun the current step belongs to; that of the constructor is 0. Those after it
    /// count on, also past steps that were dropped.
    [[nodiscard]] int project_number() const { return steps_[at_].project_number; }
    /// Ends merging: the next commit is a step of its own.
    void close_step();
    /// Takes back the step that commits with `merge_key` still join: what it dropped can be redone again.
    /// Nothing where there is none.
    void revert_step(std::string_view merge_key);

    /// The title of what undo or redo would do; empty if there is nothing.
    [[nodiscard]] std::string undo_title() const;
    [[nodiscard]] std::string redo_title() const;
    /// Throws Defect if there is nothing to undo or redo.
    void undo();
    void redo();

private:
    struct Step {
        Project project;
        std::string title;
        std::string merge_key;
        int project_number = 0;
    };
    void drop_undone();
    void push(Step step);
    void take_back(); ///< the last step

    std::vector<Step> steps_;
    std::vector<Step> set_aside_; ///< dropped by the step that goes on
    std::size_t at_ = 0;
    int last_project_number_ = 0;
    static constexpr std::size_t most_steps = 500;
};

} // namespace millwright::project
