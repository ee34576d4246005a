#include "core/plot/picture/internal/row_sink.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <string_view>

namespace millwright::plot::internal {

// The run-length codes of a BMP of 4 or 8 bits. Source: Microsoft, Windows GDI, bitmap compression.

/// Reads rows from the lowest upward, as they are stored. Pixels that the codes jump over have index 0.
class BmpRuns {
public:
    /// `bytes` is the file, whose codes begin at byte `at`; `bits` is 4 or 8.
    BmpRuns(std::string_view bytes, std::int64_t at, int bits, RowSink& sink)
        : bytes_(bytes), at_(at), bits_(bits), sink_(sink) {}

    /// Fills `indices` with the next row up. Throws by the sink, with the byte, for codes that leave the row
    /// and where the file ends before the code that ends the picture.
    void next_row(std::span<unsigned char> indices);

private:
    enum class Escape : unsigned char { end_of_row = 0, end_of_picture = 1, jump = 2 };

    [[nodiscard]] unsigned char next_byte();
    /// The index of pixel `n` of a run or of literal pixels, in `pair` of two of 4 bits or one of 8.
    [[nodiscard]] unsigned char index_of(unsigned char pair, int n) const;
    void repeat(std::span<unsigned char> indices, int count);
    void copy(std::span<unsigned char> indices, int count);
    void jump(std::span<const unsigned char> indices);
    void check_room(std::span<const unsigned char> indices, int count) const;

    std::string_view bytes_;
    std::int64_t at_;
    int bits_;
    RowSink& sink_;
    std::int64_t code_at_ = 0; ///< byte of the code that is being obeyed
    std::int64_t x_ = 0;
    int rows_to_pass_ = 0; ///< that a jump left without a pixel
    bool ended_ = false;
};

void BmpRuns::next_row(std::span<unsigned char> indices) {
    std::ranges::fill(indices, static_cast<unsigned char>(0));
    if (ended_) {
        return;
    }
    if (rows_to_pass_ > 0 && --rows_to_pass_ > 0) {
        return;
    }
    for (bool row_ends = false; !row_ends;) {
        code_at_ = at_;
        const int count = next_byte();
        if (count > 0) {
            repeat(indices, count);
            continue;
        }
        const int what = next_byte();
        switch (static_cast<Escape>(what)) {
        case Escape::end_of_row:
            x_ = 0;
            row_ends = true;
            break;
        case Escape::end_of_picture:
            ended_ = true;
            row_ends = true;
            break;
        case Escape::jump:
            jump(indices);
            row_ends = rows_to_pass_ > 0;
            break;
        default:
            copy(indices, what);
        }
    }
}

unsigned char BmpRuns::next_byte() {
    if (at_ >= std::ssize(bytes_)) {
        sink_.fail(fmt::format("the BMP is cut off at byte {}, before the end code", bytes_.size()));
    }
    return static_cast<unsigned char>(bytes_[static_cast<std::size_t>(at_++)]);
}

unsigned char BmpRuns::index_of(unsigned char pair, int n) const {
    if (bits_ == 8) {
        return pair;
    }
    return n % 2 == 0 ? static_cast<unsigned char>(pair >> 4U) : static_cast<unsigned char>(pair & 15U);
}

void BmpRuns::repeat(std::span<unsigned char> indices, int count) {
    check_room(indices, count);
    const unsigned char pair = next_byte();
    for (int n = 0; n < count; ++n) {
        indices[static_cast<std::size_t>(x_++)] = index_of(pair, n);
    }
}

void BmpRuns::copy(std::span<unsigned char> indices, int count) {
    check_room(indices, count);
    const int in_byte = 8 / bits_;
    unsigned char pair = 0;
    for (int n = 0; n < count; ++n) {
        if (n % in_byte == 0) {
            pair = next_byte();
        }
        indices[static_cast<std::size_t>(x_++)] = index_of(pair, n);
    }
    const bool odd = (count + in_byte - 1) / in_byte % 2 != 0;
    if (odd) {
        (void)next_byte(); // literal pixels fill words of 16 bits
    }
}

void BmpRuns::jump(std::span<const unsigned char> indices) {
    const int right = next_byte();
    rows_to_pass_ = next_byte();
    check_room(indices, right);
    x_ += right;
}

void BmpRuns::check_room(std::span<const unsigned char> indices, int count) const {
    const auto width = std::ssize(indices);
    if (x_ + count > width) {
        sink_.fail(fmt::format("the run at byte {} of the BMP ends at column {}, beyond the width of {}",
                               code_at_,
                               x_ + count,
                               width));
    }
}

// BMP: pixels of 1, 4, 8, 16, 24 or 32 bits, and run-length codes. Source: Microsoft, Windows GDI, bitmap
// structures.

namespace {

constexpr std::int64_t file_head = 14;
constexpr std::uint32_t core_head = 12; // OS/2
constexpr std::uint32_t info_head = 40;
constexpr std::uint32_t largest_head = 124; // version 5
constexpr std::uint32_t uncompressed = 0;
constexpr std::uint32_t runs_of_8 = 1;
constexpr std::uint32_t runs_of_4 = 2;
constexpr std::uint32_t bit_fields = 3;
constexpr std::uint32_t alpha_bit_fields = 6;

struct Rgb {
    unsigned char r = 0, g = 0, b = 0;
};

/// One colour's bits in a pixel of 16 or 32.
class Field {
public:
    explicit Field(std::uint32_t mask) : mask_(mask), shift_(mask == 0 ? 0 : std::countr_zero(mask)) {}

    [[nodiscard]] unsigned char of(std::uint32_t pixel) const {
        const std::uint64_t most = mask_ >> shift_;
        const std::uint64_t value = (pixel & mask_) >> shift_;
        if (most == 0) {
            return 0;
        }
        return static_cast<unsigned char>((value * 255 + most / 2) / most);
    }
    [[nodiscard]] bool contiguous() const { return std::has_single_bit(std::uint64_t{mask_ >> shift_} + 1); }

private:
    std::uint32_t mask_;
    int shift_;
};

class BmpReader {
public:
    BmpReader(std::string_view bytes, RowSink& sink) : bytes_(bytes), sink_(sink) {}

    void read() {
        read_head();
        sink_.begin(width_, height_, {3, 8});
        sink_.set_pixels_per_mm(pixels_per_metre_ / 1000.0, rows_per_metre_ / 1000.0);
        if (in_runs_) {
            read_runs();
        } else {
            read_pixels();
        }
    }

private:
    void read_runs() {
        // A code of two bytes holds up to 255 pixels; what is far beyond that would only take time.
        constexpr std::int64_t empty_pixels = 4'000'000;
        if (width_ * height_ > 128 * std::ssize(bytes_) + empty_pixels) {
            sink_.fail(fmt::format("the BMP of {} bytes is too small for the {} x {} pixels in its header",
                                   bytes_.size(),
                                   width_,
                                   height_));
        }
        BmpRuns runs(bytes_, pixels_, bits_, sink_);
        std::vector<unsigned char> indices(static_cast<std::size_t>(width_));
        std::vector<Rgb> row(indices.size());
        for (auto y = static_cast<int>(height_) - 1; y >= 0; --y) {
            runs.next_row(indices);
            std::ranges::transform(indices, row.begin(), [&](unsigned char index) { return color(index); });
            sink_.row(y, &row.front().r);
        }
    }

    void read_pixels() {
        const std::int64_t stride = (width_ * bits_ + 31) / 32 * 4;
        const std::int64_t needed = pixels_ + stride * height_;
        if (needed > std::ssize(bytes_)) {
            sink_.fail(fmt::format(
                "the BMP is cut off: it has {} bytes, but its size needs {}", bytes_.size(), needed));
        }
        std::vector<Rgb> row(static_cast<std::size_t>(width_));
        for (int y = 0; y < height_ && !sink_.over_at(y); ++y) {
            const std::int64_t line = top_down_ ? y : height_ - 1 - y;
            read_row(pixels_ + line * stride, row);
            sink_.row(y, &row.front().r);
        }
    }

    [[nodiscard]] std::uint32_t number(std::int64_t at, int count) const {
        if (at < 0 || at + count > std::ssize(bytes_)) {
            sink_.fail(fmt::format("the BMP is cut off at byte {}", bytes_.size()));
        }
        std::uint32_t value = 0;
        for (int n = 0; n < count; ++n) {
            const auto byte = static_cast<unsigned char>(bytes_[static_cast<std::size_t>(at + n)]);
            value |= std::uint32_t{byte} << (8 * n);
        }
        return value;
    }
    [[nodiscard]] std::uint32_t word(std::int64_t at) const { return number(at, 4); }
    [[nodiscard]] std::int32_t signed_word(std::int64_t at) const {
        return static_cast<std::int32_t>(word(at));
    }

    void read_head() {
        pixels_ = word(10);
        const std::uint32_t head = word(file_head);
        const bool small = head == core_head;
        if (!small && (head < info_head || head > largest_head)) {
            sink_.fail(fmt::format("the BMP has a header of {} bytes, which is not a known size", head));
        }
        width_ = small ? std::int64_t{number(18, 2)} : signed_word(18);
        height_ = small ? std::int64_t{number(20, 2)} : signed_word(22);
        top_down_ = height_ < 0;
        height_ = std::abs(height_);
        bits_ = static_cast<int>(number(small ? 24 : 28, 2));
        const std::uint32_t compression = small ? uncompressed : word(30);
        pixels_per_metre_ = small ? 0 : signed_word(38);
        rows_per_metre_ = small ? 0 : signed_word(42);
        check_kind(compression);
        if (bits_ <= 8) {
            read_palette(file_head + head, small ? 3 : 4, small ? 0 : word(46));
        } else if (compression != uncompressed) {
            constexpr std::int64_t masks = file_head + info_head;
            take_fields(word(masks), word(masks + 4), word(masks + 8));
        } else if (bits_ == 16) {
            take_fields(0x7c00, 0x03e0, 0x001f);
        } else {
            take_fields(0xff0000, 0x00ff00, 0x0000ff);
        }
    }

    void check_kind(std::uint32_t compression) {
        const bool known =
            bits_ == 1 || bits_ == 4 || bits_ == 8 || bits_ == 16 || bits_ == 24 || bits_ == 32;
        if (!known) {
            sink_.fail(fmt::format("the BMP has pixels of {} bits, which is not supported", bits_));
        }
        in_runs_ = (compression == runs_of_8 && bits_ == 8) || (compression == runs_of_4 && bits_ == 4);
        if (in_runs_ && top_down_) {
            sink_.fail("the BMP is run-length encoded and stored top-down, which is not allowed");
        }
        const bool fields =
            (compression == bit_fields || compression == alpha_bit_fields) && (bits_ == 16 || bits_ == 32);
        if (compression != uncompressed && !in_runs_ && !fields) {
            sink_.fail(fmt::format("the BMP's pixels of {} bits use an unsupported compression (type {})",
                                   bits_,
                                   compression),
                       "save it uncompressed, or as PNG");
        }
    }

    void read_palette(std::int64_t at, int size, std::uint32_t count) {
        const std::uint32_t most = 1U << bits_;
        count = count == 0 ? most : count;
        if (count > most) {
            sink_.fail(
                fmt::format("the BMP has {} colours, but {} bits can only hold {}", count, bits_, most));
        }
        for (std::uint32_t n = 0; n < count; ++n) {
            const std::int64_t color = at + std::int64_t{n} * size;
            palette_[n] = {static_cast<unsigned char>(number(color + 2, 1)),
                           static_cast<unsigned char>(number(color + 1, 1)),
                           static_cast<unsigned char>(number(color, 1))};
        }
        colors_ = count;
    }

    void take_fields(std::uint32_t red, std::uint32_t green, std::uint32_t blue) {
        fields_ = {Field(red), Field(green), Field(blue)};
        for (const Field& field : fields_) {
            if (!field.contiguous()) {
                sink_.fail("the BMP spreads a colour over bits that are not contiguous");
            }
        }
    }

    void read_row(std::int64_t at, std::vector<Rgb>& row) const {
        const auto* bytes = reinterpret_cast<const unsigned char*>(bytes_.data()) + at;
        for (std::size_t x = 0; x < row.size(); ++x) {
            row[x] = bits_ <= 8 ? from_palette(bytes, x) : from_fields(bytes, x);
        }
    }

    [[nodiscard]] Rgb from_palette(const unsigned char* bytes, std::size_t x) const {
        const auto bits = static_cast<std::size_t>(bits_);
        const std::size_t bit = x * bits;
        const std::uint32_t index = (bytes[bit / 8] >> (8 - bits - bit % 8)) & ((1U << bits) - 1);
        return color(index);
    }

    [[nodiscard]] Rgb color(std::uint32_t index) const {
        if (index >= colors_) {
            sink_.fail(
                fmt::format("a pixel of the BMP has colour {}, but there are only {}", index + 1, colors_));
        }
        return palette_[index];
    }

    [[nodiscard]] Rgb from_fields(const unsigned char* bytes, std::size_t x) const {
        const auto size = static_cast<std::size_t>(bits_) / 8;
        std::uint32_t pixel = 0;
        for (std::size_t n = 0; n < size; ++n) {
            pixel |= std::uint32_t{bytes[x * size + n]} << (8 * n);
        }
        return {fields_[0].of(pixel), fields_[1].of(pixel), fields_[2].of(pixel)};
    }

    std::string_view bytes_;
    RowSink& sink_;
    std::int64_t pixels_ = 0; ///< byte of the first row that is stored
    std::int64_t width_ = 0;
    std::int64_t height_ = 0;
    bool top_down_ = false;
    bool in_runs_ = false; ///< its pixels are run-length codes
    int bits_ = 24;
    std::int32_t pixels_per_metre_ = 0;
    std::int32_t rows_per_metre_ = 0;
    std::array<Rgb, 256> palette_ = {};
    std::uint32_t colors_ = 0;
    std::array<Field, 3> fields_ = {Field(0), Field(0), Field(0)};
};

} // namespace

void read_bmp_rows(std::string_view bytes, RowSink& sink) {
    BmpReader(bytes, sink).read();
}

} // namespace millwright::plot::internal
