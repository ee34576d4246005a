// millwright cordic: the G-code processor that computes with CORDIC, from single rotations to whole programs.
// Its larger commands add themselves to the group.
#pragma once

#include "app/command_line/command.h"

#include <CLI/App.hpp>

namespace millwright::app {

void add_cordic_command(CLI::App& app, Command& chosen);

/// `cordic accuracy`: proven bounds beside measured errors, and the thesis's experiments as pictures.
void add_cordic_accuracy(CLI::App& group, Command& chosen);

/// `cordic compare`: the thesis's speed experiment.
void add_cordic_compare(CLI::App& group, Command& chosen);

/// `cordic asm`, `disasm`, `microprogram`: programs of the CORDIC processor as bytes and as text.
void add_cordic_programs(CLI::App& group, Command& chosen);

/// `cordic rtl-processor`: the whole processor as Verilog, with a bench that compares it with the model.
void add_cordic_rtl_processor(CLI::App& group, Command& chosen);

/// `cordic run`: a program on the CORDIC processor, and what it comes to.
void add_cordic_run(CLI::App& group, Command& chosen);

/// `cordic sew`: a program as the stitches of a sewing machine, and what it could not keep up with.
void add_cordic_sew(CLI::App& group, Command& chosen);

} // namespace millwright::app
