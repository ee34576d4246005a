#include "core/pmac_service/scale_calibration.h"

#include "core/base/error.h"
#include "core/base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <string>
#include <utility>

namespace millwright::pmac {

namespace {

constexpr std::string_view between = " \t,;\r";
constexpr int most_motors = 8; // of a PMAC

[[noreturn]] void fail(const std::filesystem::path& file, int line, std::size_t column, std::string message) {
    throw Error(Diagnostic{.place = {.file = file, .line = line, .column = static_cast<int>(column) + 1},
                           .message = std::move(message),
                           .hint = "write lines of: motor counts angle"});
}

/// The numbers of a line, each with its column.
class Words {
public:
    Words(std::string_view line, const std::filesystem::path& file, int number)
        : line_(line.substr(0, line.find('#'))), file_(file), number_(number) {
        skip();
    }
    [[nodiscard]] bool at_end() const { return at_ == line_.size(); }
    [[nodiscard]] std::size_t column() const { return at_; }
    [[nodiscard]] double next(std::string_view what) {
        double value = 0.0;
        const char* begin = line_.data() + at_;
        const char* end = line_.data() + line_.size();
        const auto [stop, failure] = std::from_chars(begin, end, value);
        const bool ends = stop == end || between.find(*stop) != std::string_view::npos;
        if (failure != std::errc() || !ends || !std::isfinite(value)) {
            fail(file_, number_, at_, fmt::format("{} is expected here", what));
        }
        at_ += static_cast<std::size_t>(stop - begin);
        skip();
        return value;
    }

private:
    void skip() { at_ = std::min(line_.find_first_not_of(between, at_), line_.size()); }

    std::string_view line_;
    const std::filesystem::path& file_;
    int number_;
    std::size_t at_ = 0;
};

ScaleFit fit(int motor, const std::vector<ScaleReading>& readings) {
    const auto count = static_cast<double>(readings.size());
    double mean_counts = 0.0, mean_angle = 0.0;
    for (const ScaleReading& reading : readings) {
        mean_counts += reading.counts / count;
        mean_angle += reading.angle / count;
    }
    double squares = 0.0, product = 0.0;
    for (const ScaleReading& reading : readings) {
        squares += (reading.counts - mean_counts) * (reading.counts - mean_counts);
        product += (reading.counts - mean_counts) * (reading.angle - mean_angle);
    }
    const double slope = squares > 0.0 ? product / squares : 0.0; // deg per count
    if (!(std::abs(slope) > 0.0)) {
        throw Error(
            fmt::format("motor {}: at least two readings at different counts and angles are needed", motor));
    }
    ScaleFit result{.motor = motor,
                    .counts_per_degree = 1.0 / slope,
                    .counts_at_zero = mean_counts - mean_angle / slope,
                    .readings = static_cast<int>(readings.size())};
    double left = 0.0;
    for (const ScaleReading& reading : readings) {
        const double off = reading.angle - mean_angle - slope * (reading.counts - mean_counts);
        left += off * off;
        if (std::abs(off) >= std::abs(result.worst)) {
            result.worst = off;
            result.worst_line = reading.line;
        }
    }
    result.rms = std::sqrt(left / count);
    if (readings.size() > 2) {
        const double slope_error = std::sqrt(left / (count - 2.0) / squares);
        result.counts_per_degree_error = slope_error / (slope * slope);
    }
    return result;
}

} // namespace

std::vector<ScaleReading> parse_scale_readings(std::string_view text, const std::filesystem::path& file) {
    std::vector<ScaleReading> readings;
    refuse_wide_text(text, file);
    text = without_byte_order_mark(text);
    for (int number = 1; !text.empty(); ++number) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        Words words(text.substr(0, end), file, number);
        text.remove_prefix(std::min(end + 1, text.size()));
        if (words.at_end()) {
            continue;
        }
        const std::size_t column = words.column();
        const double motor = words.next("the number of a motor");
        if (!(motor >= 1.0 && motor <= most_motors) || std::abs(motor - std::round(motor)) > 0.0) {
            fail(file, number, column, fmt::format("a motor number must be from 1 to {}", most_motors));
        }
        const double counts = words.next("the motor position in counts");
        const double angle = words.next("the measured angle in degrees");
        if (!words.at_end()) {
            fail(file, number, words.column(), "the line has extra text at its end");
        }
        readings.push_back({static_cast<int>(motor), counts, angle, number});
    }
    return readings;
}

std::vector<ScaleFit> fit_scales(std::span<const ScaleReading> readings) {
    std::map<int, std::vector<ScaleReading>> of_motor;
    for (const ScaleReading& reading : readings) {
        of_motor[reading.motor].push_back(reading);
    }
    std::vector<ScaleFit> fits;
    for (const auto& [motor, its] : of_motor) {
        fits.push_back(fit(motor, its));
    }
    return fits;
}

} // namespace millwright::pmac
