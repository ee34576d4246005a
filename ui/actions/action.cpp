#include "ui/actions/action.h"

#include "core/base/error.h"
#include "ui/actions/workshop.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace millwright::actions {

const Action* Catalogue::find_or_null(std::string_view id) const {
    const auto found = std::find_if(
        actions_.begin(), actions_.end(), [id](const auto& action) { return action->info().id == id; });
    return found == actions_.end() ? nullptr : found->get();
}

const Action& Catalogue::find(std::string_view id) const {
    const Action* action = find_or_null(id);
    expects(action != nullptr, fmt::format("there is an action '{}'", id));
    return *action;
}

void ActionQueue::run(std::string id) {
    requests_.emplace_back([id = std::move(id)](Workshop& workshop) { workshop.run(id); });
}

void ActionQueue::edit(std::string title,
                       std::function<void(project::Project&)> change,
                       std::string merge_key) {
    requests_.emplace_back([title = std::move(title), change = std::move(change), key = std::move(merge_key)](
                               Workshop& workshop) { workshop.edit(title, change, key); });
}

void ActionQueue::end_step() {
    requests_.emplace_back([](Workshop& workshop) { workshop.end_step(); });
}

void ActionQueue::show(std::function<void(Session&)> change) {
    requests_.emplace_back([change = std::move(change)](Workshop& workshop) { change(workshop.session()); });
}

void ActionQueue::open_file(std::filesystem::path file) {
    requests_.emplace_back([file = std::move(file)](Workshop& workshop) {
        if (file.extension() == ".json") {
            workshop.leave("open " + file.filename().string(), [file](Workshop& free) { free.open(file); });
        } else { // the project stays
            workshop.open(file);
        }
    });
}

void ActionQueue::save_file(std::filesystem::path file) {
    requests_.emplace_back([file = std::move(file)](Workshop& workshop) { workshop.save(file); });
}

void ActionQueue::plot(std::function<void(PlotBench&)> what) {
    requests_.emplace_back([what = std::move(what)](Workshop& workshop) { what(workshop.plot()); });
}

void ActionQueue::arm(std::function<void(ArmBench&)> what) {
    requests_.emplace_back([what = std::move(what)](Workshop& workshop) { what(workshop.arm()); });
}

void ActionQueue::processor(std::function<void(ProcessorBench&)> what) {
    requests_.emplace_back([what = std::move(what)](Workshop& workshop) { what(workshop.processor()); });
}

void ActionQueue::tell(std::function<void(drivers::Driver&)> what) {
    requests_.emplace_back(
        [what = std::move(what)](Workshop& workshop) { workshop.controller().tell(what); });
}

void ActionQueue::queue(std::function<void(jobs::JobQueue&)> change) {
    requests_.emplace_back(
        [change = std::move(change)](Workshop& workshop) { change(workshop.queue().open()); });
}

void ActionQueue::open_queued(jobs::QueuedJobId id) {
    requests_.emplace_back([id](Workshop& workshop) { workshop.open_queued(id); });
}

void ActionQueue::set_overrides(const drivers::Overrides& wanted) {
    requests_.emplace_back([wanted](Workshop& workshop) {
        if (workshop.look().job.running) {
            workshop.jobs().set_overrides(wanted);
        } else {
            workshop.controller().tell([&](drivers::Driver& driver) { driver.set_overrides(wanted); });
        }
    });
}

std::vector<ActionQueue::Request> ActionQueue::take() {
    return std::exchange(requests_, {});
}

} // namespace millwright::actions
