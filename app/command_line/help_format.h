// The help of a command in plain words: "--largest-step NUMBER (0 to 180)" where the parser's own has
// "FLOAT:FLOAT in [0 - 180]".
#pragma once

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <optional>
#include <string>

namespace millwright::app {

class HelpFormat final : public CLI::Formatter {
public:
    [[nodiscard]] std::string make_option_opts(const CLI::Option* option) const override;
    /// Of what has no name: "X Y Z AX AY AZ", "FILE...".
    [[nodiscard]] std::string make_option_usage(const CLI::Option* option) const override;
};

/// What stands for the value: "NUMBER", "N", "nearest|travel"; `range`: "0 to 180", or empty.
struct ValueText {
    std::string name;
    std::string range;
    std::optional<double> least{}, most{}; ///< of `range`
};
/// Of the parser's name of a type with its checks: "FLOAT:FLOAT in [0 - 180]", "TEXT:{nearest,travel}".
[[nodiscard]] ValueText value_text(const std::string& type);

} // namespace millwright::app
