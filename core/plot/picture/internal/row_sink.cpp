#include "core/plot/picture/internal/row_sink.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <utility>
#include <vector>

namespace millwright::plot::internal {

Picture with_rows(const Picture& picture, int rows) {
    Picture result = picture;
    result.height = rows;
    result.gray.assign(static_cast<std::size_t>(rows) * static_cast<std::size_t>(picture.width), 0);
    const double step = static_cast<double>(picture.height) / rows;
    std::vector<double> sums(static_cast<std::size_t>(picture.width));
    for (int row = 0; row < rows; ++row) {
        std::ranges::fill(sums, 0.0);
        const double from = row * step;
        const double to = std::min<double>(from + step, picture.height);
        for (int n = static_cast<int>(from); n < picture.height && n < to; ++n) {
            const double share = std::min(to, n + 1.0) - std::max<double>(from, n);
            for (int column = 0; column < picture.width; ++column) {
                sums[static_cast<std::size_t>(column)] += share * picture.at(n, column);
            }
        }
        for (std::size_t column = 0; column < sums.size(); ++column) {
            result.gray[static_cast<std::size_t>(row) * sums.size() + column] =
                static_cast<std::uint16_t>(std::clamp(std::round(sums[column] / (to - from)), 0.0, 65535.0));
        }
    }
    return result;
}

namespace {

constexpr std::int64_t largest_side = 1'000'000;
constexpr std::int64_t most_source_pixels = 4'000'000'000; // hours of reading lie beyond

/// A sample as 16 bits.
template <typename Sample> std::uint32_t sample(const unsigned char* pixel, int channel) {
    Sample value = 0;
    std::memcpy(&value, pixel + static_cast<std::size_t>(channel) * sizeof(Sample), sizeof(Sample));
    return value;
}

template <typename Sample> struct Scale {
    static constexpr std::uint32_t most = sizeof(Sample) == 1 ? 255 : 65535;
    static constexpr std::uint32_t to_16_bits = sizeof(Sample) == 1 ? 257 : 1;
};

/// Brightness of 16 bits; the thesis's rule cuts the fraction off at the file's own bits.
template <typename Sample> std::uint32_t gray_of(const unsigned char* pixel, GrayRule rule) {
    const std::uint32_t r = sample<Sample>(pixel, 0);
    const std::uint32_t g = sample<Sample>(pixel, 1);
    const std::uint32_t b = sample<Sample>(pixel, 2);
    constexpr std::uint32_t scale = Scale<Sample>::to_16_bits;
    if (rule == GrayRule::mean) {
        return (r + g + b) / 3 * scale;
    }
    return static_cast<std::uint32_t>(
        (std::uint64_t{2126} * r + std::uint64_t{7152} * g + std::uint64_t{722} * b) * scale / 10'000);
}

std::uint32_t over_ground(std::uint32_t gray, std::uint32_t opacity, std::uint32_t ground) {
    const std::uint64_t most = white;
    return static_cast<std::uint32_t>((gray * std::uint64_t{opacity} + ground * (most - opacity) + most / 2) /
                                      most);
}

/// The pixels as brightness; whether one of them was transparent. What is transparent is no part of what is
/// inverted.
template <typename Sample>
bool brighten(const unsigned char* pixel,
              int channels,
              const PictureSettings& settings,
              std::vector<std::uint16_t>& line) {
    constexpr std::uint32_t scale = Scale<Sample>::to_16_bits;
    bool transparent = false;
    for (std::uint16_t& to : line) {
        std::uint32_t gray =
            channels >= 3 ? gray_of<Sample>(pixel, settings.gray) : sample<Sample>(pixel, 0) * scale;
        gray = settings.invert ? white - gray : gray;
        if (channels % 2 == 0) {
            const std::uint32_t opacity = sample<Sample>(pixel, channels - 1) * scale;
            transparent = transparent || opacity < white;
            gray = over_ground(gray, opacity, settings.ground);
        }
        to = static_cast<std::uint16_t>(gray);
        pixel += static_cast<std::size_t>(channels) * sizeof(Sample);
    }
    return transparent;
}

} // namespace

PixelRegion up_to_edge(PixelRegion region, int width, int height) {
    region.width = region.width == 0 ? width - region.left : region.width;
    region.height = region.height == 0 ? height - region.top : region.height;
    return region;
}

void RowSink::begin(std::int64_t width, std::int64_t height, RowFormat format) {
    if (width < 1 || height < 1) {
        fail(fmt::format("a picture of {} x {} pixels is not possible", width, height));
    }
    if (width > largest_side || height > largest_side || width * height > most_source_pixels) {
        fail(fmt::format("a picture of {} x {} pixels is too large", width, height),
             "use a picture of at most 4,000 million pixels");
    }
    format_ = format;
    region_ = up_to_edge(
        settings_.region.value_or(PixelRegion{}), static_cast<int>(width), static_cast<int>(height));
    const auto inside = [](std::int64_t from, std::int64_t count, std::int64_t all) {
        return from >= 0 && count >= 1 && from + count <= all;
    };
    if (!inside(region_.left, region_.width, width) || !inside(region_.top, region_.height, height)) {
        fail(fmt::format("the region of {} x {} pixels from ({}, {}) extends beyond the picture of {} x {}",
                         region_.width,
                         region_.height,
                         region_.left,
                         region_.top,
                         width,
                         height));
    }
    const auto squares = [&](std::int64_t side) {
        return ((region_.width + side - 1) / side) * ((region_.height + side - 1) / side);
    };
    while (squares(square_) > std::max<std::int64_t>(settings_.most_pixels, 1)) {
        ++square_;
    }
    read_.picture.width = (region_.width + square_ - 1) / square_;
    read_.picture.height = (region_.height + square_ - 1) / square_;
    read_.picture.gray.resize(static_cast<std::size_t>(squares(square_)));
    line_.resize(static_cast<std::size_t>(region_.width));
    if (square_ > 1) {
        sums_.resize(static_cast<std::size_t>(read_.picture.width));
        notice(fmt::format("{} x {} pixels are averaged over squares of {}, which leaves {} x {}",
                           region_.width,
                           region_.height,
                           square_,
                           read_.picture.width,
                           read_.picture.height));
    }
}

void RowSink::set_pixels_per_mm(double across, double down) {
    constexpr double densest = 1e4;
    const auto possible = [](double density) {
        return std::isfinite(density) && density > 0.0 && density < densest;
    };
    if (possible(across)) {
        read_.picture.pixels_per_mm = across;
        set_pixel_shape(across, possible(down) ? down : across);
    }
}

void RowSink::set_pixel_shape(double across, double down) {
    constexpr double longest = 10.0; // a pixel that is longer is a damaged number
    if (across > 0.0 && down > 0.0 && across < longest * down && down < longest * across) {
        height_of_width_ = across / down;
    }
}

void RowSink::row(int y, const unsigned char* samples) {
    const int line = y - region_.top;
    if (line < 0 || line >= region_.height) {
        return;
    }
    progress_.check();
    progress_.report(static_cast<double>(lines_) / region_.height);
    const auto stride = static_cast<std::size_t>(format_.channels * format_.bits / 8);
    const unsigned char* first = samples + stride * static_cast<std::size_t>(region_.left);
    const auto brightened = format_.bits == 16 ? brighten<std::uint16_t> : brighten<std::uint8_t>;
    transparent_ = brightened(first, format_.channels, settings_, line_) || transparent_;
    if (square_ > 1) {
        add_to_block(line);
    } else {
        std::ranges::copy(line_, read_.picture.gray.begin() + std::ptrdiff_t{line} * region_.width);
    }
    ++lines_;
}

void RowSink::add_to_block(int line) {
    if (line / square_ != sums_row_) {
        flush_block();
        sums_row_ = line / square_;
    }
    for (std::size_t n = 0; n < line_.size(); ++n) {
        sums_[n / static_cast<std::size_t>(square_)] += line_[n];
    }
    ++sums_lines_;
}

void RowSink::flush_block() {
    if (sums_lines_ == 0) {
        return;
    }
    const auto width = static_cast<int>(sums_.size());
    for (int n = 0; n < width; ++n) {
        const int columns = std::min(square_, region_.width - n * square_);
        const auto count = static_cast<std::uint64_t>(columns) * static_cast<std::uint64_t>(sums_lines_);
        std::uint64_t& sum = sums_[static_cast<std::size_t>(n)];
        read_.picture.gray[static_cast<std::size_t>(std::ptrdiff_t{sums_row_} * width + n)] =
            static_cast<std::uint16_t>((sum + count / 2) / count);
        sum = 0;
    }
    sums_lines_ = 0;
}

void RowSink::notice(std::string message, std::string hint) {
    read_.notices.push_back({Place{.file = file_}, std::move(message), std::move(hint)});
}

void RowSink::fail(std::string message, std::string hint) const {
    throw Error(std::move(message), file_, std::move(hint));
}

void RowSink::allow_memory(std::int64_t bytes, const std::string& what) const {
    if (bytes > settings_.most_memory) {
        constexpr std::int64_t megabyte = 1'000'000;
        fail(fmt::format("{} of this size needs {} MB at once, but only {} are allowed",
                         what,
                         bytes / megabyte,
                         settings_.most_memory / megabyte),
             "save it as a plain picture, neither interlaced nor progressive");
    }
}

/// A pixel is as wide as high in all that follows.
void RowSink::square_pixels(PixelShape& shape) {
    Picture& picture = read_.picture;
    const double height = std::round(picture.height * height_of_width_);
    constexpr double rounded = 1e-3; // densities are whole numbers
    if (std::abs(height_of_width_ - 1.0) < rounded || height < 1.0) {
        return;
    }
    if (shape.stays) {
        shape.height = height_of_width_;
        return;
    }
    if (height * picture.width > static_cast<double>(settings_.most_pixels)) {
        fail(fmt::format("the pixels are {:.4g} times as high as wide: with square pixels the picture would "
                         "have {:.0f} rows, which is too many",
                         height_of_width_,
                         height),
             "save it with square pixels");
    }
    notice(fmt::format(
        "the pixels are {:.4g} times as high as wide: {} rows become {:.0f} rows of square pixels",
        height_of_width_,
        picture.height,
        height));
    picture = with_rows(picture, static_cast<int>(height));
}

ReadPicture RowSink::end(PixelShape& shape) {
    expects(lines_ == region_.height, "a decoder hands in every row of the region");
    flush_block();
    read_.picture.file_pixels = square_;
    if (square_ > 1 && read_.picture.pixels_per_mm) {
        *read_.picture.pixels_per_mm /= square_;
    }
    if (transparent_) {
        notice("transparent pixels are not cut");
    }
    square_pixels(shape);
    return std::move(read_);
}

} // namespace millwright::plot::internal
