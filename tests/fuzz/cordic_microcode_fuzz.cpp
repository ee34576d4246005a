// Any text is a microprogram or reported as wrong; any microprogram runs without leaving a defined state.
#include "core/cordic/microcode.h"
#include "core/cordic/microprogram.h"
#include "core/cordic/processor.h"

#include <cstddef>
#include <cstdint>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace millwright::cordic; // NOLINT(google-build-using-namespace)
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    static const NumberFormat format = fixed_format(4, 12);
    static const auto constants = microprogram_constants(thesis_sequence(), format);
    const auto [program, errors] = assemble_microprogram(text, "fuzz.mic", constants);
    if (!errors.empty()) {
        return 0;
    }
    Image image{.format = format, .code = {0x12, 0x00, 0x10, 0, 0, 0x10, 0, 0x20, 0, 0, 0x21, 0x22, 0x01}};
    Processor processor({}, image, program);
    processor.run(20'000);
    return 0;
}
