// The real program as a child process, the way a person's shell runs it.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

namespace millwright::test {

struct Ended {
    int exit_code = -1; ///< minus the signal's number if it died of one
    std::string out;
    std::string err;
};

/// A started program. Without DISPLAY and WAYLAND_DISPLAY; `input` is what it finds on standard input, no
/// more than a pipe holds (64 KiB); `launcher` is the command that starts it, as mpirun.
class Program {
public:
    explicit Program(const std::vector<std::string>& arguments,
                     const std::string& input = {},
                     const std::vector<std::string>& launcher = {});
    Program(const Program&) = delete;
    Program& operator=(const Program&) = delete;
    ~Program();

    /// Blocks until `text` stood in standard error, or the program ended.
    void wait_for_error_text(const std::string& text);
    void send(int signal) const;
    [[nodiscard]] pid_t pid() const { return child_; }
    /// More for its standard input.
    void type(const std::string& keys) const;
    /// Blocks until it ended; its standard input ends before.
    [[nodiscard]] Ended end();

private:
    /// Reads what comes; false at the end of both streams.
    bool read_some();

    pid_t child_ = -1;
    int in_ = -1;
    int out_ = -1;
    int err_ = -1;
    Ended ended_;
};

[[nodiscard]] std::filesystem::path program_file();

/// Runs the program and kills it, as kill -9 does, right after its call number `n` that renames, links or
/// removes a file; it ends as ever if it makes fewer.
[[nodiscard]] Ended run_killed_at(int n, const std::vector<std::string>& arguments);

/// Runs the program to its end.
[[nodiscard]] Ended run(const std::vector<std::string>& arguments, const std::string& input = {});

/// A copy of a shipped project in `folder`, small and quick, with `from` replaced by `to` where given.
[[nodiscard]] std::filesystem::path small_project(const std::filesystem::path& folder,
                                                  const std::string& name,
                                                  const std::string& from = {},
                                                  const std::string& to = {});

[[nodiscard]] std::string content_of(const std::filesystem::path& file);
void write_content(const std::filesystem::path& file, const std::string& content);

} // namespace millwright::test
