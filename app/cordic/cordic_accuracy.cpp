#include "app/command_line/output_transaction.h"
#include "app/command_line/watched_work.h"
#include "app/cordic/cordic_command.h"
#include "app/cordic/cordic_source.h"
#include "core/base/error.h"
#include "core/cordic_study/accuracy.h"
#include "core/cordic_study/experiments.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace millwright::app {

namespace {

using cordic::Rounding;

constexpr int exhaustive_bits = 16;

struct CordicAccuracyOptions {
    std::string out;
    std::int64_t random = 10'000'000;
    std::uint64_t seed = 2002;
    std::optional<std::string> format; // any of these four: the case that they name alone
    std::optional<std::string> rounding;
    std::optional<std::string> system;
    std::optional<int> iterations; ///< not given: the thesis's 29 steps

    [[nodiscard]] bool name_a_case() const { return format || rounding || system || iterations; }
};

using Case = std::pair<cordic::NumberFormat, cordic::Sequence>;

struct Row {
    cordic::NumberFormat format;
    cordic::Sequence sequence;
    cordic::RotationBound rotation_bound;
    cordic::VectoringBound vectoring_bound;
    cordic::Accuracy measured;
};

using cordic::CoordinateSystem;

CoordinateSystem system_of(const CordicAccuracyOptions& options) {
    return options.system ? cordic::parse_coordinate_system(*options.system) : CoordinateSystem::circular;
}

Case case_of(const CordicAccuracyOptions& options) {
    const CoordinateSystem m = system_of(options);
    const int least_integer_bits = cordic::measured_integer_bits(m);
    cordic::NumberFormat format = cordic::parse_number_format(options.format.value_or("f64"));
    const bool fixed = format.kind == cordic::NumberKind::fixed;
    if (fixed && format.integer_bits < least_integer_bits) {
        throw Error(fmt::format("vectors of length 1 do not fit into {}", cordic::to_text(format)),
                    {},
                    fmt::format("for {} rotations of them use at least {} bits before the point",
                                cordic::to_text(m),
                                least_integer_bits));
    }
    if (options.rounding && !fixed) {
        throw Error("--rounding applies only to fixed point", {}, "use --format qI.F");
    }
    format.rounding = options.rounding ? cordic::parse_rounding(*options.rounding) : format.rounding;
    return {format,
            options.iterations ? cordic::classic_sequence(m, *options.iterations)
                               : cordic::thesis_sequence(m)};
}

std::vector<Case> cases() {
    std::vector<Case> made;
    const auto thesis = cordic::thesis_sequence();
    const auto classic = [](int steps) {
        return cordic::classic_sequence(CoordinateSystem::circular, steps);
    };
    for (const Rounding rounding :
         {Rounding::truncate, Rounding::toward_zero, Rounding::nearest, Rounding::nearest_even}) {
        made.emplace_back(cordic::fixed_format(2, 14, rounding), thesis);
    }
    for (const int steps : {4, 6, 8, 10, 12, 14, 16}) {
        made.emplace_back(cordic::fixed_format(2, 14), classic(steps));
    }
    for (const int fraction_bits : {22, 30}) {
        made.emplace_back(cordic::fixed_format(2, fraction_bits), thesis);
        made.emplace_back(cordic::fixed_format(2, fraction_bits, Rounding::nearest), thesis);
        made.emplace_back(cordic::fixed_format(2, fraction_bits), classic(fraction_bits + 2));
    }
    made.emplace_back(cordic::binary32, thesis);
    made.emplace_back(cordic::binary64, thesis);
    for (const CoordinateSystem m : {CoordinateSystem::linear, CoordinateSystem::hyperbolic}) {
        const int integer_bits = cordic::measured_integer_bits(m);
        for (const int word : {exhaustive_bits, 32}) {
            const auto format = cordic::fixed_format(integer_bits, word - integer_bits);
            made.emplace_back(format, cordic::thesis_sequence(m));
            made.emplace_back(format, cordic::classic_sequence(m, format.fraction_bits));
        }
        made.emplace_back(cordic::binary32, cordic::thesis_sequence(m));
        made.emplace_back(cordic::binary64, cordic::thesis_sequence(m));
    }
    return made;
}

std::vector<Row> measured_rows(const CordicAccuracyOptions& options, const Progress& progress) {
    const auto all = options.name_a_case() ? std::vector<Case>{case_of(options)} : cases();
    std::vector<Row> rows;
    for (std::size_t n = 0; n < all.size(); ++n) {
        const auto& [format, sequence] = all[n];
        const auto count = static_cast<double>(all.size());
        progress.report(static_cast<double>(n) / count, cordic::to_text(format));
        const double longest = 1.0 + cordic::resolution(format);
        cordic::Sampling sampling{.random = options.random, .seed = options.seed};
        if (format.word() <= exhaustive_bits) {
            sampling.random.reset();
        }
        rows.push_back({format,
                        sequence,
                        cordic::rotation_bound(format, sequence, longest),
                        cordic::vectoring_bound(format, sequence, 1.0 - cordic::resolution(format)),
                        cordic::measure_accuracy(format, sequence, sampling, progress)});
    }
    progress.report(1.0);
    return rows;
}

/// "thesis 29", "classic 24 hyperbolic".
std::string sequence_name(const cordic::Sequence& sequence) {
    const bool thesis = sequence == cordic::thesis_sequence(sequence.m);
    return fmt::format("{} {}{}{}",
                       thesis ? "thesis" : "classic",
                       sequence.step_count,
                       sequence.m == CoordinateSystem::circular ? "" : " ",
                       sequence.m == CoordinateSystem::circular ? "" : cordic::to_text(sequence.m));
}

std::string table(const std::vector<Row>& rows) {
    std::string text =
        "format,rounding,sequence,inputs,rotation_error,rotation_bound,angle_error_rad,angle_bound_rad,"
        "length_error,length_bound\n";
    for (const Row& row : rows) {
        const bool fixed = row.format.kind == cordic::NumberKind::fixed;
        text += fmt::format("{},{},{},{},{:.3e},{:.3e},{:.3e},{:.3e},{:.3e},{:.3e}\n",
                            cordic::to_text(row.format),
                            fixed ? cordic::to_text(row.format.rounding) : "ieee",
                            sequence_name(row.sequence),
                            row.measured.count,
                            row.measured.rotation,
                            row.rotation_bound.total,
                            row.measured.angle,
                            row.vectoring_bound.angle,
                            row.measured.length,
                            row.vectoring_bound.length);
    }
    return text;
}

void print_accuracy(const std::vector<Row>& rows, const std::vector<cordic::Finding>& findings) {
    fmt::print("{:<7} {:<13} {:<21} {:>9} {:>10} {:>10} {:>10} {:>10}\n",
               "format",
               "rounding",
               "sequence",
               "inputs",
               "rotation",
               "bound",
               "angle",
               "bound");
    for (const Row& row : rows) {
        const bool fixed = row.format.kind == cordic::NumberKind::fixed;
        fmt::print("{:<7} {:<13} {:<21} {:>9} {:>10.2e} {:>10.2e} {:>10.2e} {:>10.2e}\n",
                   cordic::to_text(row.format),
                   fixed ? cordic::to_text(row.format.rounding) : "ieee",
                   sequence_name(row.sequence),
                   row.measured.count,
                   row.measured.rotation,
                   row.rotation_bound.total,
                   row.measured.angle,
                   row.vectoring_bound.angle);
    }
    for (const cordic::Finding& finding : findings) {
        fmt::print("{}  {:.3e}  {}\n", finding.experiment, finding.largest_error, finding.what);
    }
}

/// The proven bound against the number of steps, one line a format: when more steps stop to help.
std::string bounds_picture(const std::vector<cordic::NumberFormat>& formats, CoordinateSystem m) {
    cordic::Chart chart{.title = "Proven bound of a rotation against the number of steps 0, 1, 2 ...",
                        .x_label = "steps",
                        .y_label = "largest error of a unit vector",
                        .logarithmic = true};
    for (const cordic::NumberFormat& format : formats) {
        cordic::Series series{.label = std::string(cordic::to_text(format))};
        for (int steps = 2; steps <= 40; ++steps) {
            series.x.push_back(steps);
            series.y.push_back(cordic::rotation_bound(format, cordic::classic_sequence(m, steps), 1.0).total);
        }
        chart.series.push_back(std::move(series));
    }
    return cordic::to_svg(chart);
}

std::vector<cordic::NumberFormat> formats_of_bounds(const CordicAccuracyOptions& options) {
    if (options.name_a_case()) {
        return {case_of(options).first};
    }
    return {cordic::fixed_format(2, 14),
            cordic::fixed_format(2, 22),
            cordic::fixed_format(2, 30),
            cordic::binary32,
            cordic::binary64};
}

int accuracy(const CordicAccuracyOptions& options) {
    const Interrupt interrupt;
    const OutputFolder folder(options.out);
    ProgressPrinter printer;
    const Progress progress([&](const Progress::Report& report) { printer.show(report); }, interrupt.token());
    const auto rows = measured_rows(options, progress);
    const auto experiments = options.name_a_case() ? cordic::Experiments() : cordic::run_experiments();
    printer.finish();
    std::vector<OutputFile> files = {
        {"accuracy.csv", table(rows)},
        {"bounds.svg", bounds_picture(formats_of_bounds(options), system_of(options))}};
    for (const cordic::Picture& picture : experiments.pictures) {
        files.push_back({picture.name, picture.svg});
    }
    write_outputs(options.out, {files});
    print_accuracy(rows, experiments.findings);
    return 0;
}

} // namespace

void add_cordic_accuracy(CLI::App& group, Command& chosen) {
    const auto options = std::make_shared<CordicAccuracyOptions>();
    CLI::App& command = *group.add_subcommand(
        "accuracy", "Proven bounds compared with measured errors, and the thesis's experiments");
    command.add_option("--out", options->out, "Folder for accuracy.csv and the pictures")
        ->required()
        ->type_name("DIR");
    command
        .add_option("--random", options->random, "Number of random inputs for formats longer than 16 bits")
        ->check(CLI::Range(std::int64_t{1}, std::int64_t{1'000'000'000}))
        ->capture_default_str();
    command
        .add_option(
            "--format", options->format, "Only this format: f64 (default), f32, or qI.F such as q2.22")
        ->check(number_format_text());
    command
        .add_option("--rounding", options->rounding, "Rounding of the bits that a fixed-point shift drops")
        ->check(CLI::IsMember({"truncate", "toward-zero", "nearest", "nearest-even"}));
    command
        .add_option(
            "--system", options->system, "Coordinate system: circular (default), linear or hyperbolic")
        ->check(CLI::IsMember({"circular", "linear", "hyperbolic"}));
    command
        .add_option("--iterations", options->iterations, "Use steps 0, 1, 2 ... instead of the thesis's 29")
        ->check(CLI::Range(1, cordic::most_steps));
    command.add_option("--seed", options->seed, "Seed of the random inputs")->capture_default_str();
    command.callback([&chosen, options] { chosen = [options] { return accuracy(*options); }; });
}

} // namespace millwright::app
