#include "core/project/history.h"

#include "core/base/error.h"

#include <cstddef>
#include <iterator>
#include <utility>

namespace millwright::project {

History::History(Project start) {
    steps_.push_back({std::move(start), {}, {}, 0});
}

void History::commit(Project next, std::string title, std::string merge_key) {
    if (next == current()) {
        return;
    }
    if (at_ > 0 && !merge_key.empty() && steps_[at_].merge_key == merge_key) {
        steps_[at_].project = std::move(next);
        if (steps_[at_].project == steps_[at_ - 1].project) { // dragged back to where it began
            take_back();
        }
        return;
    }
    set_aside_.clear();
    if (!merge_key.empty()) {
        set_aside_.assign(steps_.begin() + static_cast<std::ptrdiff_t>(at_) + 1, steps_.end());
    }
    drop_undone();
    push({std::move(next), std::move(title), std::move(merge_key), project_number()});
}

void History::begin(Project other, std::string title) {
    drop_undone();
    close_step();
    push({std::move(other), std::move(title), {}, ++last_project_number_});
}

void History::drop_undone() {
    steps_.erase(steps_.begin() + static_cast<std::ptrdiff_t>(at_) + 1, steps_.end());
}

void History::push(Step step) {
    steps_.push_back(std::move(step));
    if (steps_.size() > most_steps + 1) {
        steps_.erase(steps_.begin());
    }
    at_ = steps_.size() - 1;
}

void History::close_step() {
    steps_[at_].merge_key.clear();
    set_aside_.clear();
}

void History::revert_step(std::string_view merge_key) {
    if (at_ > 0 && !merge_key.empty() && steps_[at_].merge_key == merge_key) {
        take_back();
    }
}

void History::take_back() {
    steps_.pop_back();
    --at_;
    steps_.insert(
        steps_.end(), std::make_move_iterator(set_aside_.begin()), std::make_move_iterator(set_aside_.end()));
    set_aside_.clear();
}

std::string History::undo_title() const {
    return at_ > 0 ? steps_[at_].title : std::string();
}

std::string History::redo_title() const {
    return at_ + 1 < steps_.size() ? steps_[at_ + 1].title : std::string();
}

void History::undo() {
    expects(at_ > 0, "there is a step to undo");
    steps_[at_].merge_key.clear();
    --at_;
    close_step();
}

void History::redo() {
    expects(at_ + 1 < steps_.size(), "there is a step to redo");
    ++at_;
    close_step();
}

} // namespace millwright::project
