#include "app/plan/render_command.h"

#include "app/command_line/option_values.h"
#include "app/command_line/watched_work.h"
#include "core/base/error.h"
#include "core/kinematics/machine_solids.h"
#include "core/project/assets.h"
#include "ui/render/picture.h"
#include "ui/viewport/picture.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <map>
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
    viewport::PictureLook look;
};

using render::StandardView;
const std::map<std::string, StandardView> render_sides{{"iso", StandardView::iso},
                                                       {"oblique", StandardView::oblique},
                                                       {"top", StandardView::top},
                                                       {"bottom", StandardView::bottom},
                                                       {"front", StandardView::front},
                                                       {"back", StandardView::back},
                                                       {"left", StandardView::left},
                                                       {"right", StandardView::right}};

std::string listed_colors() {
    std::string text;
    for (const render::LayerColorInfo& info : render::layer_color_infos()) {
        text += (text.empty() ? "" : ", ") + std::string(info.id);
    }
    return text;
}

/// Puts "ID=#rrggbb" into `colors`; the sentence that says what is wrong with it, or "".
std::string take_color(const std::string& text, render::LayerColors& colors) {
    const std::size_t equals = text.find('=');
    const auto infos = render::layer_color_infos();
    const auto info = std::ranges::find(infos, text.substr(0, equals), &render::LayerColorInfo::id);
    if (equals == std::string::npos || info == infos.end()) {
        return fmt::format("'{}' does not set a colour as ID=#rrggbb; the IDs are {}", text, listed_colors());
    }
    const auto color = render::color_from(text.substr(equals + 1));
    if (!color) {
        return fmt::format("'{}' is not a colour of the form #rrggbb", text.substr(equals + 1));
    }
    colors.set(info->which, color);
    return {};
}

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
    return size_from(text) ? std::string()
                           : fmt::format("'{}' must be WIDTHxHEIGHT with {} to {} pixels each",
                                         text,
                                         smallest_side,
                                         largest_side);
}

std::vector<std::string> view_names() {
    std::vector<std::string> names;
    for (int n = 0; n < viewport::view_kind_count; ++n) {
        names.emplace_back(viewport::id(static_cast<viewport::ViewKind>(n)));
    }
    return names;
}

/// The bodies of its file, as in the window: where that file is gone the simple ones are drawn.
viewport::MachineSolids solids_of(const OpenedProject& opened, const plan::Plan& plan) {
    const auto file = project::machine_path(opened.project, opened.folders.project, opened.folders.assets);
    try {
        return kinematics::read_machine_solids(file, plan.cutting_setup->machine);
    } catch (const Error& error) {
        const std::filesystem::path& bodies = error.diagnostic().place.file;
        std::error_code missing;
        if (bodies == file || std::filesystem::exists(bodies, missing)) {
            throw;
        }
        fmt::print(stderr,
                   "warning: {}: there is no such file: the machine is drawn with simple bodies (create the "
                   "file with millwright machine bodies {} --out {})\n",
                   printable(bodies.string()),
                   printable(file.string()),
                   printable(bodies.string()));
        return nullptr;
    }
}

int render_project(const RenderOptions& options) {
    const Interrupt interrupt;
    const OpenedProject opened = open_project(options.project);
    const plan::Plan plan = planned(opened, plan::Scope::program, interrupt.token());
    const render::Picture picture = viewport::render_view(opened.project,
                                                          plan,
                                                          *viewport::view_kind(options.view),
                                                          *size_from(options.size),
                                                          render::Theme::dark,
                                                          solids_of(opened, plan),
                                                          options.look);
    render::write_png(picture, options.out);
    fmt::print("{}\n", options.out);
    return 0;
}

} // namespace

void add_render_command(CLI::App& app, Command& chosen) {
    const auto options = std::make_shared<RenderOptions>();
    CLI::App& command = *app.add_subcommand("render", "Draw a view of a project as a picture");
    command.add_option("PROJECT", options->project, "Project file")->required();
    command.add_option("--view", options->view, "View to draw")
        ->required()
        ->check(CLI::IsMember(view_names()));
    command.add_option("--size", options->size, "Size of the picture in pixels")
        ->check(CLI::Validator(fault_of_size, "WIDTHxHEIGHT"))
        ->capture_default_str();
    command
        .add_option_function<std::string>(
            "--side",
            [options](const std::string& name) { options->look.side = render_sides.at(name); },
            "Viewing direction (default: iso); oblique is the thesis's view")
        ->check(CLI::IsMember(render_sides).description(""))
        ->type_name(choice_list(render_sides));
    command
        .add_option_function<std::vector<std::string>>(
            "--color",
            [options](const std::vector<std::string>& all) {
                for (const std::string& one : all) {
                    (void)take_color(one, options->look.colors);
                }
            },
            "Theme colour to replace, such as background=#ffffff (repeatable)")
        ->allow_extra_args(false)
        ->check(CLI::Validator(
            [](const std::string& text) {
                render::LayerColors unused;
                return take_color(text, unused);
            },
            "ID=#rrggbb"));
    command.add_option("--out", options->out, "PNG file")->required()->type_name("FILE");
    command.callback([&chosen, options] { chosen = [options] { return render_project(*options); }; });
}

} // namespace millwright::app
