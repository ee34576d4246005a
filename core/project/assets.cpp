#include "core/project/assets.h"

#include "core/base/error.h"
#include "core/base/program_files.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdlib>
#include <system_error>
#include <utility>

namespace millwright::project {

namespace fs = std::filesystem;

namespace {

bool is_assets(const fs::path& folder) {
    std::error_code failure;
    return fs::is_directory(folder / "machines", failure);
}

std::vector<fs::path> json_files(const fs::path& folder) {
    std::vector<fs::path> files;
    std::error_code failure;
    for (const auto& entry : fs::directory_iterator(folder, failure)) {
        if (entry.path().extension() == ".json") {
            files.push_back(entry.path());
        }
    }
    std::sort(files.begin(), files.end());
    return files;
}

bool is_id(const std::string& name) {
    return name.find_first_of("./") == std::string::npos;
}

std::vector<std::string> ids_in(const fs::path& folder) {
    std::vector<std::string> ids;
    for (const fs::path& file : json_files(folder)) {
        ids.push_back(file.stem().string());
    }
    return ids;
}

/// Of what `kind` calls, shipped in `shipped`.
fs::path
named_file(std::string_view kind, const std::string& name, const fs::path& folder, const fs::path& shipped) {
    const fs::path file = is_id(name) ? shipped / (name + ".json") : folder / name;
    std::error_code failure;
    if (!fs::is_regular_file(file, failure)) {
        const std::string known =
            fmt::format("known: {}; or give the path of a file", fmt::join(ids_in(shipped), ", "));
        throw is_id(name) ? Error(fmt::format("unknown {} '{}'", kind, name), {}, known)
                          : Error(fmt::format("no such {} file", kind), file, known);
    }
    return file;
}

} // namespace

fs::path assets_folder() {
    const char* named = std::getenv("MILLWRIGHT_ASSETS");
    return assets_folder({named == nullptr ? "" : named, executable(), MILLWRIGHT_SOURCE_ASSETS});
}

fs::path assets_folder(const AssetsSearch& search) {
    if (!search.named.empty()) {
        if (!is_assets(search.named)) {
            throw Error("the folder that MILLWRIGHT_ASSETS names has no subfolder machines/", search.named);
        }
        return search.named;
    }
    if (const auto machines =
            find_above(search.executable, {"assets/machines", "share/millwright/assets/machines"})) {
        return machines->parent_path();
    }
    if (!is_assets(search.fallback)) {
        throw Error("the folder assets/ that ships with the program is missing",
                    search.fallback,
                    "set MILLWRIGHT_ASSETS to its path");
    }
    return search.fallback;
}

fs::path machine_path(const std::string& name, const fs::path& folder, const fs::path& assets) {
    return named_file("machine", name, folder, assets / "machines");
}

fs::path post_path(const std::string& name, const fs::path& folder, const fs::path& assets) {
    return named_file("post", name, folder, assets / "posts");
}

fs::path arm_path(const std::string& name, const fs::path& folder, const fs::path& assets) {
    return named_file("arm", name, folder, assets / "arms");
}

fs::path machine_path(const Project& project, const fs::path& project_folder, const fs::path& assets) {
    try {
        return machine_path(project.machine.file, project_folder, assets);
    } catch (const Error& error) {
        Diagnostic found = error.diagnostic();
        found.message = "machine/file: " + found.message;
        throw Error(std::move(found));
    }
}

std::vector<std::string> machine_ids(const fs::path& assets) {
    return ids_in(assets / "machines");
}

std::vector<std::string> post_ids(const fs::path& assets) {
    return ids_in(assets / "posts");
}

std::vector<std::string> arm_ids(const fs::path& assets) {
    return ids_in(assets / "arms");
}

std::vector<fs::path> sample_projects(const fs::path& assets) {
    return json_files(assets / "projects");
}

} // namespace millwright::project
