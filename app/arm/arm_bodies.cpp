#include "core/arm/arm_bodies.h"

#include "app/arm/arm_command.h"
#include "app/command_line/arm_choice.h"
#include "core/arm/arm_file.h"
#include "core/base/error.h"
#include "core/base/files.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <memory>
#include <string>

namespace millwright::app {

namespace {

struct ArmBodiesOptions {
    std::string arm = "motoman-l3";
    std::string out;
};

int write_arm_bodies(const ArmBodiesOptions& options) {
    const arm::ArmFile file = arm_file_of(options.arm);
    if (!file.actuators) {
        throw Error(file.arm.name() +
                    ": bodies are generated from the linkages, which its file does not describe");
    }
    const arm::MotomanSolids made = arm::motoman_solids(file.arm, *file.actuators);
    write_file(options.out, geometry::glb_of(made.bodies, file.arm.name()));
    fmt::print("{}: {} bodies\n", options.out, made.bodies.size());
    return 0;
}

} // namespace

void add_arm_bodies_command(CLI::App& group, Command& chosen) {
    CLI::App& command =
        *group.add_subcommand("bodies", "Generate the bodies of an arm from its lengths, as glb");
    const auto options = std::make_shared<ArmBodiesOptions>();
    add_arm_option(command, options->arm);
    command.add_option("--out", options->out, "Output file")->required()->type_name("FILE.glb");
    command.callback([&chosen, options] { chosen = [options] { return write_arm_bodies(*options); }; });
}

} // namespace millwright::app
