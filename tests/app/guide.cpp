#include "tests/app/guide.h"

#include "tests/app/program.h"
#include "tests/app/shell.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <regex>
#include <sstream>
#include <string_view>

namespace millwright::test {
namespace {

namespace fs = std::filesystem;

const std::string built_program = "build/release/millwright";

/// Why a command of a document is not run: it takes no arguments that could be right everywhere, or minutes.
const std::map<std::string, std::string> not_run = {
    {"millwright study run-time --out out", "takes minutes: RunTimeStudy"},
};

std::string replaced_everywhere(std::string text, const std::string& from, const std::string& to) {
    for (auto at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) {
        text.replace(at, from.size(), to);
    }
    return text;
}

/// A bicubic strip from x = `from`, 40 mm wide.
std::string strip_project(const std::string& name, double from) {
    nlohmann::json points = nlohmann::json::array();
    for (int i = 0; i < 4; ++i) {
        nlohmann::json row = nlohmann::json::array();
        for (int j = 0; j < 4; ++j) {
            row.push_back({from + 40.0 * i / 3.0, 20.0 * j, j == 1 ? 2.0 : 0.0});
        }
        points.push_back(row);
    }
    return nlohmann::json{{"format", "millwright-project"},
                          {"version", 1},
                          {"name", name},
                          {"surface", {{"patches", {{{"points", points}}}}}},
                          {"machine", {{"file", "ac-table"}}}}
        .dump();
}

/// For people: adds a row to the file named by MILLWRIGHT_DOCUMENT_LOG, with the first line of `text`.
void add_to_log(const std::string& what, const std::string& result, const std::string& text) {
    if (const char* const log = std::getenv("MILLWRIGHT_DOCUMENT_LOG"); log != nullptr) {
        std::ofstream(log, std::ios::app)
            << "| " << what << " | " << result << " | " << text.substr(0, text.find('\n')) << " |\n";
    }
}

std::string without_progress(const std::string& output) {
    static const std::regex progress(" *[0-9]+ %  [^\n]*\n");
    return std::regex_replace(output, progress, "");
}

} // namespace

std::vector<std::string> indented_commands_of(const std::string& document) {
    static const std::regex placeholder(R"(\[|\.\.\.|\b[A-Z]{3,}\b)");
    std::vector<std::string> commands;
    std::istringstream text(document);
    for (std::string line; std::getline(text, line);) {
        if (line.starts_with("    millwright ")) {
            std::string command = line.substr(4, line.find("  #") - 4);
            command.erase(command.find_last_not_of(' ') + 1);
            if (!std::regex_search(command, placeholder)) {
                commands.push_back(command);
            }
        }
    }
    return commands;
}

std::map<std::string, std::string> files_of(const std::string& document) {
    static const std::regex named(R"(.*`([-a-z0-9]+\.[a-z]+)`:)");
    std::map<std::string, std::string> files;
    std::string name;
    bool inside = false;
    std::istringstream text(document);
    for (std::string line; std::getline(text, line);) {
        std::smatch found;
        if (line.starts_with("```")) {
            inside = !inside && !name.empty();
            name = inside ? name : "";
        } else if (inside) {
            files[name] += line + "\n";
        } else if (!line.empty()) {
            name = std::regex_match(line, found, named) ? found.str(1) : "";
        }
    }
    return files;
}

std::vector<Listing> listings_of(const std::string& document) {
    std::vector<Listing> listings;
    std::string before; // text or commands
    std::string block;  // its language; "```": none
    bool prints = false;
    std::istringstream text(document);
    for (std::string line; std::getline(text, line);) {
        if (line.starts_with("```") && block.empty()) {
            block = line;
            if (block == "```" && prints) {
                const std::vector<std::string> commands = commands_of(before);
                listings.push_back({commands.empty() ? "" : commands.back(), ""});
            }
        } else if (line == "```") {
            block.clear();
            prints = false;
        } else if (block == "```" && prints) {
            listings.back().text += line + "\n";
        } else if (block.empty() && !line.empty()) {
            prints = line.ends_with("prints");
        }
        before += line + "\n";
    }
    return listings;
}

std::vector<fs::path> documents_in(const fs::path& folder) {
    std::vector<fs::path> found;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        if (entry.path().extension() == ".md") {
            found.push_back(entry.path());
        }
    }
    std::sort(found.begin(), found.end());
    return found;
}

Guide::Guide() {
    fs::create_directories(checkout / "build/release");
    fs::create_symlink(program_file(), checkout / built_program);
    fs::create_symlink(fs::absolute("assets"), checkout / "assets");
    fs::create_directories(checkout / "tmp");
    write_content(checkout / "part.ngc", "G21 G90 G94\nG1 X1 Y1 F3000\nM30\n");
    write_content(checkout / "probe.csv",
                  "0,0,0\n0,20,1\n0,40,0\n20,0,1\n20,20,3\n20,40,1\n40,0,0\n40,20,1\n40,40,0\n");
    write_content(checkout / "left.json", strip_project("left", 0.0));
    write_content(checkout / "right.json", strip_project("right", 40.2));
    fs::copy_file("assets/samples/cover.step", checkout / "part.step");
    EXPECT_EQ(
        shell(checkout.path(), built_program + " export assets/projects/dome.json --out scan.stl").exit_code,
        0);
}

Guide::~Guide() {
    for (const std::string& pid : emulators_) {
        (void)shell(checkout.path(), "kill -INT " + pid);
    }
}

int Guide::follow_document(const std::string& document) {
    for (const auto& [name, text] : files_of(document)) {
        write_content(checkout / name, text);
    }
    const int tried = follow(commands_of(document)) + follow(indented_commands_of(document));
    for (const Listing& listing : listings_of(document)) {
        const bool same = printed_[listing.command].find(listing.text) != std::string::npos;
        add_to_log("listing of `" + listing.command + "`", same ? "same" : "differs", listing.text);
        EXPECT_TRUE(same) << "`" << listing.command << "` does not print\n"
                          << listing.text << "but\n"
                          << printed_[listing.command];
    }
    return tried;
}

int Guide::follow(const std::vector<std::string>& commands) {
    int tried = 0;
    for (const std::string& command : commands) {
        if (const auto reason = not_run.find(command); reason != not_run.end()) {
            add_to_log("`" + command + "`", "not run", reason->second);
            continue;
        }
        if (command.find(" emulate ") != std::string::npos) {
            start(command);
            add_to_log("`" + command + "`", "started", "");
        } else {
            const bool of_grbl =
                command.find("ttyUSB0") != std::string::npos && command.find(" pmac ") == std::string::npos;
            if (of_grbl && !fs::exists(checkout / "tmp/grbl")) {
                start(built_program + " emulate grbl --pty /tmp/grbl --speed 20");
                run_shown(command);
                stop_emulators();
            } else if (command.find(" pmac ") != std::string::npos &&
                       command.find(" emulate ") == std::string::npos && !fs::exists(checkout / "tmp/pmac")) {
                start(built_program + " emulate pmac --pty /tmp/pmac --wait-for-host 0.01");
                run_shown(command);
            } else {
                run_shown(command);
            }
        }
        ++tried;
    }
    stop_emulators();
    return tried;
}

std::string Guide::here(std::string command) const {
    static const std::regex real_time("--speed [0-9]+");
    const auto has = [&](std::string_view word) { return command.find(word) != std::string::npos; };
    if (command.starts_with("millwright ")) {
        command = "build/release/" + command;
    }
    if ((has(" run ") || has(" send ")) && (has("--driver virtual") || has("--driver cordic"))) {
        command = std::regex_replace(command, real_time, "") + " --speed 0";
    }
    const std::string port = has(" pmac ") ? "/tmp/pmac" : "/tmp/grbl"; // below the checkout, as all of /tmp
    for (const char* const shown : {"/dev/ttyUSB0", "tcp:127.0.0.1:1025"}) {
        command = replaced_everywhere(command, shown, port);
    }
    return replaced_everywhere(command, "/tmp/", (checkout / "tmp").string() + "/");
}

void Guide::start(const std::string& command) {
    static const std::regex tcp("--tcp [0-9]+");
    static const std::regex pty("--pty (\\S+)");
    const bool has_pty = command.find("--pty ") != std::string::npos;
    const std::string kind = command.find(" pmac") != std::string::npos ? "pmac" : "grbl";
    std::string own = std::regex_replace(here(command), tcp, "");
    const bool only_tcp = !has_pty && (kind == "pmac" || command.find(" stream") != std::string::npos);
    if (!has_pty && !only_tcp) {
        own = std::regex_replace(here(command), tcp, "--tcp 0"); // any that is free
    } else if (only_tcp) {
        own += " --pty " + (checkout / "tmp" / (kind == "pmac" ? "pmac" : "stream")).string();
    }
    std::smatch link;
    if (std::regex_search(own, link, pty) && fs::exists(link[1].str())) { // one at a port
        stop_emulators();
    }
    const std::string log = (checkout / "emulator.log").string();
    const ShellRun run = shell(checkout.path(), "{ " + own + " >'" + log + "' 2>&1 & echo $!; }");
    emulators_.push_back(run.output.substr(0, run.output.find('\n')));
    if (std::regex_search(own, link, pty)) {
        const ShellRun there = shell(checkout.path(),
                                     "for n in $(seq 600); do test -e '" + link[1].str() +
                                         "' && exit 0; sleep 0.1; done; exit 1");
        EXPECT_EQ(there.exit_code, 0) << command << '\n' << content_of(log);
    } else {
        EXPECT_EQ(shell(checkout.path(), "sleep 1; kill -0 " + emulators_.back()).exit_code, 0)
            << command << '\n'
            << content_of(log);
    }
}

void Guide::stop_emulators() {
    for (const std::string& pid : emulators_) {
        (void)shell(checkout.path(),
                    "kill -INT " + pid + "; for n in $(seq 100); do kill -0 " + pid +
                        " 2>/dev/null || break; sleep 0.1; done");
    }
    emulators_.clear();
    for (const char* const link : {"tmp/grbl", "tmp/pmac", "tmp/stream"}) {
        fs::remove(checkout / link);
    }
}

void Guide::run_shown(const std::string& command) {
    static const std::regex out("--out ([^ |]+)");
    const std::string environment =
        "MILLWRIGHT_PMAC_PORT='" + (checkout / "tmp/pmac").string() + "' timeout 300 ";
    ShellRun run = shell(checkout.path(), environment + here(command));
    // An emulated controller is a program of its own. On a computer that keeps it or the command waiting, the
    // guard of a PMAC takes the power, and a Grbl that is silent for 2 s is lost, as they should.
    const auto was_busy = [&](const std::string& output) {
        return output.find("the card received nothing from this computer for 50 ms") != std::string::npos ||
               output.find("Fault: the controller no longer answers") != std::string::npos;
    };
    for (int n = 0; n < 4 && was_busy(run.output); ++n) {
        run = shell(checkout.path(), environment + here(command));
    }
    EXPECT_EQ(run.exit_code, 0) << command << '\n' << run.output;
    printed_[command] = run.output;
    add_to_log("`" + command + "`", std::to_string(run.exit_code), without_progress(run.output));
    std::smatch file;
    if (std::regex_search(command, file, out)) {
        EXPECT_TRUE(fs::exists(checkout / file[1].str())) << command;
    }
}

} // namespace millwright::test
