// A job that begins at a line: worked out in the background before a person runs it, so that a person sees
// what the machine will do first.
#pragma once

#include "core/base/error.h"
#include "core/jobs/job.h"
#include "core/jobs/run_from_line.h"
#include "ui/workspaces/job_source.h"
#include "ui/workspaces/latest_work.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace millwright::actions {

/// What a person set up for beginning in the middle.
struct StartAt {
    bool on = false;
    int line = 1;                    ///< of the file
    std::optional<double> clearance; ///< as in jobs::RunFromSettings
    std::string hash;                ///< of the program that it is meant for; empty: any

    friend bool operator==(const StartAt&, const StartAt&) = default;
};

/// What is to be worked out.
struct ApproachWish {
    JobSource source;
    StartAt begin;
    gcode::Dialect dialect = gcode::Dialect::linuxcnc;

    friend bool operator==(const ApproachWish&, const ApproachWish&) = default;
};

struct Approach {
    ApproachWish wish;
    std::optional<jobs::Job> job;      ///< nothing where it is refused
    std::vector<std::string> lines;    ///< that come before the line, in their order
    std::optional<Diagnostic> refusal; ///< why a job may not begin there
};

/// Throws nothing: what is wrong is the refusal.
[[nodiscard]] Approach approach_for(const ApproachWish& wish);

class ApproachFinder {
public:
    /// `wake` is called from its thread when there is an answer.
    explicit ApproachFinder(std::function<void()> wake) : work_(work_out, std::move(wake)) {}

    /// Works on `wish` in place of the one before; nothing: on none.
    void want(std::optional<ApproachWish> wish);
    /// To the present wish; null while there is none yet.
    [[nodiscard]] std::shared_ptr<const Approach> answer() const;
    /// Blocks until nothing is left to do.
    void wait_idle() const { work_.wait_idle(); }

private:
    static Approach work_out(const ApproachWish& wish, const Progress& /*progress*/) {
        return approach_for(wish);
    }

    std::optional<ApproachWish> wish_;
    LatestWork<ApproachWish, Approach> work_;
};

} // namespace millwright::actions
