// Any G-code compiles for the CORDIC processor or is reported as wrong, and what compiles runs to a defined
// end.
#include "core/cordic/processor.h"
#include "core/cordic_machine/cordic_program.h"
#include "core/gcode/interpreter.h"

#include <cstddef>
#include <cstdint>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace millwright; // NOLINT(google-build-using-namespace)
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    cordic_machine::CordicProgramSettings settings;
    settings.chord_tolerance = 0.1;
    settings.leaves_out_other_axes = true;
    cordic_machine::CordicProgramBuilder builder("fuzz.ngc", settings);
    gcode::ReaderSettings reading;
    reading.most_errors = 10;
    reading.most_repeated_lines = 1000;
    reading.any_tool = true;
    gcode::Interpreter program(text, "fuzz.ngc", reading, builder);
    program.run();
    const cordic_machine::CordicProgram made = builder.take();
    if (made.image.code.size() <= cordic::most_code) {
        cordic::Processor processor({}, made.image);
        processor.run(50'000);
    }
    return 0;
}
