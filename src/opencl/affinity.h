// On which processors a driver's threads run.
#pragma once

namespace rpf {

/// Has each of PoCL's threads stay on a processor of its own, as those of Open Image Denoise do. They are woken for
/// every launch, and Linux wakes two of them on one processor, while others idle: on two processors a frame took up to
/// 1.5 times as long by the clock. Not where the process was given some processors only (PoCL counts them from 0), nor
/// where POCL_AFFINITY is set. Call it before a driver is loaded.
void keep_driver_threads_apart();

}  // namespace rpf
