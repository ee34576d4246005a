#include "app/cordic/cordic_command.h"
#include "app/cordic/cordic_source.h"
#include "core/base/counted.h"
#include "core/base/error.h"
#include "core/base/files.h"
#include "core/cordic/disassembler.h"
#include "core/cordic/microprogram.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

namespace millwright::app {

namespace {

struct CordicProgramsOptions {
    CordicSource source;
    CordicArithmetic arithmetic;
    std::string out;
    bool over_bus = false;
};

int show_microprogram(const CordicProgramsOptions& options) {
    const auto publishing = options.over_bus ? cordic::Publishing::bus : cordic::Publishing::latch;
    fmt::print("{}", cordic::microprogram_text(publishing));
    return 0;
}

int assemble(const CordicProgramsOptions& options) {
    if (std::filesystem::path(options.source.file).extension() == ".bin") {
        throw Error(
            "is already an image", options.source.file, "print its text with millwright cordic disasm");
    }
    const cordic_machine::CordicProgram program = cordic_program(options.source, options.arithmetic);
    const auto bytes = cordic::to_bytes(program.image);
    write_file(options.out, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    fmt::print("{} of code, {}\n",
               counted(program.image.code.size(), "byte"),
               cordic::to_text(program.image.format));
    return 0;
}

int disassemble(const CordicProgramsOptions& options) {
    const std::string text = cordic::disassemble(cordic_program(options.source, options.arithmetic).image);
    std::fwrite(text.data(), 1, text.size(), stdout);
    return 0;
}

CLI::App& add_file(CLI::App& group,
                   const char* name,
                   const char* text,
                   const std::shared_ptr<CordicProgramsOptions>& options,
                   const char* kinds) {
    CLI::App& command = *group.add_subcommand(name, text);
    add_cordic_source(command, options->source, kinds);
    add_cordic_arithmetic(command, options->arithmetic);
    return command;
}

} // namespace

void add_cordic_programs(CLI::App& group, Command& chosen) {
    const auto options = std::make_shared<CordicProgramsOptions>();
    CLI::App& assembling = add_file(
        group, "asm", "Assemble a program into an image", options, "G-code or assembly source (.asm)");
    assembling.add_option("--out", options->out, "Image file (.bin)")->required()->type_name("FILE");
    assembling.callback([&chosen, options] { chosen = [options] { return assemble(*options); }; });
    CLI::App& showing = add_file(group,
                                 "disasm",
                                 "Print a program as assembly source",
                                 options,
                                 "Image (.bin), G-code or assembly source (.asm)");
    showing.callback([&chosen, options] { chosen = [options] { return disassemble(*options); }; });
    CLI::App& micro = *group.add_subcommand("microprogram", "Print the processor's microprogram");
    micro.add_flag("--over-bus", options->over_bus, "Send set-points byte by byte over the bus");
    micro.callback([&chosen, options] { chosen = [options] { return show_microprogram(*options); }; });
}

} // namespace millwright::app
