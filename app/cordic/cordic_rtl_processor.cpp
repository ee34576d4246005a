#include "app/command_line/output_transaction.h"
#include "app/cordic/cordic_command.h"
#include "app/cordic/cordic_source.h"
#include "core/base/files.h"
#include "core/cordic_rtl/processor_rtl.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace millwright::app {
namespace {

constexpr std::int64_t most_instructions = 50'000;

struct ProcessorRtlOptions {
    CordicSource source;
    CordicChoice choice;
    std::string out;
    std::int64_t instructions = 1000;
    std::uint64_t seed = 2002;
};

constexpr const char* usual_format = "q12.20";

/// Assembler text and images may name their own format.
CordicSource with_format(CordicSource source) {
    const std::string kind = std::filesystem::path(source.file).extension().string();
    if (!source.format && kind != ".asm" && kind != ".bin") {
        source.format = usual_format;
    }
    return source;
}

std::vector<cordic::Image> programs(const ProcessorRtlOptions& options) {
    const CordicSource source = with_format(options.source);
    if (!source.file.empty()) {
        return {cordic_program(source, options.choice.arithmetic).image};
    }
    const cordic::NumberFormat format = cordic::parse_number_format(source.format.value_or(usual_format));
    if (!cordic::is_fixed(format)) {
        throw cordic::no_hardware_of(format);
    }
    const cordic::MadeFor made_for = made_for_options(options.choice.arithmetic);
    std::vector<cordic::Image> made = cordic::rtl_test_programs(format, options.instructions, options.seed);
    for (cordic::Image& image : made) {
        image.made_for = made_for;
    }
    return made;
}

int rtl_processor(const ProcessorRtlOptions& options) {
    const std::vector<cordic::Image> images = programs(options);
    const cordic::ProcessorSettings settings = cordic_processor(options.choice, images.front()).settings();
    std::vector<OutputFile> files;
    for (cordic::RtlFile& file : cordic::make_processor_rtl(settings, images)) {
        files.push_back({std::move(file.name), std::move(file.text)});
    }
    make_folder(options.out);
    write_outputs(options.out, {files});
    fmt::print("{} files; try: cd {} && iverilog -g2001 -s gcode_processor_tb -o sim *.v && ./sim\n",
               files.size(),
               options.out);
    return 0;
}

} // namespace

void add_cordic_rtl_processor(CLI::App& group, Command& chosen) {
    const auto options = std::make_shared<ProcessorRtlOptions>();
    CLI::App& command =
        *group.add_subcommand("rtl-processor", "Write the whole processor as Verilog, with a test bench");
    CLI::Option& file =
        *command.add_option("FILE",
                            options->source.file,
                            "Program for the test bench: G-code, assembly source (.asm) or image (.bin); "
                            "default: random instructions and every way to stop");
    command
        .add_option(
            "--format", options->source.format, "Fixed-point format such as q12.20; an image has its own")
        ->check(number_format_text());
    add_cordic_arithmetic(command, options->choice.arithmetic);
    add_cordic_unit(command, options->choice);
    command.add_option("--out", options->out, "Folder for the Verilog files and the input of the test bench")
        ->required()
        ->type_name("DIR");
    command.add_option("--instructions", options->instructions, "Approximate number of random instructions")
        ->check(CLI::Range(std::int64_t{1}, most_instructions))
        ->capture_default_str()
        ->excludes(&file);
    command.add_option("--seed", options->seed, "Seed of the random instructions")
        ->capture_default_str()
        ->excludes(&file);
    command.callback([&chosen, options] { chosen = [options] { return rtl_processor(*options); }; });
}

} // namespace millwright::app
