#include "app/command_line/text_validator.h"

#include "core/base/error.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <utility>

namespace millwright::app {

CLI::Validator parsed_by(std::function<void(const std::string&)> parse) {
    const auto fault_of = [parse = std::move(parse)](std::string& text) -> std::string {
        try {
            parse(text);
        } catch (const Error& error) {
            const Diagnostic& found = error.diagnostic();
            return found.hint.empty() ? found.message : fmt::format("{} ({})", found.message, found.hint);
        }
        return {};
    };
    return {fault_of, ""};
}

} // namespace millwright::app
