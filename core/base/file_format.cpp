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
    KnownFormat{"millwright-project", "a project file", "use it as PROJECT"},
    KnownFormat{
        "millwright-machine",
        "a machine file",
        "name it as the machine of a project, or use it as --machine where a command has this option"},
    KnownFormat{"millwright-arm", "an arm file", "use it as --arm"},
    KnownFormat{"millwright-tool", "a tool file", "use it as --tool"},
    KnownFormat{"millwright-post", "a post file", "use it as --post"},
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
