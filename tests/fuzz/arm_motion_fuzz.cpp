// Any text as a motion file of an arm: blocks with finite numbers, or an Error with its place.
#include "core/arm/arm_motion_file.h"
#include "core/base/error.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace millwright;
    try {
        const auto blocks = arm::parse_arm_motion({reinterpret_cast<const char*>(data), size}, "fuzz.txt");
        for (const arm::ArmBlock& block : blocks) {
            expects(block.way.allFinite() && block.line > 0, "a block goes somewhere");
            expects(!block.radius || std::isfinite(*block.radius), "a radius is finite");
        }
    } catch (const Error& refused) {
        expects(refused.diagnostic().place.line > 0, "what is wrong has a place");
    }
    return 0;
}
