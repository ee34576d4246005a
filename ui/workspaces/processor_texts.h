// What a person writes for the processor, and what is wrong with it: assembler text, and a microprogram.
#pragma once

#include "core/base/error.h"
#include "core/cordic/assembler.h"
#include "core/cordic/microcode.h"
#include "core/cordic/processor_state.h"
#include "core/project/processor_input.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace millwright::actions {

/// A file that the Processor workspace opens, by the end of its name: .asm, .bin, .micro.
enum class ProcessorFile : std::uint8_t { assembler, image, microprogram };
[[nodiscard]] std::optional<ProcessorFile> processor_file(const std::filesystem::path& file);
[[nodiscard]] bool is_processor_file(const std::filesystem::path& file);

/// Assembler text of a file: itself, or an image disassembled. Throws Error with what is wrong in an image.
[[nodiscard]] std::string assembler_text(const std::filesystem::path& file);

class ProcessorTexts {
public:
    /// False where both texts are the present ones.
    bool follow(const project::ProcessorInput& input);
    [[nodiscard]] const project::ProcessorInput& input() const { return input_; }

    /// Assembles the text; what it does not name is as chosen.
    void assemble(const cordic::NumberFormat& format, const cordic::MadeFor& made_for);
    /// And the microprogram, for programs of that format.
    void assemble_micro(const cordic::Sequence& sequence, const cordic::NumberFormat& format);

    [[nodiscard]] const cordic::Assembled& program() const { return program_; }
    /// Its errors, or if there are none its warnings, with their lines.
    [[nodiscard]] const std::vector<Diagnostic>& remarks() const;
    /// Why it cannot be executed.
    [[nodiscard]] std::optional<Diagnostic> failure() const;

    [[nodiscard]] const cordic::Microprogram& microprogram() const { return micro_.program; }
    [[nodiscard]] const std::vector<Diagnostic>& micro_faults() const { return micro_.errors; }
    [[nodiscard]] std::optional<Diagnostic> micro_failure() const;

private:
    project::ProcessorInput input_;
    cordic::Assembled program_;
    cordic::AssembledMicroprogram micro_;
};

} // namespace millwright::actions
