// Any bytes are a plot file: they give finite strokes within the budget and diagnostics with a byte; never a
// crash, a hang or a NaN.
#include "core/base/error.h"
#include "core/hpgl/reader.h"

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace {

using namespace millwright;       // NOLINT(google-build-using-namespace)
using namespace millwright::hpgl; // NOLINT(google-build-using-namespace)

void read(std::string_view bytes, const HpglSettings& settings) {
    try {
        const Plot plot = read_hpgl(bytes, "fuzz.plt", settings);
        std::int64_t points = 0;
        for (const plot::Stroke& stroke : plot.strokes) {
            expects(!stroke.points.empty(), "a stroke has a point");
            points += std::ssize(stroke.points);
            for (const Vec2& point : stroke.points) {
                expects(is_finite(point), "a point is finite");
            }
        }
        expects(points <= settings.most_points, "a plot keeps to its budget");
        expects(is_finite(plot.end), "the way of the pen is finite");
        for (const Diagnostic& diagnostic : plot.diagnostics) {
            expects(diagnostic.place.byte >= 0 && diagnostic.place.byte <= std::ssize(bytes) &&
                        !diagnostic.message.empty(),
                    "a diagnostic has a place and a reason");
        }
    } catch (const Error& error) {
        expects(error.diagnostic().place.byte >= 0, "an error has a place");
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    HpglSettings settings;
    settings.most_points = 20'000;
    read(bytes, settings);
    settings.strictness = Strictness::strict;
    settings.arc_tolerance = 0.01;
    settings.fill = FillMode::outline;
    read(bytes, settings);
    return 0;
}
