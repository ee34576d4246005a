#include "app/plan/machine_command.h"

#include "core/base/error.h"
#include "core/base/files.h"
#include "core/kinematics/machine_file.h"
#include "core/kinematics/machine_solids.h"
#include "core/project/assets.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string>

namespace millwright::app {

namespace {

struct MachineBodiesOptions {
    std::string machine;
    std::string out;
};

int write_machine_bodies(const MachineBodiesOptions& options) {
    const std::filesystem::path file =
        project::machine_path(options.machine, std::filesystem::current_path(), project::assets_folder());
    const kinematics::MachineModel machine = kinematics::read_machine(file);
    const auto bodies = kinematics::machine_solids(machine);
    if (bodies.empty()) {
        throw Error("the machine has no bodies", file);
    }
    write_file(options.out, geometry::glb_of(bodies, machine.name()));
    fmt::print("{}: {} bodies\n", options.out, bodies.size());
    return 0;
}

} // namespace

void add_machine_command(CLI::App& app, Command& chosen) {
    CLI::App& group = *app.add_subcommand("machine", "Work with machine files");
    group.require_subcommand(1);
    const auto options = std::make_shared<MachineBodiesOptions>();
    CLI::App& command =
        *group.add_subcommand("bodies", "Generate the bodies of a machine from its file, as glb");
    command.add_option("MACHINE", options->machine, "Shipped machine or machine file")->required();
    command.add_option("--out", options->out, "Output file")->required()->type_name("FILE.glb");
    command.callback([&chosen, options] { chosen = [options] { return write_machine_bodies(*options); }; });
}

} // namespace millwright::app
