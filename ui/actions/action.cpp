#include "ui/actions/action.h"

#include "core/base/error.h"
#include "ui/actions/app_controller.h"

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
    requests_.emplace_back([id = std::move(id)](AppController& app) { app.run(id); });
}

void ActionQueue::edit(std::string title,
                       std::function<void(project::Project&)> change,
                       std::string merge_key) {
    requests_.emplace_back([title = std::move(title), change = std::move(change), key = std::move(merge_key)](
                               AppController& app) { app.edit(title, change, key); });
}

void ActionQueue::end_step() {
    requests_.emplace_back([](AppController& app) { app.end_step(); });
}

void ActionQueue::drag(viewport::DragStage stage, Dragged what) {
    requests_.emplace_back(
        [stage, what = std::move(what)](AppController& app) { follow(app.drag(), app, stage, what); });
}

void ActionQueue::show(std::function<void(ViewState&)> change) {
    requests_.emplace_back([change = std::move(change)](AppController& app) { change(app.view_state()); });
}

void ActionQueue::open_file(std::filesystem::path file) {
    requests_.emplace_back([file = std::move(file)](AppController& app) {
        if (file.extension() == ".json") {
            app.leave("open " + file.filename().string(), [file](AppController& free) { free.open(file); });
        } else { // the project stays
            app.open(file);
        }
    });
}

void ActionQueue::save_file(std::filesystem::path file) {
    requests_.emplace_back([file = std::move(file)](AppController& app) { app.save(file); });
}

void ActionQueue::plot(std::function<void(PlotWorkspace&)> what) {
    requests_.emplace_back([what = std::move(what)](AppController& app) { what(app.plot()); });
}

void ActionQueue::arm(std::function<void(ArmWorkspace&)> what) {
    requests_.emplace_back([what = std::move(what)](AppController& app) { what(app.arm()); });
}

void ActionQueue::processor(std::function<void(ProcessorWorkspace&)> what) {
    requests_.emplace_back([what = std::move(what)](AppController& app) { what(app.processor()); });
}

void ActionQueue::tell(std::function<void(drivers::Driver&)> what) {
    requests_.emplace_back([what = std::move(what)](AppController& app) { app.connection().tell(what); });
}

void ActionQueue::queue(std::function<void(jobs::JobQueue&)> change) {
    requests_.emplace_back([change = std::move(change)](AppController& app) { change(app.queue().open()); });
}

void ActionQueue::open_queued(jobs::QueuedJobId id) {
    requests_.emplace_back([id](AppController& app) { app.open_queued(id); });
}

void ActionQueue::set_overrides(const drivers::Overrides& wanted) {
    requests_.emplace_back([wanted](AppController& app) {
        if (app.look().job.running) {
            app.jobs().set_overrides(wanted);
        } else {
            app.connection().tell([&](drivers::Driver& driver) { driver.set_overrides(wanted); });
        }
    });
}

std::vector<ActionQueue::Request> ActionQueue::take() {
    return std::exchange(requests_, {});
}

} // namespace millwright::actions
