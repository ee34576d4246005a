// Owns what the workbench works with: project history, pipeline, job, session, document. One a program; the
// app builds it and hands it to the window. Everything that changes passes through perform().
#pragma once

#include "ui/actions/action.h"

#include <filesystem>
#include <functional>
#include <memory>

namespace millwright::actions {

struct WorkshopOptions {
    std::filesystem::path assets;     ///< what ships with the program
    std::filesystem::path log_folder; ///< of jobs
    std::filesystem::path settings;   ///< file of the recent files; empty: keep none
    std::function<void()> wake;       ///< from any thread: draw a frame
};

class Workshop {
public:
    explicit Workshop(WorkshopOptions options);
    Workshop(const Workshop&) = delete;
    Workshop& operator=(const Workshop&) = delete;
    ~Workshop();

    [[nodiscard]] const Catalogue& catalogue() const { return catalogue_; }
    /// For one frame; valid until the next call of a member that is not const.
    [[nodiscard]] Workbench look() const;

    /// Carries out what was asked; what an Error says becomes a notice and changes nothing.
    void perform(ActionQueue& asked);
    void run(std::string_view id);

    /// Lets `seconds` of wall time pass for what plays. True if the picture changed.
    bool advance(double seconds);

    /// Replaces the project by the file's. Throws Error; the open project then stays.
    void open(const std::filesystem::path& file);
    void save(const std::filesystem::path& file);
    void new_from_preset(std::string_view preset_id);
    void edit(const std::string& title,
              const std::function<void(project::Project&)>& change,
              const std::string& merge_key);
    void end_step() { history_.close_step(); }

    [[nodiscard]] Session& session() { return session_; }
    /// Blocks until nothing runs in the background (tests, pictures).
    void wait_idle();

private:
    void request_plan();
    void guarded(const std::function<void()>& action);

    WorkshopOptions options_;
    Catalogue catalogue_;
    project::History history_;
    Session session_;
    Document document_;
    std::unique_ptr<project::Pipeline> pipeline_;
    std::unique_ptr<JobRunner> jobs_;
};

} // namespace millwright::actions
