#include "ui/workspaces/motion_program_draft.h"

namespace millwright::actions {

namespace {

const std::filesystem::path motion_program_name = "program";

} // namespace

MotionProgramDraft::MotionProgramDraft(std::function<void()> wake) : work_(run, std::move(wake)) {}

MotionProgramDraft::Answer MotionProgramDraft::run(const Wish& wish, const Progress& progress) {
    pmac::MotionSimulationSettings settings;
    settings.card = wish.card;
    settings.start_deg = wish.start_deg;
    return {wish.text,
            std::make_shared<const pmac::MotionSimulation>(
                pmac::simulate_motion_program(wish.text, motion_program_name, settings, progress))};
}

void MotionProgramDraft::follow(const std::string& text) {
    if (text == text_) {
        return;
    }
    text_ = text;
    text_faults_ = pmac::motion_program_faults(text_, motion_program_name);
    faults_ = text_faults_;
}

void MotionProgramDraft::simulate(pmac::PmacSettings card, std::vector<double> start_deg) {
    (void)lines();
    work_.want({text_, std::move(card), std::move(start_deg)});
}

std::shared_ptr<const pmac::MotionSimulation> MotionProgramDraft::take() {
    auto answer = work_.answer();
    if (!answer || answer == taken_) {
        return nullptr;
    }
    taken_ = answer;
    if (answer->text == text_) {
        faults_ = answer->simulation->faults;
    }
    return answer->simulation;
}

std::vector<std::string> MotionProgramDraft::lines() const {
    if (!text_faults_.empty()) {
        throw Error(text_faults_.front());
    }
    std::vector<std::string> lines;
    for (const pmac::MotionLine& line : pmac::motion_lines(text_, motion_program_name)) {
        lines.push_back(line.text);
    }
    if (lines.empty()) {
        throw Error("the program has no lines");
    }
    return lines;
}

} // namespace millwright::actions
