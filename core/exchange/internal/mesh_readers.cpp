#include "core/exchange/internal/mesh_readers.h"

#include "core/base/counted.h"
#include "core/base/text.h"
#include "core/exchange/internal/word_lines.h"
#include "core/exchange/mesh_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <functional>
#include <iterator>
#include <string>
#include <vector>

namespace millwright::exchange {

namespace {

/// 7, 7/1, 7//2 or 7/1/2: the first point is 1, the last one is -1.
int corner_from(std::string_view word, const PolygonSoup& soup, int line) {
    const auto number = number_from<int>(word.substr(0, word.find('/')));
    if (!number || *number == 0) {
        soup.fail(fmt::format("'{}' is not a valid corner of a face", word.substr(0, 40)), line);
    }
    if (*number > soup.point_count() || *number < -soup.point_count()) {
        soup.fail(fmt::format(
                      "a face refers to point {}, but there are only {} points", *number, soup.point_count()),
                  line);
    }
    return *number > 0 ? *number - 1 : static_cast<int>(soup.point_count() + *number);
}

} // namespace

void read_obj(std::string_view bytes, PolygonSoup& soup, const Progress& progress) {
    constexpr int between_checks = 10'000;
    WordLines lines(bytes);
    std::vector<int> face;
    bool goes_on = false; // a face, on the next line
    while (const auto* words = lines.next()) {
        if (lines.number() % between_checks == 0) {
            progress.check();
        }
        if (words->empty()) {
            continue;
        }
        const bool is_face = goes_on || words->front() == "f";
        if (words->front() == "v" && !goes_on) {
            soup.add_point(vector_from(*words, 1, soup, lines.number()), lines.number());
        } else if (is_face) {
            const std::size_t last = words->size() - (words->back() == "\\" ? 1 : 0);
            for (std::size_t n = goes_on ? 0 : 1; n < last && !(*words)[n].starts_with('#'); ++n) {
                face.push_back(corner_from((*words)[n], soup, lines.number()));
            }
            goes_on = last < words->size();
            if (!goes_on) {
                soup.add_face(face, lines.number());
                face.clear();
            }
        }
    }
    if (goes_on) {
        soup.fail("the file ends in the middle of a face", lines.number());
    }
}

namespace {

constexpr std::size_t stl_head_size = 84; // 80 bytes of text and the count
constexpr std::size_t facet_size = 50;    // normal, three corners, two bytes more
constexpr std::uint32_t between_checks = 10'000;

char small_letter(char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

/// Intel's byte order, which is ours.
template <typename Value> Value value_at(std::string_view bytes, std::size_t place) {
    Value value;
    std::memcpy(&value, bytes.data() + place, sizeof value);
    return value;
}

/// Of a file that holds more than its header counts.
std::string left_over_text(std::uint32_t count, std::uint64_t bytes) {
    return fmt::format("{} bytes after the {} declared in the header are ignored: enough for {} more",
                       bytes,
                       count == 1 ? "triangle" : fmt::format("{} triangles", count),
                       bytes / facet_size);
}

void read_binary(std::string_view bytes, PolygonSoup& soup, const Progress& progress) {
    if (bytes.size() < stl_head_size) {
        soup.fail(
            fmt::format("neither text nor the {} bytes that a binary STL file starts with", stl_head_size));
    }
    const auto count = value_at<std::uint32_t>(bytes, 80);
    const std::uint64_t wanted = stl_head_size + std::uint64_t{count} * facet_size;
    if (bytes.size() < wanted) {
        soup.fail(
            fmt::format("{} triangles need {} bytes, but the file has {}", count, wanted, bytes.size()));
    }
    if (count == 0 && bytes.size() >= stl_head_size + facet_size) {
        soup.fail(fmt::format("the header declares no triangles, but there is data for {}",
                              (bytes.size() - stl_head_size) / facet_size));
    }
    if (bytes.size() > wanted) {
        soup.note(left_over_text(count, bytes.size() - wanted));
    }
    for (std::uint32_t n = 0; n < count; ++n) {
        if (n % between_checks == 0) {
            progress.check();
        }
        const int first = static_cast<int>(soup.point_count());
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t at = stl_head_size + n * facet_size + 12 * (k + 1);
            soup.add_point(Eigen::Vector3f(value_at<float>(bytes, at),
                                           value_at<float>(bytes, at + 4),
                                           value_at<float>(bytes, at + 8))
                               .cast<double>());
        }
        soup.add_face(std::array{first, first + 1, first + 2});
    }
}

/// In small letters: some programs write capitals. `end loop` is taken for `endloop`.
std::string keyword_of(const std::vector<std::string_view>& words) {
    std::string word(words.front());
    std::ranges::transform(word, word.begin(), small_letter);
    if (word == "end" && words.size() > 1) {
        word += words[1];
        std::ranges::transform(word, word.begin(), small_letter);
    }
    return word;
}

void read_text(std::string_view bytes, PolygonSoup& soup, const Progress& progress) {
    WordLines lines(bytes);
    int corners = -1; // outside of a loop
    while (const auto* words = lines.next()) {
        if (static_cast<std::uint32_t>(lines.number()) % between_checks == 0) {
            progress.check();
        }
        if (words->empty()) {
            continue;
        }
        const std::string word = keyword_of(*words);
        if (word == "outer") {
            corners = 0;
        } else if (word == "vertex") {
            if (corners < 0) {
                soup.fail("a vertex is outside a loop", lines.number());
            }
            soup.add_point(vector_from(*words, 1, soup, lines.number()), lines.number());
            ++corners;
        } else if (word == "endloop") {
            if (corners != 3) {
                soup.fail(fmt::format("a loop has {}", counted(std::max(corners, 0), "corner")),
                          lines.number());
            }
            const int last = static_cast<int>(soup.point_count());
            soup.add_face(std::array{last - 3, last - 2, last - 1}, lines.number());
            corners = -1;
        } else if (word != "facet" && word != "endfacet" && word != "solid" && word != "endsolid") {
            soup.fail(fmt::format("'{}' is not an STL keyword", word.substr(0, 40)), lines.number());
        }
    }
    if (corners >= 0) {
        soup.fail("the file ends in the middle of a loop", lines.number());
    }
}

bool begins_with_solid(std::string_view text) {
    return std::ranges::equal(
        text.substr(0, 5), std::string_view("solid"), std::ranges::equal_to(), small_letter);
}

/// A binary file may begin with the word solid, too. The count of one that is read has a byte of 0, as no
/// text has: 2^24 triangles are too many.
bool is_text(std::string_view bytes) {
    static_assert(most_mesh_triangles < 1 << 24);
    const std::string_view text = without_byte_order_mark(bytes);
    const std::size_t start = text.find_first_not_of(" \t\r\n");
    return start != std::string_view::npos && begins_with_solid(text.substr(start)) &&
           bytes.substr(0, stl_head_size).find('\0') == std::string_view::npos;
}

/// The header of a binary file may look like such text, too, but not with solid in it.
void refuse_wide_stl(std::string_view bytes, const std::filesystem::path& file) {
    const std::string_view head = bytes.substr(0, stl_head_size);
    std::string letters;
    std::ranges::copy_if(head, std::back_inserter(letters), [](char c) { return c > ' ' && c <= '~'; });
    if (begins_with_solid(letters)) {
        refuse_wide_text(head, file);
    }
}

} // namespace

void read_stl(std::string_view bytes,
              const std::filesystem::path& file,
              PolygonSoup& soup,
              const Progress& progress) {
    refuse_wide_stl(bytes, file);
    is_text(bytes) ? read_text(bytes, soup, progress) : read_binary(bytes, soup, progress);
}

} // namespace millwright::exchange
