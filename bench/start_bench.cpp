// From the start of the process to the answer of `--version` and to the first frame of the workbench with the
// sample project. The window's title names the project once a frame has been shown. Needs a display: xvfb-run
// -a -s "-screen 0 1600x1000x24 -noreset" build/release/bench/start_bench
#include <X11/Xlib.h>
#include <benchmark/benchmark.h>
#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace millwright {
namespace {

using Clock = std::chrono::steady_clock;

pid_t started(std::vector<std::string> words) {
    words.insert(words.begin(), MILLWRIGHT_PROGRAM);
    std::vector<char*> arguments;
    for (std::string& word : words) {
        arguments.push_back(word.data());
    }
    arguments.push_back(nullptr);
    const pid_t child = fork();
    if (child == 0) {
        setenv("XDG_STATE_HOME", "/tmp/millwright-start-bench", 1); // not among the user's recent files
        dup2(open("/dev/null", O_WRONLY), STDOUT_FILENO);
        execv(arguments[0], arguments.data());
        _exit(127);
    }
    return child;
}

int end_of(pid_t child) {
    int status = 0;
    return waitpid(child, &status, 0) == child && WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

struct CloseDisplay {
    void operator()(Display* display) const { XCloseDisplay(display); }
};

/// Whether a window has a title that begins so.
bool shows(Display* display, std::string_view beginning) {
    ::Window root = 0;
    ::Window parent = 0;
    ::Window* windows = nullptr;
    unsigned int count = 0;
    bool found = false;
    XQueryTree(display, DefaultRootWindow(display), &root, &parent, &windows, &count);
    for (unsigned int n = 0; n < count && !found; ++n) {
        char* title = nullptr;
        if (XFetchName(display, windows[n], &title) != 0 && title != nullptr) {
            found = std::string_view(title).starts_with(beginning);
            XFree(title);
        }
    }
    if (windows != nullptr) {
        XFree(windows);
    }
    return found;
}

void version(benchmark::State& state) {
    for (auto _ : state) {
        if (end_of(started({"--version"})) != 0) {
            state.SkipWithError("--version failed");
        }
    }
}
BENCHMARK(version)->UseRealTime()->Unit(benchmark::kMillisecond)->Iterations(20);

void first_frame(benchmark::State& state, const std::vector<std::string>& words, const std::string& title) {
    XSetErrorHandler([](Display*, XErrorEvent*) { return 0; }); // a window that has just gone
    const std::unique_ptr<Display, CloseDisplay> display(XOpenDisplay(nullptr));
    if (display == nullptr) {
        state.SkipWithError("there is no display");
        return;
    }
    for (auto _ : state) {
        const auto start = Clock::now();
        const pid_t child = started(words);
        if (child < 0) {
            state.SkipWithError("the program could not be started");
            return;
        }
        bool shown = false;
        while (!shown && Clock::now() - start < std::chrono::seconds(30)) {
            usleep(1000);
            shown = shows(display.get(), title);
        }
        state.SetIterationTime(std::chrono::duration<double>(Clock::now() - start).count());
        if (!shown) {
            state.SkipWithError("no window came within 30 s");
        }
        kill(child, SIGINT);
        (void)end_of(child);
    }
}
BENCHMARK_CAPTURE(first_frame, sample_project, {"assets/projects/dome.json"}, "dome.json - Millwright")
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond)
    ->Iterations(5);

} // namespace
} // namespace millwright
