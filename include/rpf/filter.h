// The filter: samples in, image and report out.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "rpf/image.h"
#include "rpf/samples.h"
#include "rpf/settings.h"

namespace rpf {

/// Handed to Control::progress between tiles.
struct Progress {
  int pass = 0, passes = 0;  ///< pass 0 is the first; a learned estimate is one
  bool compiling = false;    ///< kernels are compiled just now, which is no part of the work
  double fraction = 0;       ///< of the whole work, 0 .. 1, weighted by the passes' cost
  double seconds = 0;        ///< since the start
  double seconds_left = 0;   ///< estimate; negative while there is no estimate yet
};

/// How a caller watches and stops a run.
struct Control {
  /// Called from the calling thread at least every half second or so of work. Returning false cancels: filter() throws
  /// Error(cancelled).
  std::function<bool(const Progress&)> progress;
  /// Pixels handed to the backend at once; 0: chosen so that progress and cancelling work. Never changes the result.
  std::size_t tile_pixels = 0;
};

/// What a pass did: means over the filtered pixels that have samples.
struct PassReport {
  int box_width = 0;
  double neighbors = 0;        ///< N, own samples included
  double acceptance = 0;       ///< accepted candidates / candidates drawn
  double fraction_random = 0;  ///< W_c^r
  double alpha = 0, beta = 0;  ///< over the channels too
  double energy = 0;           ///< sum of the image after the pass / sum of the plain mean of the samples
  double seconds = 0;          ///< wall time
};

/// What was found in the input and how it was treated: samples left out, values missing, clamped or negative, empty
/// pixels. Also in the attribute rpf:notes of the image.
struct InputNote {
  std::string what;  ///< for example "samples left out: R, G or B not finite"
  std::uint64_t count = 0;
  int x = 0, y = 0;  ///< pixel of the first one, in the coordinates of the data window
};

/// What in the values contradicts docs/file-format.md, so that the filter would quietly go wrong: positions outside
/// their pixel, random numbers outside [0,1], normals that are not unit, and so on; each with what to do. Empty where
/// nothing does.
std::vector<InputNote> check_conventions(const SampleBuffer& samples);

/// What a run was: who ran, what was modeled, what was found, what every pass did.
struct Report {
  std::string backend;                        ///< that ran, with its device: "cpu", "opencl (device)"; for "auto" why
  std::string model, model_hash;              ///< the network of a learned estimate: its name, and the hash of its file
  std::vector<std::string> random, features;  ///< modeled channels
  std::vector<std::string> dropped;           ///< selected channels that are constant over the frame
  std::vector<std::string> uninformative;     ///< selected channels that Settings::drop_uninformative left out
  std::vector<InputNote> notes;
  std::vector<PassReport> passes;
  double seconds = 0;
};

/// What filter() makes.
struct Result {
  Image image;  ///< R, G, B (A), over the crop or the whole data window
  /// The filtered features where Settings::filter_features asks for them: channels N.X, albedo.R, ...; behind them
  /// "error" where Settings::estimate_error asks for it.
  Image features;
  Report report;
};

/// Filters a frame. Takes the buffer over and works in it; pass a copy to keep it.
/// Throws Error(usage) for a setting that cannot be, Error(input) for an invalid buffer, or one with too few samples
/// for what is asked, Error(memory), Error(cancelled). The result does not depend on the number of threads or the tile
/// size.
Result filter(SampleBuffer samples, const Settings& settings, const Control& control = {});

/// The slots of a layout that filter() uses with these settings; without the others the result has the same bits. Notes
/// about channels that are left out are then missing. Throws Error(usage) for a group that the layout does not have,
/// and for a model that cannot be found; Error(input) for one that is none.
std::vector<std::string> needed_slots(const SampleLayout& layout, const Settings& settings);

/// What a memory estimate needs to know of a frame.
struct FrameSize {
  std::uint64_t pixels = 0;
  std::uint64_t samples = 0;
  std::uint32_t max_samples_per_pixel = 0;
  int width = 0;  ///< pixels of a row
};

/// Peak bytes of reading the slots of `layout` and filtering such a frame, none of its channels being constant. Throws
/// Error(usage), and Error(input) for an error that could not be estimated, as filter() does.
std::uint64_t predict_memory(const FrameSize& size, const SampleLayout& layout, const Settings& settings);

/// The names accepted by Settings::backend, "auto" among them.
std::vector<std::string> backend_names();

/// Bytes that this process can have: the least of the machine's memory, the limits of its control groups and of those
/// above them (version 1 or 2), and `ulimit -v` and `-d`.
std::uint64_t available_memory();

/// The number of threads that 0 stands for: cores of the affinity mask, or of the control groups (cpu.max), if fewer.
int available_threads();

}  // namespace rpf
