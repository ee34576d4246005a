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

constexpr std::ptrdiff_t most_corners = 1000; // of one face

/// Newell's sum: normal to a polygon that need not be flat.
Vec3 normal_of(const std::vector<Vec3>& points, std::span<const int> corners) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t n = 0; n < corners.size(); ++n) {
        const Vec3& a = points[static_cast<std::size_t>(corners[n])];
        const Vec3& b = points[static_cast<std::size_t>(corners[(n + 1) % corners.size()])];
        sum += a.cross(b);
    }
    return sum;
}

class Ears {
public:
    Ears(const std::vector<Vec3>& points, std::span<const int> corners)
        : points_(points), left_(corners.begin(), corners.end()), normal_(normal_of(points, corners)) {}

    /// Two triangles fewer than corners, whatever the polygon.
    [[nodiscard]] std::vector<std::array<int, 3>> triangles() {
        std::vector<std::array<int, 3>> result;
        while (left_.size() > 3) {
            std::size_t ear = 0;
            while (ear + 1 < left_.size() && !is_ear(ear)) {
                ++ear;
            }
            result.push_back({before(ear), left_[ear], after(ear)});
            left_.erase(left_.begin() + static_cast<std::ptrdiff_t>(ear));
        }
        result.push_back({left_[0], left_[1], left_[2]});
        return result;
    }

private:
    [[nodiscard]] int before(std::size_t n) const { return left_[(n + left_.size() - 1) % left_.size()]; }
    [[nodiscard]] int after(std::size_t n) const { return left_[(n + 1) % left_.size()]; }
    [[nodiscard]] const Vec3& at(int corner) const { return points_[static_cast<std::size_t>(corner)]; }
    /// Above 0 where a, b, c turn to the left.
    [[nodiscard]] double turn(const Vec3& a, const Vec3& b, const Vec3& c) const {
        return (b - a).cross(c - a).dot(normal_);
    }
    [[nodiscard]] bool is_ear(std::size_t n) const {
        const Vec3& a = at(before(n));
        const Vec3& b = at(left_[n]);
        const Vec3& c = at(after(n));
        if (!(turn(a, b, c) > 0.0)) {
            return false;
        }
        return std::ranges::none_of(left_, [&](int other) {
            const Vec3& p = at(other);
            const bool own = other == before(n) || other == left_[n] || other == after(n);
            return !own && turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0;
        });
    }

    const std::vector<Vec3>& points_;
    std::vector<int> left_;
    Vec3 normal_;
};

} // namespace

void PolygonSoup::add_point(const Vec3& point, int line) {
    const Vec3 scaled = unit_ * point;
    constexpr double farthest = 1e12; // mm: areas of such triangles are still finite
    if (!is_finite(scaled) || !(scaled.cwiseAbs().maxCoeff() <= farthest)) {
        fail("a corner is not a finite number, or more than a million kilometres away", line);
    }
    mesh_.points.push_back(scaled);
}

void PolygonSoup::add_face(std::span<const int> corners, int line) {
    if (corners.size() < 3) {
        fail(fmt::format("a face has only {}", counted(corners.size(), "corner")), line);
    }
    if (std::ssize(corners) > most_corners) {
        fail(fmt::format("a face has more than {} corners", most_corners), line);
    }
    for (const int corner : corners) {
        if (corner < 0 || corner >= point_count()) {
            fail(
                fmt::format("a face refers to point {}, but there are only {} points", corner, point_count()),
                line);
        }
    }
    if (corners.size() == 3) {
        mesh_.triangles.push_back({corners[0], corners[1], corners[2]});
    } else {
        const auto cut = Ears(mesh_.points, corners).triangles();
        mesh_.triangles.insert(mesh_.triangles.end(), cut.begin(), cut.end());
    }
    if (std::ssize(mesh_.triangles) > most_mesh_triangles) {
        fail(fmt::format("more than {} triangles", most_mesh_triangles),
             line,
             "reduce the mesh in the program that made the file");
    }
}

void PolygonSoup::fail(std::string message, int line, std::string hint) const {
    throw Error(Diagnostic{Place{.file = file_, .line = line}, std::move(message), std::move(hint)});
}

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
constexpr std::uint32_t facets_between_checks = 10'000;

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
        if (n % facets_between_checks == 0) {
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
        if (static_cast<std::uint32_t>(lines.number()) % facets_between_checks == 0) {
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
