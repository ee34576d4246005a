// PGM and PPM, the binary kinds of Netpbm (P5 and P6) with samples of up to 16 bits. Source: the manual pages
// pgm(5) and ppm(5) of Netpbm.
#include "core/plot/picture/internal/row_sink.h"

#include <fmt/format.h>

#include <vector>

namespace millwright::plot::internal {
namespace {

constexpr std::int64_t most_value = 65535;

class PnmReader {
public:
    PnmReader(std::string_view bytes, RowSink& sink)
        : bytes_(bytes), sink_(sink), channels_(bytes[1] == '6' ? 3 : 1) {}

    void read() {
        const std::int64_t width = number("width");
        const std::int64_t height = number("height");
        most_ = number("largest value");
        if (most_ < 1 || most_ > most_value) {
            sink_.fail(fmt::format("the PNM has a largest value of {}, but 1 to 65535 are allowed", most_));
        }
        ++at_; // the one blank before the samples
        const bool bytes = most_ == 255;
        sink_.begin(width, height, {channels_, bytes ? 8 : 16});
        const std::int64_t samples = width * channels_;
        const std::int64_t stride = samples * (most_ > 255 ? 2 : 1);
        const std::int64_t needed = at_ + stride * height;
        if (needed > std::ssize(bytes_)) {
            sink_.fail(fmt::format(
                "the PNM is cut off: it has {} bytes, but its size needs {}", bytes_.size(), needed));
        }
        std::vector<std::uint16_t> row(bytes ? 0U : static_cast<std::size_t>(samples));
        for (int y = 0; y < height && !sink_.over_at(y); ++y) {
            const std::int64_t from = at_ + y * stride;
            if (bytes) {
                sink_.row(y, reinterpret_cast<const unsigned char*>(bytes_.data() + from));
            } else {
                read_row(from, row);
                sink_.row(y, reinterpret_cast<const unsigned char*>(row.data()));
            }
        }
    }

private:
    [[nodiscard]] unsigned byte(std::int64_t at) const {
        return static_cast<unsigned char>(bytes_[static_cast<std::size_t>(at)]);
    }
    [[nodiscard]] bool more() const { return at_ < std::ssize(bytes_); }
    [[nodiscard]] char here() const { return bytes_[static_cast<std::size_t>(at_)]; }
    [[nodiscard]] bool at_digit() const { return more() && here() >= '0' && here() <= '9'; }

    void skip_blanks_and_comments() {
        constexpr std::string_view blanks = " \t\n\v\f\r";
        while (more() && (blanks.find(here()) != std::string_view::npos || here() == '#')) {
            if (here() == '#') {
                const std::size_t end = bytes_.find('\n', static_cast<std::size_t>(at_));
                at_ = end == std::string_view::npos ? std::ssize(bytes_) : static_cast<std::int64_t>(end);
            } else {
                ++at_;
            }
        }
    }

    std::int64_t number(const char* what) {
        skip_blanks_and_comments();
        if (!at_digit()) {
            sink_.fail(fmt::format("the PNM has no {} at byte {}", what, at_));
        }
        std::int64_t value = 0;
        constexpr std::int64_t enough = 1'000'000'000;
        for (; at_digit(); ++at_) {
            value = value > enough ? value : 10 * value + (here() - '0');
        }
        return value;
    }

    void read_row(std::int64_t from, std::vector<std::uint16_t>& row) const {
        const bool wide = most_ > 255;
        for (std::uint16_t& sample : row) {
            const std::int64_t value = wide ? 256 * byte(from) + byte(from + 1) : byte(from);
            from += wide ? 2 : 1;
            if (value > most_) {
                sink_.fail(
                    fmt::format("the PNM has a sample of {}, above its largest value of {}", value, most_));
            }
            sample = static_cast<std::uint16_t>((value * white + most_ / 2) / most_);
        }
    }

    std::string_view bytes_;
    RowSink& sink_;
    int channels_;
    std::int64_t at_ = 2; ///< behind the magic number
    std::int64_t most_ = 255;
};

} // namespace

void read_pnm_rows(std::string_view bytes, RowSink& sink) {
    PnmReader(bytes, sink).read();
}

} // namespace millwright::plot::internal
