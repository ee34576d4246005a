// The shipped G-code samples as programs of a machine.
#pragma once

#include "core/gcode/interpreter.h"
#include "core/gcode_programs/machine_program.h"

#include <algorithm>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace millwright::test {

struct SampleProgram {
    std::string name;
    program::Program program;
};

/// Those that the machine can run and that move it twice or more, in the order of their names.
inline std::vector<SampleProgram> sample_programs(const kinematics::MachineModel& machine) {
    std::vector<SampleProgram> found;
    for (const auto& entry : std::filesystem::directory_iterator("assets/samples/gcode")) {
        gcode::MachineProgramBuilder builder(machine, entry.path());
        gcode::ReaderSettings settings;
        settings.any_tool = true;
        gcode::Interpreter reader(entry.path(), settings, builder);
        reader.run();
        gcode::MachineProgram read = builder.take();
        const auto moves = std::ranges::count_if(read.program.blocks, &program::Block::moves);
        if (reader.errors().empty() && read.faults.empty() && moves >= 2) {
            found.push_back({entry.path().filename().string(), std::move(read.program)});
        }
    }
    std::ranges::sort(found, {}, &SampleProgram::name);
    return found;
}

} // namespace millwright::test
