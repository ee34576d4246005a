// Any text is assembled or reported as wrong; what is assembled comes back the same from the disassembler,
// and runs without leaving a defined state.
#include "core/base/error.h"
#include "core/cordic/assembler.h"
#include "core/cordic/disassembler.h"
#include "core/cordic/processor.h"

#include <cstddef>
#include <cstdint>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace millwright; // NOLINT(google-build-using-namespace)
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    const cordic::Assembled program = cordic::assemble(text, "fuzz.asm");
    if (!program.errors.empty()) {
        return 0;
    }
    const cordic::Assembled again = cordic::assemble(cordic::disassemble(program.image), "again.asm");
    expects(again.errors.empty() && again.image == program.image,
            "the disassembler's text assembles to the same image");
    cordic::Processor processor({}, program.image);
    processor.run(20'000);
    return 0;
}
