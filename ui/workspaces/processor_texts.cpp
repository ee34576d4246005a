#include "ui/workspaces/processor_texts.h"

#include "core/base/files.h"
#include "core/cordic/disassembler.h"
#include "core/cordic/microprogram.h"

#include <span>

namespace millwright::actions {

namespace {

constexpr const char* stands_for_text = "assembly source";
constexpr const char* stands_for_microprogram = "microprogram";

} // namespace

std::optional<ProcessorFile> processor_file(const std::filesystem::path& file) {
    const auto end = file.extension();
    if (end == ".asm") {
        return ProcessorFile::assembler;
    }
    if (end == ".bin") {
        return ProcessorFile::image;
    }
    return end == ".micro" ? std::optional(ProcessorFile::microprogram) : std::nullopt;
}

bool is_processor_file(const std::filesystem::path& file) {
    return processor_file(file).has_value();
}

std::string assembler_text(const std::filesystem::path& file) {
    const std::string content = read_file(file);
    if (processor_file(file) != ProcessorFile::image) {
        return content;
    }
    const std::span bytes(reinterpret_cast<const std::uint8_t*>(content.data()), content.size());
    return cordic::disassemble(cordic::parse_image(bytes, file));
}

bool ProcessorTexts::follow(const project::ProcessorInput& input) {
    if (input == input_) {
        return false;
    }
    input_ = input;
    return true;
}

void ProcessorTexts::assemble(const cordic::NumberFormat& format, const cordic::MadeFor& made_for) {
    program_ = cordic::assemble(input_.assembler, stands_for_text, format, made_for);
}

void ProcessorTexts::assemble_micro(const cordic::Sequence& sequence, const cordic::NumberFormat& format) {
    micro_ = cordic::assemble_microprogram(
        input_.microprogram, stands_for_microprogram, cordic::microprogram_constants(sequence, format));
}

const std::vector<Diagnostic>& ProcessorTexts::remarks() const {
    return program_.errors.empty() ? program_.warnings : program_.errors;
}

std::optional<Diagnostic> ProcessorTexts::failure() const {
    if (!program_.errors.empty()) {
        return program_.errors.front();
    }
    if (program_.image.code.empty()) {
        return Diagnostic{{stands_for_text, 0, 0, -1},
                          "the program contains no instruction",
                          "write a program that ends with HLT"};
    }
    return std::nullopt;
}

std::optional<Diagnostic> ProcessorTexts::micro_failure() const {
    if (!micro_.errors.empty()) {
        return micro_.errors.front();
    }
    if (micro_.program.count == 0) {
        return Diagnostic{{stands_for_microprogram, 0, 0, -1},
                          "the microprogram contains no micro-instruction",
                          "start with a copy of the built-in microprogram"};
    }
    return std::nullopt;
}

} // namespace millwright::actions
