// How a job that did not come to its end can be taken up again: from the first line that is not certain, or
// from its beginning, and why.
#pragma once

#include "core/jobs/recovery.h"

#include <string>

namespace millwright::jobs {

struct ResumePoint {
    int line = 1;                  ///< of the file; 1: its beginning
    bool needs_clearance = false;  ///< the lines before do not tell at which Z the tool can go anywhere
    std::string why_the_beginning; ///< a sentence; empty if it goes on from `line`
};

/// For a job of which something is left. Reads its program's file where the controller executes the text, to
/// try what run_from_line() says; of a job whose motion is planned here it looks at the line's number alone.
[[nodiscard]] ResumePoint resume_point(const JobStory& story);

/// What resume_point() says of any job without its program: "" if it can go on from `story.next_line`.
[[nodiscard]] std::string why_not_from_line(const JobStory& story);

} // namespace millwright::jobs
