// Any text is assembled or told wrong; what is assembled comes back the same from the disassembler, and runs
// without leaving a defined state.
#include "core/base/error.h"
#include "core/cordic/assembler.h"
#include "core/cordic/processor.h"

#include <cstddef>
#include <cstdint>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace millwright; // NOLINT(google-build-using-namespace)
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    const auto [image, errors] = cordic::assemble(text, "fuzz.asm");
    if (!errors.empty()) {
        return 0;
    }
    const auto again = cordic::assemble(cordic::disassemble(image), "again.asm");
    expects(again.errors.empty() && again.image == image,
            "the disassembler's text assembles to the same image");
    cordic::Processor processor({}, image);
    processor.run(20'000);
    return 0;
}
