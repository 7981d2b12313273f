// Many small frames in one process: memory and descriptors after the first ten must not grow.
// Usage: soak BACKEND FRAMES
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

#include "rpf/filter.h"
#include "rpf/scene.h"

namespace {

constexpr int warm_up = 10;
// Pages that the allocator keeps differently from frame to frame, and one more arena; a frame alone takes 1 MB.
constexpr long allowed_kilobytes = 4096;

long resident_kilobytes() {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;)
    if (word == "VmRSS:") {
      long value = 0;
      status >> value;
      return value;
    }
  return 0;
}

long descriptors() {
  const std::filesystem::directory_iterator entries("/proc/self/fd");
  return std::distance(begin(entries), end(entries));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  rpf::Settings settings;
  settings.backend = argv[1];
  settings.box_widths = {9, 5};
  settings.threads = 2;
  rpf::SceneOptions options;
  options.width = 48;
  options.height = 32;
  const rpf::SampleBuffer samples = rpf::render_scene("dof", options);
  long memory = 0, open = 0;
  const int frames = std::stoi(argv[2]);
  for (int frame = 1; frame <= frames; ++frame) {
    settings.seed = static_cast<std::uint32_t>(frame);
    rpf::filter(samples, settings);
    if (frame == warm_up) memory = resident_kilobytes(), open = descriptors();
  }
  const long grown = resident_kilobytes() - memory, opened = descriptors() - open;
  std::printf("%s: %d frames, after the first %d: %ld KB and %ld descriptors; then %+ld KB and %+ld descriptors\n",
              argv[1], frames, warm_up, memory, open, grown, opened);
  return grown <= allowed_kilobytes && opened <= 0 ? 0 : 1;
}
