// Reading and writing STEP and IGES files by a child process, millwright-cad.
#include "core/base/error.h"
#include "core/base/files.h"
#include "core/exchange/cad_file.h"
#include "core/exchange/internal/cad_child.h"
#include "core/exchange/internal/cad_frames.h"

#include <fmt/format.h>
#include <unistd.h>

#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

namespace millwright::exchange {

namespace {

/// An empty file in the folder for temporary files, removed with the object.
class ScratchFile {
public:
    ScratchFile() : path_((std::filesystem::temp_directory_path() / "millwright-XXXXXX.step").string()) {
        constexpr int suffix = 5;
        const int handle = ::mkstemps(path_.data(), suffix);
        if (handle < 0) {
            throw Error("the file cannot be created", path_);
        }
        ::close(handle);
    }
    ScratchFile(const ScratchFile&) = delete;
    ScratchFile& operator=(const ScratchFile&) = delete;
    ~ScratchFile() {
        std::error_code gone_already;
        std::filesystem::remove(path_, gone_already);
    }
    [[nodiscard]] const std::string& path() const { return path_; }

private:
    std::string path_;
};

/// The model that the child sends. Throws the error that it reports, about `file`, or "DAMAGE: Open CASCADE
/// ends
/// ..." if it ends without either.
CadModel answer_of(CadChild child,
                   const std::filesystem::path& file,
                   std::string_view damage,
                   const Progress& progress) {
    std::optional<CadModel> model;
    std::string stream;
    for (bool talks = true; talks;) {
        progress.check();
        talks = child.listen(stream);
        while (const auto frame = take_frame(stream)) {
            if (frame->kind == FrameKind::model) {
                model = unpacked(frame->bytes);
            } else if (frame->kind == FrameKind::error) {
                Diagnostic diagnostic = told_error(*frame);
                diagnostic.place.file = file;
                throw Error(std::move(diagnostic));
            } else {
                const Progress::Report report = told_progress(*frame);
                progress.report(report.fraction, report.text);
            }
        }
    }
    const std::string fault = child.end();
    if (!fault.empty() || !model) {
        throw Error(
            fmt::format(
                "{}: Open CASCADE stopped unexpectedly{}{}", damage, fault.empty() ? "" : ", ", fault),
            file);
    }
    return std::move(*model);
}

} // namespace

bool reads_cad_files() {
    return true;
}

CadModel read_cad(const std::filesystem::path& file, const Progress& progress) {
    return answer_of(CadChild({"read", file.string()}, {}, file), file, "the file is damaged", progress);
}

void write_step(const geometry::Surface& surface,
                const std::filesystem::path& file,
                const Progress& progress) {
    const ScratchFile scratch;
    CadModel model;
    model.faces.emplace_back().patches = surface.patches();
    progress.report(0.0, "making the faces");
    (void)answer_of(CadChild({"write", scratch.path(), file.stem().string()}, packed(model), file),
                    file,
                    "the surface cannot be written as STEP",
                    progress.part(0.0, 0.9));
    progress.report(0.9, "writing the file");
    progress.check(); // from here on the old file is gone
    write_file(file, read_file(scratch.path()));
    progress.report(1.0);
}

} // namespace millwright::exchange
