// The CORDIC processor of the Processor workspace: a program compiled for it, stepped by hand or running, and
// what a whole run of it comes to. A run by hand goes on a little in each frame, so that the window never
// waits for it.
#pragma once

#include "core/base/error.h"
#include "core/cordic/debugger.h"
#include "core/cordic_machine/cordic_program.h"
#include "ui/workspaces/processor_texts.h"
#include "ui/workspaces/whole_run.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace millwright::actions {

/// Which program it executes.
enum class ProcessorSource : std::uint8_t { thesis_arc, thesis_path, opened_file, project, assembler };

struct ProcessorChoice {
    ProcessorSource source = ProcessorSource::thesis_arc;
    cordic::NumberFormat format = cordic::binary32;
    int iterations = 0; ///< of the classic sequence; 0: the thesis's 29
    double chord_tolerance = cordic_machine::usual_chord_tolerance; ///< mm
    bool thesis_direction = false;    ///< G02 counter-clockwise, as the thesis's model turns
    bool own_microprogram = false;    ///< the project's, in place of the processor's
    bool matlab_zero = false;         ///< no turn where nothing is left to turn, as the thesis's MATLAB model
    double clocks_per_second = 200.0; ///< while it runs, to be watched; 0: as fast as it goes
    double clock_hz = 8e6;            ///< of the processor beside its machine, as in the thesis; > 0
    double needle_rpm = 3000.0;       ///< of the sewing machine that takes each set-point as a stitch; > 0

    friend bool operator==(const ProcessorChoice&, const ProcessorChoice&) = default;
};

enum class ProcessorStep : std::uint8_t { clock, micro_instruction, instruction, block, set_point };

/// An instruction, or a byte that is not an instruction.
struct CodeRow {
    cordic::CodeAddress address = 0;
    std::string text;
    int line = 0; ///< of the program
};

class ProcessorWorkspace {
public:
    /// `wake`: from any thread, when more is known of a whole run.
    explicit ProcessorWorkspace(std::function<void()> wake = {});

    /// Takes a program in place of the present one and compiles it. `name` is not empty.
    void load(ProcessorSource source, std::string text, std::filesystem::path name);
    /// Takes the texts of the project; executes what is chosen of them anew where they changed. True if they
    /// did.
    bool follow(const project::ProcessorInput& input);
    /// Executes the assembler text.
    void load_assembler();
    /// Compiles the same program anew where that changes anything; breakpoints of instructions then go.
    void set(const ProcessorChoice& choice);

    [[nodiscard]] const ProcessorChoice& choice() const { return choice_; }
    [[nodiscard]] const std::filesystem::path& name() const { return name_; } ///< empty before load()
    [[nodiscard]] const std::vector<std::string>& text() const { return lines_; }
    [[nodiscard]] const ProcessorTexts& written() const { return texts_; }
    /// Of the program that is executed; not of one with a failure.
    [[nodiscard]] const cordic::Image& image() const { return program_.image; }
    /// What is left out of the program or done otherwise. Without a line: of all of it, as that its text has
    /// no M2, M30 or %; it is executed all the same.
    [[nodiscard]] const std::vector<Diagnostic>& warnings() const { return program_.warnings; }
    /// Why it, or the microprogram, cannot be executed; there is then nothing to execute.
    [[nodiscard]] const std::optional<Diagnostic>& failure() const { return failure_; }

    [[nodiscard]] const cordic::Debugger& debugger() const { return debugger_; }
    [[nodiscard]] const std::vector<CodeRow>& code() const { return code_; }
    /// The row of the instruction that is executed or fetched next; -1 where there is none.
    [[nodiscard]] std::ptrdiff_t code_row() const;
    /// The text of the microprogram, and the address of each line that has one, else -1.
    [[nodiscard]] const std::vector<std::string>& microprogram() const { return micro_lines_; }
    [[nodiscard]] int micro_address(std::ptrdiff_t row) const;
    [[nodiscard]] std::ptrdiff_t micro_row() const; ///< that is executed next

    /// Of a run from reset to the end, or as far as it was followed.
    [[nodiscard]] const cordic::RunReport& report() const { return whole_.report(); }
    [[nodiscard]] std::span<const cordic::PathDifference> differences() const { return whole_.differences(); }
    /// The same run, each of its set-points being a stitch.
    [[nodiscard]] const cordic::StitchTiming& sewing() const { return whole_.sewing(); }
    /// The rest of that run is still worked out: what is reported of it is a part.
    [[nodiscard]] bool follows() const { return whole_.goes_on(); }
    /// Until it is; advance() then takes it.
    void wait_idle() const { whole_.wait_idle(); }
    /// Set-points that the whole program publishes.
    [[nodiscard]] std::size_t set_points() const { return program_.points.size(); }

    void step(ProcessorStep step);
    void run();
    void pause() { running_ = false; }
    [[nodiscard]] bool running() const { return running_; }
    /// Runs on until the instruction at `address` is fetched, one of a line of the program, or a
    /// micro-instruction is executed next; so far as a second of its clocks goes.
    void run_to(cordic::CodeAddress address);
    void run_to_line(int line);
    void run_to_micro(std::uint8_t address);
    void reset();
    void toggle_breakpoint(cordic::CodeAddress address) { debugger_.toggle_breakpoint(address); }
    /// At the first instruction of a line, if it has one.
    void toggle_line_breakpoint(int line);
    [[nodiscard]] bool has_line_breakpoint(int line) const;
    void toggle_micro_breakpoint(std::uint8_t address) { debugger_.toggle_micro_breakpoint(address); }
    /// Why the last step or run ended.
    [[nodiscard]] cordic::Halt halt() const { return halt_; }

    /// Lets `seconds` of wall time pass. True if anything changed.
    bool advance(double seconds);

private:
    void compile();
    void check_texts();
    void compile_gcode();
    void take_assembled();
    [[nodiscard]] cordic::MadeFor made_for() const;
    [[nodiscard]] cordic::Processor processor_made() const;
    void show_microprogram(const cordic::Microprogram& words);
    [[nodiscard]] RunTerms terms() const { return {choice_.clock_hz, choice_.needle_rpm}; }
    [[nodiscard]] const CodeRow* first_of_line(int line) const;
    [[nodiscard]] cordic::ProcessorSettings settings() const;

    ProcessorChoice choice_;
    std::filesystem::path name_;
    std::string source_text_;
    std::vector<std::string> lines_;
    ProcessorTexts texts_;
    std::optional<Diagnostic> failure_;
    cordic_machine::CordicProgram program_;
    cordic::Debugger debugger_;
    std::vector<CodeRow> code_;
    std::vector<std::string> micro_lines_;
    std::vector<int> micro_addresses_;
    WholeRun whole_;
    bool running_ = false;
    double owed_clocks_ = 0.0;
    cordic::Halt halt_ = cordic::Halt::done;
};

} // namespace millwright::actions
