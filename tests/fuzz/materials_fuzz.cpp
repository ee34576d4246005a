// Any bytes are either a table of materials, whose values are finite and above 0 for every tool, or an Error
// about the file.
#include "core/base/error.h"
#include "core/plot/material_table.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>

using namespace millwright;       // NOLINT(google-build-using-namespace)
using namespace millwright::plot; // NOLINT(google-build-using-namespace)

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    try {
        for (const Material& material : read_materials(text, "fuzz.json")) {
            for (const double tool : {1e-3, 0.1, 3.0, 25.4, 1000.0}) {
                const CuttingValues values = material.values(tool);
                for (const Sourced* number :
                     {&values.feed, &values.plunge, &values.depth_per_pass, &values.spindle_rpm}) {
                    expects(number->value > 0.0 && std::isfinite(number->value),
                            "a value of a material is finite and above 0");
                }
            }
        }
    } catch (const Error& error) {
        expects(error.diagnostic().place.file == "fuzz.json", "an error names the file that was read");
    }
    return 0;
}
