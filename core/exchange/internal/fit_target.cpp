#include "core/exchange/internal/fit_target.h"

#include <cmath>

namespace millwright::exchange {

std::vector<Spread> spread_over(const TriangleMesh& mesh, double area, int count) {
    constexpr double plastic = 1.32471795724474602596;
    const double step = area / count;
    std::vector<Spread> samples;
    samples.reserve(static_cast<std::size_t>(count));
    double passed = 0.0;
    for (std::size_t n = 0; n < mesh.triangles.size(); ++n) {
        passed += 0.5 * mesh.doubled_area(n).norm();
        while ((static_cast<double>(samples.size()) + 0.5) * step < passed && std::ssize(samples) < count) {
            const double k = static_cast<double>(samples.size()) + 1.0;
            double whole = 0.0;
            double s = std::modf(0.5 + k / plastic, &whole);
            double t = std::modf(0.5 + k / (plastic * plastic), &whole);
            if (s + t > 1.0) {
                s = 1.0 - s;
                t = 1.0 - t;
            }
            samples.push_back({mesh.triangles[n], {1.0 - s - t, s, t}});
        }
    }
    return samples;
}

} // namespace millwright::exchange
