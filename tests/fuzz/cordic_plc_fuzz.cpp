// Any logic assembles or is reported as wrong, and what assembles runs beside the processor to a defined end.
#include "core/cordic/assembler.h"
#include "core/cordic_control/plc_assembler.h"
#include "core/cordic_control/supervised_run.h"

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <utility>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace millwright::cordic; // NOLINT(google-build-using-namespace)
    static const Assembled program =
        assemble("MOV Vmax, 50\nMOV XI, 1\nM03\nG01\nM00\nMOV P, 117\nMUSER\nG04\nM30\n", "fuzz.asm");
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    const std::string_view logic = text.substr(0, text.find('#'));
    PlcProgram made = assemble_plc(logic, "fuzz.plc");
    ReadInputs inputs =
        read_inputs(text.substr(logic.size() == text.size() ? size : logic.size() + 1), "fuzz");
    if (made.errors.empty()) {
        Processor processor({}, program.image);
        Plc plc(std::move(made));
        SupervisedSettings settings;
        settings.inputs = std::move(inputs.changes);
        settings.most_seconds = 0.1;
        (void)run_supervised(processor, plc, settings);
    }
    return 0;
}
