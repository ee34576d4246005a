// Any bytes are an image or an Error; an image disassembles and runs without leaving a defined state.
#include "core/base/error.h"
#include "core/cordic/disassembler.h"
#include "core/cordic/processor.h"

#include <cmath>
#include <cstddef>
#include <cstdint>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace millwright; // NOLINT(google-build-using-namespace)
    cordic::Image image;
    try {
        image = cordic::parse_image({data, size}, "fuzz.bin");
    } catch (const Error&) {
        return 0;
    }
    expects(!cordic::disassemble(image).empty(), "an image has a text");
    cordic::Processor processor({.publishing = cordic::Publishing::bus, .wait_states = 1}, image);
    processor.run(20'000);
    for (const auto& record : processor.published()) {
        const auto set = processor.set_point(record);
        expects(std::isfinite(set.x) && std::isfinite(set.vx) && std::isfinite(set.ay),
                "set-points are finite");
    }
    return 0;
}
