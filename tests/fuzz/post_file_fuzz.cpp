// Any bytes are either a post, or an Error about the file. A post that is one writes a program that reads
// back as it, or says why not.
#include "core/posts/post_file.h"

#include "core/base/error.h"
#include "core/posts/release.h"

#include <cstddef>
#include <cstdint>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

using namespace millwright;        // NOLINT(google-build-using-namespace)
using namespace millwright::gcode; // NOLINT(google-build-using-namespace)

kinematics::MachineModel machine() {
    kinematics::MachineDescription description;
    description.name = "XYZ";
    for (const auto& [letter, direction] :
         {std::pair{'X', Vec3(1, 0, 0)}, std::pair{'Y', Vec3(0, 1, 0)}, std::pair{'Z', Vec3(0, 0, 1)}}) {
        kinematics::MachineAxis axis;
        axis.letter = letter;
        axis.direction = direction;
        axis.max_velocity = axis.max_acceleration = 100.0;
        description.head.push_back(axis);
    }
    return kinematics::MachineModel(description);
}

program::Block block_of(program::BlockKind kind, const Vec3& target) {
    program::Block block;
    block.kind = kind;
    block.target = target;
    block.named = program::AxisSet::all(3);
    block.duration = 2.0;
    block.spindle_rpm = 1000.0;
    return block;
}

program::Program program_for(const kinematics::MachineModel& machine) {
    program::Program program;
    program.machine = machine.name();
    for (const kinematics::MachineAxis& axis : machine.axes()) {
        program.axes.push_back({axis.letter, axis.kind});
    }
    program.start = Vec3::Zero();
    program.blocks = {block_of(program::BlockKind::comment, Vec3::Zero()),
                      block_of(program::BlockKind::spindle_on, Vec3::Zero()),
                      block_of(program::BlockKind::rapid, Vec3(1, 2, 3)),
                      block_of(program::BlockKind::feed, Vec3(10, 2, -1.5)),
                      block_of(program::BlockKind::dwell, Vec3(10, 2, -1.5)),
                      block_of(program::BlockKind::end, Vec3(10, 2, -1.5))};
    return program;
}

} // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const kinematics::MachineModel xyz = machine();
    static const program::Program program = program_for(xyz);
    try {
        const posts::PostFormat format =
            posts::parse_post({reinterpret_cast<const char*>(data), size}, "post.json");
        try {
            static_cast<void>(posts::release(program, xyz, format));
        } catch (const Error&) { // a control that cannot do it, or whose words say something else
        }
    } catch (const Error& error) {
        expects(error.diagnostic().place.file == "post.json", "an error of a post file names the file");
    }
    return 0;
}
