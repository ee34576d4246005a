#include "core/exchange/internal/mesh_readers.h"
#include "core/exchange/internal/word_lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <utility>

namespace millwright::exchange {

namespace {

enum class Order { text, little, big };
enum class Scalar { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

struct Property {
    std::string_view name;
    Scalar type = Scalar::float32;
    std::optional<Scalar> count; ///< of a list: the type of its length
};

struct Element {
    std::string_view name;
    std::int64_t count = 0;
    std::vector<Property> properties;
};

struct Head {
    Order order = Order::text;
    std::vector<Element> elements;
};

std::optional<Scalar> scalar_named(std::string_view word) {
    constexpr std::array<std::pair<std::string_view, Scalar>, 16> names{{{"char", Scalar::int8},
                                                                         {"int8", Scalar::int8},
                                                                         {"uchar", Scalar::uint8},
                                                                         {"uint8", Scalar::uint8},
                                                                         {"short", Scalar::int16},
                                                                         {"int16", Scalar::int16},
                                                                         {"ushort", Scalar::uint16},
                                                                         {"uint16", Scalar::uint16},
                                                                         {"int", Scalar::int32},
                                                                         {"int32", Scalar::int32},
                                                                         {"uint", Scalar::uint32},
                                                                         {"uint32", Scalar::uint32},
                                                                         {"float", Scalar::float32},
                                                                         {"float32", Scalar::float32},
                                                                         {"double", Scalar::float64},
                                                                         {"float64", Scalar::float64}}};
    const auto* const found = std::ranges::find(names, word, &std::pair<std::string_view, Scalar>::first);
    return found == names.end() ? std::nullopt : std::optional(found->second);
}

class HeadReader {
public:
    HeadReader(WordLines& lines, const PolygonSoup& soup) : lines_(lines), soup_(soup) {}

    [[nodiscard]] Head read() {
        const auto* first = lines_.next();
        if (first == nullptr || first->size() != 1 || first->front() != "ply") {
            soup_.fail("a PLY file must start with the word ply", 1);
        }
        while (const auto* words = lines_.next()) {
            if (words->empty() || words->front() == "comment" || words->front() == "obj_info") {
                continue;
            }
            if (words->front() == "end_header") {
                return std::move(head_);
            }
            take(*words);
        }
        soup_.fail("the header has no end_header", lines_.number());
    }

private:
    void take(const std::vector<std::string_view>& words) {
        if (words[0] == "format" && words.size() == 3) {
            head_.order = order_named(words[1]);
        } else if (words[0] == "element" && words.size() == 3) {
            const auto count = number_from<std::int64_t>(words[2]);
            // Each takes a byte at least.
            if (!count || *count < 0 || *count > std::ssize(lines_.rest())) {
                soup_.fail(fmt::format("'{}' is not a valid number of elements for this file",
                                       words[2].substr(0, 40)),
                           lines_.number());
            }
            head_.elements.push_back({words[1], *count, {}});
        } else if (words[0] == "property" && words.size() == 3 && !head_.elements.empty()) {
            head_.elements.back().properties.push_back({words[2], scalar(words[1]), std::nullopt});
        } else if (words[0] == "property" && words.size() == 5 && words[1] == "list" &&
                   !head_.elements.empty()) {
            head_.elements.back().properties.push_back({words[4], scalar(words[3]), scalar(words[2])});
        } else {
            soup_.fail(
                fmt::format("'{}' is not supported in the header of a PLY file", words[0].substr(0, 40)),
                lines_.number());
        }
    }
    [[nodiscard]] Order order_named(std::string_view word) const {
        if (word == "ascii") {
            return Order::text;
        }
        if (word != "binary_little_endian" && word != "binary_big_endian") {
            soup_.fail(fmt::format("'{}' is not a PLY format", word.substr(0, 40)), lines_.number());
        }
        return word == "binary_little_endian" ? Order::little : Order::big;
    }
    [[nodiscard]] Scalar scalar(std::string_view word) const {
        const auto found = scalar_named(word);
        if (!found) {
            soup_.fail(fmt::format("'{}' is not a PLY data type", word.substr(0, 40)), lines_.number());
        }
        return *found;
    }

    WordLines& lines_;
    const PolygonSoup& soup_;
    Head head_;
};

/// The numbers after the head, one after another, of a text file or a binary one.
class Numbers {
public:
    Numbers(Order order, WordLines& lines, const PolygonSoup& soup)
        : order_(order), lines_(lines), bytes_(lines.rest()), soup_(soup) {}

    [[nodiscard]] double next(Scalar type) {
        if (order_ == Order::text) {
            return next_word();
        }
        switch (type) {
        case Scalar::int8:
            return next_as<std::int8_t>();
        case Scalar::uint8:
            return next_as<std::uint8_t>();
        case Scalar::int16:
            return next_as<std::int16_t>();
        case Scalar::uint16:
            return next_as<std::uint16_t>();
        case Scalar::int32:
            return next_as<std::int32_t>();
        case Scalar::uint32:
            return next_as<std::uint32_t>();
        case Scalar::float32:
            return static_cast<double>(next_as<float>());
        case Scalar::float64:
            break;
        }
        return next_as<double>();
    }
    /// What is left behind the last number, a sentence; none where that is white space.
    [[nodiscard]] std::string left_over_text() {
        if (order_ != Order::text) {
            return bytes_.find_first_not_of(" \t\r\n") == std::string_view::npos
                       ? ""
                       : fmt::format("{} bytes after the elements declared in the header are ignored",
                                     bytes_.size());
        }
        while (words_ == nullptr || word_ == words_->size()) {
            words_ = lines_.next();
            word_ = 0;
            if (words_ == nullptr) {
                return "";
            }
        }
        return fmt::format(
            "everything after the elements declared in the header, from line {} on, is ignored",
            lines_.number());
    }
    /// 0 in a binary file.
    [[nodiscard]] int line() const { return order_ == Order::text ? lines_.number() : 0; }

private:
    template <typename Value> Value next_as() {
        if (bytes_.size() < sizeof(Value)) {
            soup_.fail("the file ends too early");
        }
        std::array<char, sizeof(Value)> raw{};
        std::memcpy(raw.data(), bytes_.data(), raw.size());
        bytes_.remove_prefix(raw.size());
        if (order_ == Order::big) {
            std::ranges::reverse(raw);
        }
        return std::bit_cast<Value>(raw);
    }
    double next_word() {
        while (words_ == nullptr || word_ == words_->size()) {
            words_ = lines_.next();
            word_ = 0;
            if (words_ == nullptr) {
                soup_.fail("the file ends too early", lines_.number());
            }
        }
        const auto number = number_from<double>((*words_)[word_]);
        if (!number) {
            soup_.fail(fmt::format("'{}' is not a number", (*words_)[word_].substr(0, 40)), lines_.number());
        }
        ++word_;
        return *number;
    }

    Order order_;
    WordLines& lines_;
    std::string_view bytes_;
    const PolygonSoup& soup_;
    const std::vector<std::string_view>* words_ = nullptr;
    std::size_t word_ = 0;
};

/// The corners of strips, one after another, each pair of neighbours with the next making a triangle; -1 ends
/// a strip. Every other triangle of a strip is turned round, and so are its corners.
class Strips {
public:
    Strips(PolygonSoup& soup, int line) : soup_(soup), line_(line) {}

    void add(double corner) {
        if (std::abs(corner + 1.0) > 0.0) {
            corners_.push_back(corner);
            add_triangle();
        } else {
            corners_.clear();
        }
    }

private:
    PolygonSoup& soup_;
    int line_;
    std::vector<double> corners_; ///< of the strip, so far

    void add_triangle();
};

/// A whole number that fits.
int whole(double value, const PolygonSoup& soup, int line) {
    constexpr double largest = 2147483647.0;
    if (!(value >= 0.0 && value <= largest) || std::floor(value) < value) {
        soup.fail(fmt::format("{} is not a valid index or list length", value), line);
    }
    return static_cast<int>(value);
}

/// Of two that are the same there is no triangle: strips are joined by such corners.
void Strips::add_triangle() {
    const std::size_t count = corners_.size();
    if (count < 3) {
        return;
    }
    std::array<int, 3> face{};
    for (std::size_t k = 0; k < face.size(); ++k) {
        face[k] = whole(corners_[count - 3 + k], soup_, line_);
    }
    if (count % 2 == 0) {
        std::swap(face[0], face[1]);
    }
    if (face[0] != face[1] && face[1] != face[2] && face[2] != face[0]) {
        soup_.add_face(face, line_);
    }
}

void read_element(const Element& element, Numbers& numbers, PolygonSoup& soup, const Progress& progress) {
    constexpr std::int64_t between_checks = 10'000;
    constexpr std::array<std::string_view, 3> axes{"x", "y", "z"};
    for (std::int64_t n = 0; n < element.count; ++n) {
        if (n % between_checks == 0) {
            progress.check();
        }
        Vec3 point = Vec3::Zero();
        std::vector<int> face;
        const bool strips = element.name == "tristrips";
        for (const Property& property : element.properties) {
            const bool corners = property.name == "vertex_indices" || property.name == "vertex_index";
            if (!property.count) {
                const double value = numbers.next(property.type);
                const auto* const axis = std::ranges::find(axes, property.name);
                if (axis != axes.end()) {
                    point[axis - axes.begin()] = value;
                }
                continue;
            }
            const int length = whole(numbers.next(*property.count), soup, numbers.line());
            Strips strip(soup, numbers.line());
            for (int k = 0; k < length; ++k) {
                const double value = numbers.next(property.type);
                if (corners && strips) {
                    strip.add(value);
                } else if (corners) {
                    face.push_back(whole(value, soup, numbers.line()));
                }
            }
        }
        if (element.name == "vertex") {
            soup.add_point(point, numbers.line());
        } else if (element.name == "face") {
            soup.add_face(face, numbers.line());
        }
    }
}

} // namespace

void read_ply(std::string_view bytes, PolygonSoup& soup, const Progress& progress) {
    WordLines lines(bytes);
    const Head head = HeadReader(lines, soup).read();
    Numbers numbers(head.order, lines, soup);
    for (const Element& element : head.elements) {
        if (element.properties.empty() && element.count > 0) {
            soup.fail(fmt::format("the element {} has no property", element.name.substr(0, 40)));
        }
        read_element(element, numbers, soup, progress);
    }
    if (std::string left_over = numbers.left_over_text(); !left_over.empty()) {
        soup.note(std::move(left_over));
    }
}

} // namespace millwright::exchange
