// What a verdict about a driver depends on.
#pragma once

#include <string>

namespace rpf {

/// The features of the processor, which one name may stand for several of; empty where it is not known.
std::string processor_state();

/// Everything cheap to know that decides whether an OpenCL driver works here: host, kernel and processor, the
/// environment that drivers, loader and linker read, the drivers' files, the linker, resource limits, what is mounted.
/// A few hundred file lookups at most, about a millisecond.
std::string machine_state();

}  // namespace rpf
