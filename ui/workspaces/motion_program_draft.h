// The motion program of the arm's card while it is being written: what the card would refuse, and what its
// motors would do, on an emulated card in the background.
#pragma once

#include "core/pmac/emulator/motion_program.h"
#include "ui/workspaces/latest_work.h"

#include <memory>
#include <string>
#include <vector>

namespace millwright::actions {

class MotionProgramDraft {
public:
    /// `wake`: from any thread, when a simulation has ended.
    explicit MotionProgramDraft(std::function<void()> wake);

    /// Looks through the text if it is another one than before.
    void follow(const std::string& text);
    [[nodiscard]] const std::string& text() const { return text_; }
    /// Of the text, by line; then how the last simulation of this very text broke off.
    [[nodiscard]] const std::vector<Diagnostic>& faults() const { return faults_; }
    /// Its text is without faults. What a simulation found may be over when the arm stands elsewhere.
    [[nodiscard]] bool can_be_read() const { return text_faults_.empty(); }

    /// Runs the text in the background on `card`, from `start_deg` of each of its axes.
    void simulate(pmac::PmacSettings card, std::vector<double> start_deg);
    [[nodiscard]] bool busy() const { return work_.busy(); }
    /// A simulation that has ended since this was last asked; null without one.
    [[nodiscard]] std::shared_ptr<const pmac::MotionSimulation> take();
    void wait_idle() const { work_.wait_idle(); }

    /// What the card is sent. Throws Error for a text with faults, and for an empty one.
    [[nodiscard]] std::vector<std::string> lines() const;

private:
    struct Wish {
        std::string text;
        pmac::PmacSettings card;
        std::vector<double> start_deg;
    };
    struct Answer {
        std::string text;
        std::shared_ptr<const pmac::MotionSimulation> simulation;
    };
    static Answer run(const Wish& wish, const Progress& progress);

    std::string text_;
    std::vector<Diagnostic> text_faults_;
    std::vector<Diagnostic> faults_; ///< these, or those of the last simulation
    std::shared_ptr<const Answer> taken_;
    LatestWork<Wish, Answer> work_;
};

} // namespace millwright::actions
