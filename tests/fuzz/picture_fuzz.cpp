// Any bytes are a picture file: they give as many pixels as their size says, within the budget, or an error
// with its file; never a crash or a hang. What can be read is traced and cut.
#include "core/base/error.h"
#include "core/plot/picture/relief.h"
#include "core/plot/picture/trace.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace {

using namespace millwright;       // NOLINT(google-build-using-namespace)
using namespace millwright::plot; // NOLINT(google-build-using-namespace)

void use(const Picture& picture) {
    for (const TracedPath& path : trace(picture)) {
        expects(!path.curves.empty() && is_finite(path.start), "an outline is finite");
    }
    ReliefSettings settings;
    settings.step_over = 0.7;
    for (const CutPoint& point : relief(height_field(picture, 0.5, 1.0), settings)) {
        expects(is_finite(point.at) && point.at.z() >= -1.0 - 1e-5, "a relief is finite and not too deep");
    }
}

void read(std::string_view bytes, const PictureSettings& settings) {
    try {
        const Picture picture = read_picture(bytes, "fuzz.png", settings).picture;
        const auto pixels =
            static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height);
        expects(picture.gray.size() == pixels && pixels >= 1,
                "a picture has as many pixels as its size says");
        expects(static_cast<std::int64_t>(pixels) <= settings.most_pixels, "a picture keeps to its budget");
        use(picture);
    } catch (const Error& error) {
        expects(error.diagnostic().place.file == "fuzz.png", "an error has its file");
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    PictureSettings settings;
    settings.most_pixels = 500;
    settings.most_memory = 1'000'000;
    read(bytes, settings);
    settings.region = PixelRegion{1, 1, 3, 2};
    settings.gray = GrayRule::luminance;
    settings.invert = true;
    read(bytes, settings);
    return 0;
}
