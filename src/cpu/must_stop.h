// Long pixels end early where nobody wants them any more.
#pragma once

#include <tbb/task_group.h>

namespace rpf {

/// Whether the task that runs here was cancelled: what it computes is thrown away. Takes some nanoseconds; asked after
/// some ten thousand operations.
inline bool must_stop() { return tbb::is_current_task_group_canceling(); }

}  // namespace rpf
