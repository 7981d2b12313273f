// Writes a frame of known numbers with the header for renderers, its pixels from the last to the first, shared out to
// threads. Usage: write_numbers OUTPUT.rpf WIDTH HEIGHT MOST_SAMPLES THREADS. Pixel p has p * 7 mod (MOST_SAMPLES + 1)
// samples, and value c of sample s of pixel p is 1000 p + 10 s + c. The exit code is what rpf_samples_finish()
// returned; its error goes to stderr.
#include <string>
#include <thread>
#include <vector>

#include "rpf_samples.h"

namespace {

constexpr int channel_count = 6;
const char* const channels[channel_count] = {"R", "G", "B", "film.X", "film.Y", "random.time"};

void add_pixel(rpf_samples* file, int pixel, int width, int most_samples) {
  std::vector<float> records;
  const int samples = pixel * 7 % (most_samples + 1);
  for (int s = 0; s < samples; ++s)
    for (int c = 0; c < channel_count; ++c) records.push_back(static_cast<float>(1000 * pixel + 10 * s + c));
  rpf_samples_add(file, pixel % width, pixel / width, samples, records.data());
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 6) return 9;
  const int width = std::stoi(argv[2]), height = std::stoi(argv[3]), most = std::stoi(argv[4]),
            count = std::stoi(argv[5]);
  rpf_samples* file = rpf_samples_open(argv[1], 0, 0, width, height, channels, channel_count);
  rpf_samples_integer(file, "rpf:seed", 7);
  std::vector<std::thread> threads;
  for (int t = 0; t < count; ++t)
    threads.emplace_back([=] {
      for (int pixel = width * height - 1 - t; pixel >= 0; pixel -= count) add_pixel(file, pixel, width, most);
    });
  for (std::thread& thread : threads) thread.join();
  const int status = rpf_samples_finish(file);
  fprintf(stderr, "%s", rpf_samples_error(file));
  rpf_samples_free(file);
  return status;
}
