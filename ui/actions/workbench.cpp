#include "ui/actions/workbench.h"

#include <algorithm>
#include <cmath>

namespace millwright::actions {

namespace {

/// The move of the tool path that a block belongs to, and how far it is; approach and links hold the nearest
/// end.
viewport::Moment moment_in(const gcode::Program& program, const motion::Sample& sample) {
    viewport::Moment moment;
    moment.axes = sample.position;
    const auto& blocks = program.blocks;
    const auto block = static_cast<std::size_t>(std::clamp(sample.block, 0, program.block_count() - 1));
    int point = -1;
    for (std::size_t n = 0; n < block; ++n) {
        point = std::max(point, blocks[n].path_point);
    }
    const bool inside = blocks[block].path_point > 0 && blocks[block].role == gcode::MoveRole::cut;
    moment.move = point;
    moment.fraction = inside ? sample.fraction : 0.0;
    return moment;
}

} // namespace

std::shared_ptr<const project::Evaluation> Workbench::evaluation(project::GridMethod method) const {
    return plan ? plan->plan.evaluation(method) : nullptr;
}

std::shared_ptr<const project::Evaluation> Workbench::shown() const {
    if (auto wanted = evaluation(session.shown)) {
        return wanted;
    }
    return evaluation(project::GridMethod::uniform);
}

std::shared_ptr<const motion::Trajectory> Workbench::trajectory() const {
    return plan ? plan->plan.trajectory : nullptr;
}

std::shared_ptr<const gcode::Program> Workbench::program() const {
    return plan ? plan->plan.program : nullptr;
}

std::shared_ptr<const gcode::Listing> Workbench::listing() const {
    return plan ? plan->plan.listing : nullptr;
}

std::string Workbench::failure() const {
    return plan && plan->failure ? to_text(*plan->failure) : std::string();
}

double Workbench::time() const {
    if (job.running && job.report) {
        return job.report->driver.planned_time;
    }
    return session.playback.time;
}

int Workbench::block() const {
    const auto planned = trajectory();
    return planned ? planned->block_at(time()) : -1;
}

bool Workbench::at_machine() const {
    if (!job.report) {
        return false;
    }
    constexpr double same_moment = 1e-9; // s
    return job.running || std::abs(session.playback.time - job.report->driver.planned_time) < same_moment;
}

std::optional<viewport::Moment> Workbench::moment() const {
    const auto planned = trajectory();
    const auto made = program();
    if (!planned || !made || made->blocks.empty()) {
        return std::nullopt;
    }
    viewport::Moment moment = moment_in(*made, planned->at(time()));
    if (job.running && job.report && job.report->driver.position.size() == moment.axes.size()) {
        moment.axes = job.report->driver.position;
    }
    return moment;
}

} // namespace millwright::actions
