// Jobs whose program was killed before they ended: looked for once, in the background, when the program
// starts.
#pragma once

#include "core/jobs/recovery.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

namespace millwright::actions {

class JobRecovery {
public:
    using Stories = std::vector<jobs::JobStory>;

    /// Looks into `folder`; `wake` is called from its thread if something was found.
    JobRecovery(std::filesystem::path folder, std::function<void()> wake);
    JobRecovery(const JobRecovery&) = delete;
    JobRecovery& operator=(const JobRecovery&) = delete;
    ~JobRecovery() = default;

    /// Never null. Newest first.
    [[nodiscard]] std::shared_ptr<const Stories> broken() const;
    /// Marks the newest as seen, for every start to come. Throws Error if it cannot; it then stays.
    void dismiss();
    /// Asks again at the next start.
    void later();
    /// Blocks until it has looked (tests).
    void wait_idle();

private:
    void look(const std::filesystem::path& folder, const std::function<void()>& wake);
    void drop_first();

    mutable std::mutex mutex_; ///< guards what follows
    std::shared_ptr<const Stories> broken_ = std::make_shared<const Stories>();
    std::jthread thread_; // last: it ends before what it uses
};

} // namespace millwright::actions
