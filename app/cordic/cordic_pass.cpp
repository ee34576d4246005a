#include "app/cordic/cordic_pass.h"

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/cordic_study/single_pass.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <optional>

namespace millwright::app {

void add_cordic_system(CLI::App& command, std::string& system) {
    command.add_option("--system", system, "Coordinate system: circular, linear or hyperbolic")
        ->check(CLI::IsMember({"circular", "linear", "hyperbolic"}))
        ->capture_default_str();
}

void add_cordic_pass(CLI::App& command, CordicPassOptions& options) {
    add_cordic_system(command, options.system);
    command.add_flag(
        "--raw",
        options.raw,
        "Run one pass of the iteration, z in rad (always so in the linear and hyperbolic systems)");
    command.add_flag("--fold", options.folds, "With --raw: Pre before the pass, and Post after a rotation");
    command.add_flag("--matlab-zero",
                     options.matlab_zero,
                     "With --raw: skip steps with nothing to turn, as in the thesis's MATLAB model");
}

std::vector<std::string> hexadecimal_words(const std::array<cordic::Word, 3>& words) {
    std::vector<std::string> hexadecimal;
    for (const cordic::Word word : words) {
        hexadecimal.push_back(fmt::format("{:#x}", word));
    }
    return hexadecimal;
}

void refuse_pass_options(const CordicPassOptions& options) {
    if (!options.is_raw() && (options.folds || options.matlab_zero || !options.z.empty())) {
        throw Error("--fold, --matlab-zero and --z apply only to a raw pass", {}, "add --raw");
    }
}

int print_cordic_pass(const cordic::NumberFormat& format,
                      const cordic::Sequence& sequence,
                      const cordic::PassInput& input,
                      bool as_json) {
    const cordic::SinglePass found = cordic::single_pass(format, sequence, input);
    const bool vectors = input.mode == cordic::Mode::vectoring;
    const std::optional<double> range = cordic::exceeded_range(format, sequence, input);
    if (range) {
        fmt::print(stderr,
                   "warning: {}; {}\n",
                   cordic::unturned_text(input, *range),
                   input.folds ? "folding leaves z as it is" : "without --raw any angle is reduced first");
    }
    if (as_json) {
        nlohmann::ordered_json answer;
        answer["x"] = found.x;
        answer["y"] = found.y;
        answer["z"] = found.z;
        answer["exact_x"] = found.exact_x;
        answer["exact_y"] = found.exact_y;
        answer["exact_z"] = found.exact_z;
        answer["error"] = found.error;
        answer["z_error"] = found.z_error;
        if (input.folds) {
            answer["f1"] = found.f1;
            answer["f2"] = found.f2;
            if (vectors) {
                answer["quarter_turns"] = found.quarter_turns;
            }
        }
        answer["converged"] = !range;
        answer["clocks"] = found.clocks;
        answer["words"] = hexadecimal_words(found.words);
        fmt::print("{}\n", answer.dump(2));
        return 0;
    }
    fmt::print("x {}\ny {}\nz {}\n", shortest(found.x), shortest(found.y), shortest(found.z));
    if (input.folds) {
        fmt::print("f1 {}, f2 {}\n", found.f1 ? 1 : 0, found.f2 ? 1 : 0);
        if (vectors) {
            fmt::print("direction: z and {} quarter turns\n", found.quarter_turns);
        }
    }
    fmt::print("error {}{}\n{} clocks\n",
               shortest(found.error),
               vectors ? fmt::format(" of x, {} of z", shortest(found.z_error)) : "",
               found.clocks);
    return 0;
}

} // namespace millwright::app
