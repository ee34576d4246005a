#include "tests/architecture/include_rules.h"

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace millwright::architecture {
namespace {

std::string_view without_leading_white(std::string_view text) {
    return text.substr(std::min(text.find_first_not_of(" \t"), text.size()));
}

std::optional<Include> include_in(const Line& line) {
    std::string_view rest = without_leading_white(line.text);
    if (!rest.starts_with('#')) {
        return std::nullopt;
    }
    rest = without_leading_white(rest.substr(1));
    if (!rest.starts_with("include")) {
        return std::nullopt;
    }
    rest = without_leading_white(rest.substr(std::string_view("include").size()));
    if (!rest.starts_with('"') && !rest.starts_with('<')) {
        return std::nullopt;
    }
    const auto end = rest.find_first_of("\">", 1);
    return Include{.line = line.number, .path = rest.substr(1, end - 1), .quoted = rest.starts_with('"')};
}

// A folder of the core, of ui or of app may include those of a smaller rank; two of the same rank know
// nothing of each other.
struct Rank {
    std::string_view folder;
    int rank;
};
constexpr std::array core_order = {
    Rank{"base", 0},         Rank{"geometry", 1},   Rank{"cordic", 1},         Rank{"links", 1},
    Rank{"pmac_service", 1}, Rank{"exchange", 2},   Rank{"kinematics", 2},     Rank{"grid", 2},
    Rank{"cordic_study", 2}, Rank{"cordic_rtl", 2}, Rank{"cordic_control", 2}, Rank{"arm", 3},
    Rank{"toolpath", 3},     Rank{"program", 4},    Rank{"plot", 5},           Rank{"motion", 5},
    Rank{"gcode", 6},        Rank{"project", 6},    Rank{"simulation", 6},     Rank{"gcode_programs", 7},
    Rank{"posts", 8},        Rank{"drivers", 8},    Rank{"cordic_machine", 9}, Rank{"emulators", 9},
    Rank{"jobs", 9},         Rank{"pmac", 10},      Rank{"plan", 10},          Rank{"machine", 11},
    Rank{"studies", 11},     Rank{"region", 2},     Rank{"plot_strokes", 2},   Rank{"hpgl", 3},
    Rank{"mesh_finish", 5},
};

// Panels of one workspace know nothing of those of another; what several need lies in ui/panels. Two take
// fields of another: an arm is moved by hand as a machine is, and the program of a plot is simulated as that
// of a tool path.
constexpr std::array ui_order = {
    Rank{"render", 0},
    Rank{"widgets", 0},
    Rank{"viewport", 1},
    Rank{"workspaces", 2},
    Rank{"actions", 3},
    Rank{"panels", 4},
    Rank{"design_panels", 5},
    Rank{"machine_panels", 5},
    Rank{"processor_panels", 5},
    Rank{"toolpath_panels", 5},
    Rank{"arm_panels", 6},
    Rank{"plot_panels", 6},
    Rank{"window", 7},
};

// What lies in app itself, main and the window, may include all of them, and none of them it.
constexpr std::array app_order = {
    Rank{"command_line", 0},
    Rank{"cordic", 1},
    Rank{"gcode", 1},
    Rank{"plan", 1},
    Rank{"studies", 1},
    Rank{"drivers", 2},
    Rank{"simulation", 2},
    Rank{"arm", 3},
    Rank{"plots", 3},
};

/// The folder inside of `part`: core/grid/adapt.h -> grid; empty elsewhere, and for files of `part` itself.
std::string_view folder_in(std::string_view part, std::string_view path) {
    if (!is_inside(path, part)) {
        return {};
    }
    path.remove_prefix(part.size() + 1);
    const std::size_t end = path.find('/');
    return end == std::string_view::npos ? std::string_view() : path.substr(0, end);
}

std::optional<int> rank_of(std::string_view folder, std::span<const Rank> order) {
    const auto found = std::ranges::find(order, folder, &Rank::folder);
    return found == order.end() ? std::nullopt : std::optional(found->rank);
}

std::string
upward(const std::string& part, std::span<const Rank> order, std::string_view path, const Include& include) {
    const auto from = folder_in(part, path);
    const auto into = folder_in(part, include.path);
    if (from.empty() || into.empty() || from == into) {
        return {};
    }
    const auto rank = rank_of(from, order);
    const auto other = rank_of(into, order);
    if (!rank || !other) {
        return part + "/" + std::string(rank ? into : from) +
               " has no place in the order of the folders of " + part;
    }
    return *other < *rank ? std::string() : part + "/" + std::string(from) + " includes upward";
}

std::string upward_in_core(std::string_view path, const Include& include) {
    return upward("core", core_order, path, include);
}

std::string upward_in_ui(std::string_view path, const Include& include) {
    return upward("ui", ui_order, path, include);
}

std::string upward_in_app(std::string_view path, const Include& include) {
    const bool of_app_itself = is_inside(include.path, "app") && folder_in("app", include.path).empty();
    if (of_app_itself && !folder_in("app", path).empty()) {
        return "app/" + std::string(folder_in("app", path)) + " includes upward";
    }
    return upward("app", app_order, path, include);
}

// What each part of the tree may not see of the others.
struct Border {
    std::string_view from;
    std::string_view into;
};
constexpr std::array borders = {
    Border{"core", "ui"},
    Border{"core", "app"},
    Border{"ui", "app"},
    Border{"core", "tests"},
    Border{"ui", "tests"},
    Border{"app", "tests"},
    Border{"core", "bench"},
    Border{"ui", "bench"},
    Border{"app", "bench"},
    Border{"tests/core", "ui"},
    Border{"tests/core", "app"},
};

std::string across_border(std::string_view path, const Include& include) {
    for (const auto& [from, into] : borders) {
        if (is_inside(path, from) && is_inside(include.path, into)) {
            return std::string(from) + " knows nothing of " + std::string(into);
        }
    }
    return {};
}

// internal/ belongs to the folder it lies in and to that folder's tests.
std::string into_internal(std::string_view path, const Include& include) {
    const auto internal = include.path.find("/internal/");
    if (internal == std::string_view::npos) {
        return {};
    }
    const auto owner = include.path.substr(0, internal);
    if (is_inside(path, owner) || is_inside(path, "tests/" + std::string(owner))) {
        return {};
    }
    return "internal/ belongs to " + std::string(owner);
}

// Outside libraries and the only places that may know them; what is not named here is free.
struct Home {
    std::string_view library;
    std::span<const std::string_view> headers; ///< beginnings of the include path
    std::span<const std::string_view> places;
};
constexpr std::array<std::string_view, 2> tbb = {"tbb/", "oneapi/"};
constexpr std::array<std::string_view, 1> tbb_home = {"core/base"};
constexpr std::array<std::string_view, 1> glm = {"glm/"};
constexpr std::array<std::string_view, 2> glm_home = {"ui", "tests/ui"};
constexpr std::array<std::string_view, 5> window = {"imgui", "backends/imgui", "misc/", "GLFW/", "imstb"};
constexpr std::array<std::string_view, 6> opengl = {"GL/", "GLES", "KHR/", "EGL/", "epoxy/", "GLX"};
constexpr std::array<std::string_view, 3> screen_home = {"ui", "tests/ui", "bench"};
constexpr std::array<std::string_view, 1> xlib = {"X11/"};
constexpr std::array<std::string_view, 3> xlib_home = {"ui/render", "tests/ui/render", "bench"};
constexpr std::array<std::string_view, 1> json = {"nlohmann/"};
constexpr std::array<std::string_view, 7> json_home = {
    "core/base", "core/jobs", "core/project", "core/plan", "core/studies", "app", "tests"};
constexpr std::array<std::string_view, 1> asio = {"boost/asio"};
constexpr std::array<std::string_view, 1> asio_home = {"core/links"};
constexpr std::array<std::string_view, 1> voronoi = {"boost/polygon"};
constexpr std::array<std::string_view, 1> voronoi_home = {"core/plot/carving"};
constexpr std::array<std::string_view, 1> clipper = {"polyclipping/"};
constexpr std::array<std::string_view, 1> clipper_home = {"core/plot"};
constexpr std::array<std::string_view, 2> pictures = {"png.h", "jpeglib.h"};
constexpr std::array<std::string_view, 2> pictures_home = {"core/plot/picture", "tests/core/plot/picture"};
constexpr std::array<std::string_view, 1> potrace = {"potracelib.h"};
constexpr std::array<std::string_view, 1> potrace_home = {"core/plot/picture"};
constexpr std::array<std::string_view, 1> gltf = {"tiny_gltf.h"};
constexpr std::array<std::string_view, 1> gltf_home = {"core/geometry"};
constexpr std::array<std::string_view, 1> assimp = {"assimp/"};
constexpr std::array<std::string_view, 10> cascade = {
    "APIHeader", "BRep", "Geom", "GC", "IGES", "Message", "STEP", "Standard_", "TCol", "Top"};
constexpr std::array<std::string_view, 2> exchange_home = {"core/exchange", "tests/core/exchange"};
constexpr std::array<std::string_view, 1> fcl = {"fcl/"};
constexpr std::array<std::string_view, 1> fcl_home = {"core/simulation"};
constexpr std::array homes = {
    Home{"TBB", tbb, tbb_home},
    Home{"GLM", glm, glm_home},
    Home{"Dear ImGui or GLFW", window, screen_home},
    Home{"OpenGL", opengl, screen_home},
    Home{"Xlib", xlib, xlib_home},
    Home{"nlohmann-json", json, json_home},
    Home{"Boost.Asio", asio, asio_home},
    Home{"Boost.Polygon", voronoi, voronoi_home},
    Home{"Clipper", clipper, clipper_home},
    Home{"libpng or libjpeg", pictures, pictures_home},
    Home{"potrace", potrace, potrace_home},
    Home{"tinygltf", gltf, gltf_home},
    Home{"assimp", assimp, exchange_home},
    Home{"FCL", fcl, fcl_home},
    Home{"Open CASCADE", cascade, exchange_home},
};

std::string away_from_home(std::string_view path, const Include& include) {
    for (const auto& [library, headers, places] : homes) {
        const auto names = [&](std::string_view beginning) { return include.path.starts_with(beginning); };
        const auto covers = [&](std::string_view place) { return is_inside(path, place); };
        if (std::ranges::any_of(headers, names) && std::ranges::none_of(places, covers)) {
            return std::string(library) + " is not used here";
        }
    }
    return {};
}

// A header that shows JSON makes everybody who includes it know the library.
std::string json_in_a_header(std::string_view path, const Include& include) {
    const bool shown = is_header(path) && path.find("/internal/") == std::string_view::npos;
    return shown && include.path.starts_with("nlohmann/") && !include.path.ends_with("json_fwd.hpp")
               ? "nlohmann-json stays in a .cpp or in internal/"
               : "";
}

std::string not_from_the_root(std::string_view, const Include& include) {
    constexpr std::array<std::string_view, 5> roots = {"app/", "bench/", "core/", "tests/", "ui/"};
    const auto begins = [&](std::string_view root) { return include.path.starts_with(root); };
    const bool ours = std::ranges::any_of(roots, begins);
    if (include.quoted == ours) {
        return {};
    }
    return ours ? "our own headers are included with quotes"
                : "quoted includes start at the repository's root, outside headers have angle brackets";
}

constexpr std::array rules = {
    upward_in_core,
    upward_in_ui,
    upward_in_app,
    across_border,
    into_internal,
    away_from_home,
    json_in_a_header,
    not_from_the_root,
};

} // namespace

std::vector<Include> includes_of(std::string_view text) {
    std::vector<Include> includes;
    for (const auto& line : lines_of(text)) {
        if (const auto include = include_in(line)) {
            includes.push_back(*include);
        }
    }
    return includes;
}

std::vector<Finding> check_includes(const std::vector<TextFile>& files) {
    std::vector<Finding> findings;
    for (const auto& [path, text] : files) {
        if (!is_source(path)) {
            continue;
        }
        for (const auto& include : includes_of(text)) {
            for (const auto rule : rules) {
                if (auto sentence = rule(path, include); !sentence.empty()) {
                    findings.push_back({path, include.line, sentence + ": " + std::string(include.path)});
                }
            }
        }
    }
    return findings;
}

} // namespace millwright::architecture
