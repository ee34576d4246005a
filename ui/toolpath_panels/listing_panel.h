// The program as text: of the opened G-code file, else of the project. Line by line in step with the motion,
// with search.
#pragma once

#include "core/base/text_search.h"
#include "core/gcode/program_text.h"
#include "ui/panels/panel.h"

#include <map>
#include <memory>
#include <optional>
#include <string>

namespace millwright::panels {

class ListingPanel final : public Panel {
public:
    /// With the row that searches, then the lines.
    void draw(Ui& ui, const FrameState& now, ActionQueue& ask) override;
    /// The lines alone.
    void draw_lines(Ui& ui, const FrameState& now, ActionQueue& ask);

private:
    void follow(const FrameState& now);
    void draw_search(Ui& ui, const FrameState& now, ActionQueue& ask);
    void look_for(const std::string& wanted, const FrameState& now, ActionQueue& ask);
    void go_on(int direction, const FrameState& now, ActionQueue& ask);
    [[nodiscard]] std::string count_text() const;

    std::shared_ptr<const void> shown_;                 ///< what `lines_` is an index of
    gcode::LineIndex own_;                              ///< of the project's program
    const gcode::LineIndex* lines_ = nullptr;           ///< null without a text
    std::uint64_t revision_ = 0;                        ///< of the opened file, that `faults_` was made of
    std::map<int, const Diagnostic*> faults_;           ///< by line from 1
    std::shared_ptr<const plan::OpenedProgram> faulty_; ///< keeps them alive
    std::string wanted_;                                ///< looked for; empty: nothing
    std::optional<TextCount> count_;
    std::optional<std::size_t> found_; ///< byte of the hit that is shown
};

} // namespace millwright::panels
