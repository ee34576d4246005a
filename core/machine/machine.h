// The machine at the other end: drivers that move it, jobs that are sent to it, and the log of what it
// provably did (docs/reference/job-log.md). Nothing here moves anything by itself.
#pragma once

#include "core/machine/clock.h"
#include "core/machine/dispatcher.h"
#include "core/machine/driver.h"
#include "core/machine/job.h"
#include "core/machine/job_log.h"
