// The commands about controllers and the jobs that run on them. Each function adds its command; where it is
// meant, `chosen` becomes what is to be done. See docs/reference/cli.md.
#pragma once

#include "app/command_line/command.h"

#include <CLI/App.hpp>

namespace millwright::app {

/// `millwright emulate`: emulated controllers at the other end of a wire.
void add_emulate_command(CLI::App& app, Command& chosen);

/// `millwright jobs`: what became of jobs, and the queue.
void add_jobs_command(CLI::App& app, Command& chosen);

/// `millwright pmac`: questions to a PMAC and its set-up.
void add_pmac_command(CLI::App& app, Command& chosen);

/// `millwright ports`: the serial ports of this computer.
void add_ports_command(CLI::App& app, Command& chosen);

/// `millwright run`: a program on a machine that is moved position by position.
void add_run_command(CLI::App& app, Command& chosen);

/// `millwright send`: a program to a controller.
void add_send_command(CLI::App& app, Command& chosen);

/// `millwright stop`: brings a machine to rest that no running Millwright controls.
void add_stop_command(CLI::App& app, Command& chosen);

} // namespace millwright::app
