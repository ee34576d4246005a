// millwright arm: the command and those that it consists of, each of which adds itself to the group. See
// docs/reference/cli.md.
#pragma once

#include "app/command_line/command.h"

#include <CLI/App.hpp>

namespace millwright::app {

/// Adds the command with its subcommands; where one is meant, `chosen` becomes what is to be done.
void add_arm_command(CLI::App& app, Command& chosen);

/// `millwright arm bodies`: what an arm of the Motoman L-3's kind looks like, as a glb file.
void add_arm_bodies_command(CLI::App& group, Command& chosen);

/// `millwright arm actuators`.
void add_arm_drives_command(CLI::App& group, Command& chosen);

/// `millwright arm offset` and `arm step`: setting up a motor of the arm on its PMAC.
void add_arm_motor_commands(CLI::App& group, Command& chosen);

/// `millwright arm fk` and `arm ik`.
void add_arm_pose_commands(CLI::App& group, Command& chosen);

/// `millwright arm reach`: how much of a program an arm can go, with the part standing in front of it.
void add_arm_reach_command(CLI::App& group, Command& chosen);

/// `millwright arm calibrate`, `amplifier` and `wiring`: what setting up the arm and its controller takes.
void add_arm_service_commands(CLI::App& group, Command& chosen);

/// `millwright arm stream`: a motion file through the dual-ported RAM of an emulated card.
void add_arm_stream_command(CLI::App& group, Command& chosen);

} // namespace millwright::app
