// Any bytes are either taught points, which are written and read back as the same, or an Error about the
// file.
#include "core/project/taught_points.h"

#include "core/base/error.h"

#include <cstddef>
#include <cstdint>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace millwright::project;
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    try {
        const auto points = taught_points_from_text(text, "fuzz.json");
        millwright::expects(taught_points_from_text(taught_points_text(points), "again.json") == points,
                            "points that were read are written and read back as the same");
        millwright::expects(faults_of(points).empty(), "points that were read have no faults");
    } catch (const millwright::Error& error) {
        millwright::expects(error.diagnostic().place.file == "fuzz.json",
                            "an error names the file that was read");
    }
    return 0;
}
