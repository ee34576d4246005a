#include "app/cordic/cordic_command.h"

#include "app/command_line/output_transaction.h"
#include "app/cordic/cordic_pass.h"
#include "app/cordic/cordic_source.h"
#include "core/base/error.h"
#include "core/base/files.h"
#include "core/base/text.h"
#include "core/cordic_rtl/rtl.h"
#include "core/cordic_study/calculator.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace millwright::app {

namespace {

constexpr std::int64_t most_vectors = 10'000'000;

struct NumberOptions {
    std::string x; // as written: formats of more than 53 bits hold more digits than binary64
    std::string y;
    std::string angle_deg;
    std::string format = "f64";
    std::string rounding = "truncate";
    int iterations = 0; ///< 0: the thesis's 29 steps
    std::string out;
    std::int64_t vectors = 1000;
    std::uint64_t seed = 2002;
    bool json = false;
    CordicPassOptions pass;
};

cordic::NumberFormat number_format(const NumberOptions& options) {
    cordic::NumberFormat format = cordic::parse_number_format(options.format);
    format.rounding = cordic::parse_rounding(options.rounding);
    return format;
}

cordic::Sequence sequence_of(const NumberOptions& options) {
    const cordic::CoordinateSystem m = cordic::parse_coordinate_system(options.pass.system);
    return options.iterations == 0 ? cordic::thesis_sequence(m)
                                   : cordic::classic_sequence(m, options.iterations);
}

/// `z`: as written.
int raw_pass(const NumberOptions& options, cordic::Mode mode, const std::string& z) {
    return print_cordic_pass(
        number_format(options),
        sequence_of(options),
        {.mode = mode,
         .x = cordic::Decimal::parse(options.x),
         .y = cordic::Decimal::parse(options.y),
         .z = z.empty() ? cordic::Decimal(0.0) : cordic::Decimal::parse(z),
         .folds = options.pass.folds,
         .zero = options.pass.matlab_zero ? cordic::SignOfZero::zero : cordic::SignOfZero::positive},
        options.json);
}

int rotate(const NumberOptions& options) {
    refuse_pass_options(options.pass);
    if (options.pass.is_raw()) {
        return raw_pass(options, cordic::Mode::rotation, options.angle_deg);
    }
    const cordic::Rotated found = cordic::rotate(number_format(options),
                                                 sequence_of(options),
                                                 cordic::Decimal::parse(options.x),
                                                 cordic::Decimal::parse(options.y),
                                                 cordic::Decimal::parse(options.angle_deg));
    if (options.json) {
        nlohmann::ordered_json answer;
        answer["x"] = found.x;
        answer["y"] = found.y;
        answer["z"] = found.z;
        answer["error"] = found.error;
        answer["clocks"] = found.clocks;
        answer["words"] = hexadecimal_words(found.words);
        fmt::print("{}\n", answer.dump(2));
    } else {
        fmt::print("x {}\ny {}\nz {} rad remaining\nerror {}\n{} clocks\n",
                   shortest(found.x),
                   shortest(found.y),
                   shortest(found.z),
                   shortest(found.error),
                   found.clocks);
    }
    return 0;
}

int vector(const NumberOptions& options) {
    refuse_pass_options(options.pass);
    if (options.pass.is_raw()) {
        return raw_pass(options, cordic::Mode::vectoring, options.pass.z);
    }
    const cordic::Polar found = cordic::polar(number_format(options),
                                              sequence_of(options),
                                              cordic::Decimal::parse(options.x),
                                              cordic::Decimal::parse(options.y));
    if (options.json) {
        nlohmann::ordered_json answer;
        answer["magnitude"] = found.length;
        answer["angle_deg"] = found.angle_deg;
        answer["error"] = found.length_error;
        answer["error_deg"] = found.angle_error_deg;
        answer["clocks"] = found.clocks;
        answer["shift"] = found.shift;
        answer["words"] = hexadecimal_words(found.words);
        fmt::print("{}\n", answer.dump(2));
    } else {
        fmt::print("magnitude {}, error {}\n{} degrees, error {}\n{} clocks\n",
                   shortest(found.length),
                   shortest(found.length_error),
                   shortest(found.angle_deg),
                   shortest(found.angle_error_deg),
                   found.clocks);
    }
    return 0;
}

int rtl(const NumberOptions& options) {
    make_folder(options.out);
    std::vector<OutputFile> files;
    for (cordic::RtlFile& file :
         cordic::make_rtl(number_format(options), sequence_of(options), options.vectors, options.seed)) {
        files.push_back({std::move(file.name), std::move(file.text)});
    }
    write_outputs(options.out, {files});
    fmt::print("{} files; try: cd {} && iverilog -g2001 -o sim cordic_core.v cordic_core_tb.v && ./sim\n",
               files.size(),
               options.out);
    return 0;
}

CLI::App& add_command(CLI::App& group,
                      const char* name,
                      const char* text,
                      const std::shared_ptr<NumberOptions>& options) {
    CLI::App& command = *group.add_subcommand(name, text);
    command.add_option("--format", options->format, "Number format: f64, f32, or qI.F such as q2.22")
        ->check(number_format_text())
        ->capture_default_str();
    command
        .add_option("--rounding", options->rounding, "Rounding of the bits that a fixed-point shift drops")
        ->check(CLI::IsMember({"truncate", "toward-zero", "nearest", "nearest-even"}))
        ->capture_default_str();
    command
        .add_option("--iterations", options->iterations, "Use steps 0, 1, 2 ... instead of the thesis's 29")
        ->check(CLI::Range(1, cordic::most_steps));
    return command;
}

CLI::Option& add_number(CLI::App& command, const char* name, std::string& number, const char* text) {
    const auto fault_of = [](std::string& written) {
        try {
            (void)cordic::Decimal::parse(written);
            return std::string();
        } catch (const Error& error) {
            return error.diagnostic().message;
        }
    };
    return *command.add_option(name, number, text)->check(CLI::Validator(fault_of, ""))->type_name("NUMBER");
}

CLI::App& add_numbers(CLI::App& group,
                      const char* name,
                      const char* text,
                      const std::shared_ptr<NumberOptions>& options) {
    CLI::App& command = add_command(group, name, text, options);
    add_number(command, "X", options->x, "First coordinate").required();
    add_number(command, "Y", options->y, "Second coordinate").required();
    add_cordic_pass(command, options->pass);
    command.add_flag("--json", options->json, "Print the result as JSON");
    return command;
}

void add_rtl(CLI::App& group, Command& chosen) {
    const auto options = std::make_shared<NumberOptions>();
    options->format = "q2.22";
    CLI::App& command =
        add_command(group, "rtl", "Write the iteration as Verilog, with test benches", options);
    add_cordic_system(command, options->pass.system);
    command.add_option("--out", options->out, "Folder for the Verilog files and their test vectors")
        ->required()
        ->type_name("DIR");
    command.add_option("--vectors", options->vectors, "Number of test vectors from the model")
        ->check(CLI::Range(std::int64_t{1}, most_vectors))
        ->capture_default_str();
    command.add_option("--seed", options->seed, "Seed of the test vectors")->capture_default_str();
    command.callback([&chosen, options] { chosen = [options] { return rtl(*options); }; });
}

} // namespace

void add_cordic_command(CLI::App& app, Command& chosen) {
    CLI::App& group =
        *app.add_subcommand("cordic", "CORDIC G-code processor: rotates by shifts and additions");
    group.require_subcommand(1);
    const auto options = std::make_shared<NumberOptions>();
    CLI::App& rotating = add_numbers(group, "rotate", "Rotate a vector by any angle", options);
    add_number(rotating, "DEGREES", options->angle_deg, "Angle, counter-clockwise; in a raw pass z itself")
        .required();
    rotating.callback([&chosen, options] { chosen = [options] { return rotate(*options); }; });
    CLI::App& measuring = add_numbers(group, "vector", "Length and direction of a vector", options);
    add_number(measuring, "--z", options->pass.z, "With --raw: initial z of the pass (default: 0)");
    measuring.callback([&chosen, options] { chosen = [options] { return vector(*options); }; });
    add_cordic_accuracy(group, chosen);
    add_cordic_run(group, chosen);
    add_cordic_programs(group, chosen);
    add_cordic_compare(group, chosen);
    add_cordic_sew(group, chosen);
    add_rtl(group, chosen);
    add_cordic_rtl_processor(group, chosen);
}

} // namespace millwright::app
