// Reading a program: executing its text, and planning its motion on a machine.
#pragma once

#include "core/base/progress.h"
#include "core/gcode/interpreter.h"
#include "core/plan/opened_program.h"

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <functional>

namespace millwright::plan {

class ProgramReading {
public:
    /// `now` and `assets` stay the caller's. `folder`: of a machine file that is named without one.
    /// `show` is called whenever there is more of `now` to be looked at.
    ProgramReading(OpenedProgram& now,
                   std::filesystem::path folder,
                   const std::filesystem::path& assets,
                   std::function<void()> show);

    /// The text is there. What is wrong with the program, or with its machine, is reported in `now`. Throws
    /// Cancelled.
    void read(const Progress& progress);

private:
    using Clock = std::chrono::steady_clock;

    void show();
    void load_machine();
    void execute(const Progress& progress);
    void look_around(const gcode::Interpreter& program, const Progress& progress);
    void plan(const Progress& progress);

    OpenedProgram& now_;
    std::filesystem::path folder_;
    const std::filesystem::path& assets_;
    std::function<void()> show_;
    std::size_t shown_chunks_ = 0; ///< of the path
    Clock::time_point shown_at_;
};

} // namespace millwright::plan
