// Measurements as JSON: what rpf compare, rpf bench and rpf study write.
#pragma once

#include <nlohmann/json.hpp>

#include "bench/frame_run.h"

namespace rpf::bench {

/// The errors of one image: names and numbers as docs/commands.md lists them.
nlohmann::ordered_json json_of(const ImageError& error);

/// Energy after the last pass against the plain mean's.
double kept_energy(const Report& report);

/// A run: cpu, wall, energy, backend, modeled channels, passes and, where measured, error.
nlohmann::ordered_json json_of(const FrameRun& run);

}  // namespace rpf::bench
