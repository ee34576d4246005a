// millwright-cad: Open CASCADE in a process of its own, so that a file that breaks the library breaks nothing
// else and a program that needs none of it starts at once. It answers on standard output, in frames.
//   millwright-cad read FILE          sends what is in a STEP or IGES file
//   millwright-cad write FILE NAME    writes the patches of the model on standard input as a STEP file
#include "core/base/error.h"
#include "core/exchange/internal/cad_frames.h"
#include "core/exchange/internal/cad_reading.h"

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <functional>
#include <iostream>
#include <iterator>
#include <string>
#include <string_view>

namespace millwright::exchange {

namespace {

bool say(const Frame& frame) {
    const std::string bytes = framed(frame);
    return std::fwrite(bytes.data(), 1, bytes.size(), stdout) == bytes.size() && std::fflush(stdout) == 0;
}

geometry::Surface surface_from_input() {
    const std::string bytes{std::istreambuf_iterator<char>(std::cin), {}};
    return geometry::Surface(unpacked(bytes).faces.at(0).patches);
}

/// Sends the model that `work` gives, or why there is none; the exit code.
int answer(const std::function<CadModel(const Progress&)>& work) {
    const Progress progress([](const Progress::Report& report) { (void)say(progress_frame(report)); }, {});
    try {
        return say({FrameKind::model, packed(work(progress))}) ? 0 : 1;
    } catch (const Error& error) {
        return say(error_frame(error.diagnostic())) ? 0 : 1;
    } catch (const std::exception& failure) {
        return say(error_frame({{}, std::string("Open CASCADE failed: ") + failure.what(), ""})) ? 0 : 1;
    }
}

int run_cad(int argc, char** argv) {
    const std::string_view task = argc > 1 ? argv[1] : "";
    if (task == "read" && argc == 3) {
        return answer([&](const Progress& progress) { return read_cad_here(argv[2], progress); });
    }
    if (task == "write" && argc == 4) {
        return answer([&](const Progress& progress) {
            write_step_here(surface_from_input(), argv[3], argv[2], progress);
            return CadModel();
        });
    }
    std::fputs("usage: millwright-cad read FILE | write FILE NAME\n", stderr);
    return 2;
}

} // namespace

} // namespace millwright::exchange

int main(int argc, char** argv) {
    // All is said and flushed; what the library still holds goes with the process.
    std::_Exit(millwright::exchange::run_cad(argc, argv));
}
