#include "core/exchange/internal/mesh_readers.h"
#include "core/exchange/internal/word_lines.h"

#include <fmt/format.h>

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

} // namespace millwright::exchange
