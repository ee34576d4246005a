#include "app/command_line/output_conflicts.h"

#include "core/base/draft.h"
#include "core/base/error.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace millwright::app {

namespace fs = std::filesystem;

namespace {

/// Options of all commands that name a file to be written.
constexpr std::array<std::string_view, 13> outputs{"--accept",
                                                   "--deviation",
                                                   "--norms",
                                                   "--out",
                                                   "--path",
                                                   "--picture",
                                                   "--preview",
                                                   "--pulses",
                                                   "--ram-out",
                                                   "--residuals",
                                                   "--servo",
                                                   "--trace",
                                                   "--watch"};

struct Named {
    std::string option; ///< as it is called on the command line
    std::string value;
    bool is_folder = false; ///< of those that are written
};

struct Files {
    std::vector<Named> written;
    std::vector<Named> others; ///< whatever else was given; not all of them are files
};

void collect(const CLI::App& command, Files& files) {
    for (const CLI::Option* const option : command.get_options()) {
        const bool is_flag = option->get_expected_max() == 0;
        auto& list = !is_flag && std::ranges::find(outputs, option->get_name()) != outputs.end()
                         ? files.written
                         : files.others;
        for (const std::string& value : option->results()) {
            list.push_back({option->get_name(), value, option->get_type_name() == "DIR"});
        }
    }
    for (const CLI::App* const chosen : command.get_subcommands()) {
        collect(*chosen, files);
    }
}

/// A device can be read and written: only what would be replaced counts.
bool same_file(const std::string& a, const std::string& b) {
    std::error_code failure;
    if (fs::equivalent(a, b, failure)) {
        return fs::is_regular_file(a, failure);
    }
    const fs::path first = fs::weakly_canonical(a, failure);
    const fs::path second = fs::weakly_canonical(b, failure);
    return !fs::exists(a, failure) && !first.empty() && first == second;
}

/// What is no file, such as a device or a pipe, is written through.
void expect_writable_file(const Named& out) {
    std::error_code missing;
    if (fs::is_directory(out.value, missing)) {
        throw Error(
            fmt::format("{} names a folder, but must name a file", out.option), out.value, "add a file name");
    }
    if (!fs::exists(out.value, missing) || fs::is_regular_file(out.value, missing)) {
        const Draft draft(out.value); // begins as the writing will
    }
}

/// One that is missing is made before the work.
void expect_writable_folder(const Named& out) {
    std::error_code missing;
    if (!fs::exists(out.value, missing)) {
        return;
    }
    if (!fs::is_directory(out.value, missing)) {
        throw Error(fmt::format("{} names a file, but must name a folder", out.option), out.value);
    }
    try {
        const Draft draft(fs::path(out.value) / "millwright");
    } catch (const Error& fault) {
        throw Error(fault.diagnostic().message, out.value);
    }
}

} // namespace

void expect_outputs_apart(const CLI::App& app) {
    Files files;
    collect(app, files);
    for (std::size_t n = 0; n < files.written.size(); ++n) {
        const Named& out = files.written[n];
        for (const Named& other : files.others) {
            std::error_code failure;
            if (fs::exists(other.value, failure) && same_file(out.value, other.value)) {
                throw Error(
                    fmt::format("{} would overwrite {}, which is an input file", out.option, other.option),
                    out.value,
                    "give it another name");
            }
        }
        for (std::size_t k = 0; k < n; ++k) {
            if (same_file(out.value, files.written[k].value)) {
                throw Error(fmt::format("{} and {} name the same file", files.written[k].option, out.option),
                            out.value,
                            "give one of them another name");
            }
        }
    }
}

void expect_outputs_writable(const CLI::App& app) {
    Files files;
    collect(app, files);
    for (const Named& out : files.written) {
        if (!out.value.empty()) {
            out.is_folder ? expect_writable_folder(out) : expect_writable_file(out);
        }
    }
}

std::vector<fs::path> named_outputs(const CLI::App& app) {
    Files files;
    collect(app, files);
    std::vector<fs::path> named;
    for (const Named& out : files.written) {
        named.emplace_back(out.value);
    }
    constexpr std::string_view to_file = "file:";
    for (const Named& other : files.others) { // a coordinate stream
        if (other.option == "--port" && other.value.starts_with(to_file)) {
            named.emplace_back(other.value.substr(to_file.size()));
        }
    }
    return named;
}

} // namespace millwright::app
