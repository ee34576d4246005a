#include "app/plots/picture_carve.h"

#include "app/command_line/watched_work.h"
#include "app/plots/carving.h"
#include "app/plots/picture_choice.h"
#include "app/plots/traced_picture.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <cstdio>
#include <memory>

namespace millwright::app {

namespace {

struct PictureCarveOptions {
    PictureChoice picture;
    plot::TraceSettings tracing;
    CarvingOptions carving;
};

int carve(const PictureCarveOptions& options) {
    WatchedWork work;
    const SizedPicture sized =
        read_chosen(options.picture, work.progress().part(0.0, 0.2), options.carving.json ? stderr : stdout);
    work.finish();
    const auto paths = traced_outlines(sized, options.picture, options.tracing);
    const double chords = plot::carving_chords(options.carving.settings.tolerance);
    carve_strokes(plot::strokes_of(paths, sized.pitch, chords), options.picture.file, options.carving, work);
    return 0;
}

} // namespace

void add_picture_carve(CLI::App& group, Command& chosen) {
    const auto options = std::make_shared<PictureCarveOptions>();
    CLI::App& command = *group.add_subcommand("carve", "V-carve the dark areas");
    add_picture_options(command, options->picture);
    add_tracing_options(command, options->tracing);
    add_carving_options(command, options->carving);
    command.callback([&chosen, options] { chosen = [options] { return carve(*options); }; });
}

} // namespace millwright::app
