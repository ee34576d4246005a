#include "app/commands/render_command.h"

#include "app/interrupt.h"
#include "core/base/error.h"
#include "core/kinematics/machine_solids.h"
#include "core/project/assets.h"
#include "ui/render/picture.h"
#include "ui/viewport/picture.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <charconv>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace millwright::app {

namespace {

constexpr int smallest_side = 16;
constexpr int largest_side = 8192;

struct RenderOptions {
    std::string project;
    std::string view;
    std::string size = "1280x800";
    std::string out;
};

/// Nothing unless `text` is WIDTHxHEIGHT within the limits.
std::optional<render::PixelSize> size_from(const std::string& text) {
    render::PixelSize size;
    const char* const end = text.data() + text.size();
    const auto width = std::from_chars(text.data(), end, size.width);
    if (width.ec != std::errc{} || width.ptr == end || *width.ptr != 'x') {
        return std::nullopt;
    }
    const auto height = std::from_chars(width.ptr + 1, end, size.height);
    const auto fits = [](int side) { return side >= smallest_side && side <= largest_side; };
    const bool whole = height.ec == std::errc{} && height.ptr == end;
    return whole && fits(size.width) && fits(size.height) ? std::optional(size) : std::nullopt;
}

std::string fault_of_size(const std::string& text) {
    return size_from(text)
               ? std::string()
               : fmt::format(
                     "'{}' is not WIDTHxHEIGHT with {} to {} pixels each", text, smallest_side, largest_side);
}

std::vector<std::string> view_names() {
    std::vector<std::string> names;
    for (int n = 0; n < viewport::view_kind_count; ++n) {
        names.emplace_back(viewport::id(static_cast<viewport::ViewKind>(n)));
    }
    return names;
}

/// The bodies of its file, as in the window.
viewport::MachineSolids solids_of(const OpenedProject& opened, const project::Plan& plan) {
    const auto file = project::machine_path(opened.project, opened.folders.project, opened.folders.assets);
    return kinematics::read_machine_solids(file, plan.workpiece->machine);
}

int render_project(const RenderOptions& options) {
    const Interrupt interrupt;
    const OpenedProject opened = open_project(options.project);
    const project::Plan plan = planned(opened, project::Scope::program, interrupt.token());
    const render::Picture picture = viewport::render_view(opened.project,
                                                          plan,
                                                          *viewport::view_kind(options.view),
                                                          *size_from(options.size),
                                                          render::Theme::dark,
                                                          solids_of(opened, plan));
    render::write_png(picture, options.out);
    fmt::print("{}\n", options.out);
    return 0;
}

} // namespace

void add_render_command(CLI::App& app, Command& chosen) {
    const auto options = std::make_shared<RenderOptions>();
    CLI::App& command = *app.add_subcommand("render", "Draw a view of a project into a picture");
    command.add_option("PROJECT", options->project, "Project file")->required();
    command.add_option("--view", options->view, "What is drawn")
        ->required()
        ->check(CLI::IsMember(view_names()));
    command.add_option("--size", options->size, "Size of the picture in pixels")
        ->check(CLI::Validator(fault_of_size, "WIDTHxHEIGHT"))
        ->capture_default_str();
    command.add_option("--out", options->out, "PNG file")->required()->type_name("FILE");
    command.callback([&chosen, options] { chosen = [options] { return render_project(*options); }; });
}

} // namespace millwright::app
