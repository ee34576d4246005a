// What every room of the core uses: errors with a place, progress and cancellation, parallel loops with the
// same result on any number of threads, numbers as text, whole files. It knows nothing of machining.
#pragma once

#include "core/base/counted.h"
#include "core/base/error.h"
#include "core/base/files.h"
#include "core/base/json.h"
#include "core/base/numbers.h"
#include "core/base/parallel.h"
#include "core/base/progress.h"
#include "core/base/text.h"
#include "core/base/units.h"
