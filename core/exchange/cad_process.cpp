// millwright-cad FILE: reads a STEP or IGES file and says on standard output what is in it, in frames. A
// process of its own, so that a file that breaks the library breaks nothing else.
#include "core/base/error.h"
#include "core/exchange/internal/cad_frames.h"
#include "core/exchange/internal/cad_reading.h"

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>

namespace millwright::exchange {

namespace {

bool say(const Frame& frame) {
    const std::string bytes = framed(frame);
    return std::fwrite(bytes.data(), 1, bytes.size(), stdout) == bytes.size() && std::fflush(stdout) == 0;
}

int read(const char* file) {
    const Progress progress([](const Progress::Report& report) { (void)say(progress_frame(report)); }, {});
    try {
        return say({FrameKind::model, packed(read_cad_here(file, progress))}) ? 0 : 1;
    } catch (const Error& error) {
        return say(error_frame(error.diagnostic())) ? 0 : 1;
    } catch (const std::exception& failure) {
        return say(error_frame({{}, std::string("the file cannot be read: ") + failure.what(), ""})) ? 0 : 1;
    }
}

} // namespace

} // namespace millwright::exchange

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fputs("usage: millwright-cad FILE\n", stderr);
        return 2;
    }
    // All is said and flushed; what the library still holds goes with the process.
    std::_Exit(millwright::exchange::read(argv[1]));
}
