// Any bytes are a point file or a path file: what is read is finite, and a path that is read is written as it
// was.
#include "core/base/error.h"
#include "core/plot/path_file.h"
#include "core/plot/point_file.h"

#include <cstddef>
#include <cstdint>
#include <string_view>

using namespace millwright;       // NOLINT(google-build-using-namespace)
using namespace millwright::plot; // NOLINT(google-build-using-namespace)

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    for (const Vec3& point : read_points(bytes, "fuzz.csv").points) {
        expects(is_finite(point), "a point is finite");
    }
    // With the title of a path file before them, or no path file would ever be found.
    for (const std::string& text : {std::string(bytes), path_file_text({}) + std::string(bytes)}) {
        try {
            const CutPath path = read_path(text, "fuzz.path");
            expects(read_path(path_file_text(path), "again.path") == path, "a path comes back");
        } catch (const Error& error) {
            expects(error.diagnostic().place.line >= 1, "an error has a line");
        }
    }
    return 0;
}
