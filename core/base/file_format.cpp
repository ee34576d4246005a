#include "core/base/file_format.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>

namespace millwright {

namespace {

struct KnownFormat {
    std::string_view format;
    std::string_view kind;
    std::string_view use; ///< where it belongs
};

constexpr std::array known_formats{
    KnownFormat{"millwright-project", "a project file", "give it as PROJECT"},
    KnownFormat{"millwright-machine",
                "a machine file",
                "a project names it in its machine, some commands take it as --machine"},
    KnownFormat{"millwright-arm", "an arm file", "give it as --arm"},
    KnownFormat{"millwright-tool", "a tool file", "give it as --tool"},
    KnownFormat{"millwright-post", "a post file", "give it as --post"},
};

} // namespace

void expect_format(const JsonValue& root, std::string_view format, std::string_view kind) {
    const JsonValue found = root.at("format");
    const std::string text = found.text();
    if (text == format) {
        return;
    }
    const auto known = std::ranges::find(known_formats, text, &KnownFormat::format);
    found.fail(fmt::format("not {}", kind),
               known == known_formats.end() ? fmt::format("expected \"{}\"", format)
                                            : fmt::format("it is {}: {}", known->kind, known->use));
}

} // namespace millwright
