// The conformance suite in streaming form: every frame and all its settings as if they did not fit into memory.
// The cases that are quick are a suite of their own: --gtest_filter='Quick*'.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <ostream>

#include "conformance/cases.h"
#include "rpf/devices.h"
#include "streaming.h"
#include "temporary_folder.h"
#include "test_networks.h"

namespace rpf {

/// For the messages of a test that fails.
void PrintTo(const ConformanceCase& c, std::ostream* out) { *out << c.name; }

namespace {

class Streaming : public testing::TestWithParam<ConformanceCase> {
 protected:
  static SampleBuffer samples_of(const ConformanceCase& c) {
    SampleBuffer samples = render_scene(c.scene, c.options);
    if (c.change) c.change(samples);
    return samples;
  }

  Settings settings_of(const ConformanceCase& c) const {
    Settings settings = c.settings;
    settings.backend = "cpu";
    if (c.network) settings.model = test::write_network(*c.network, folder_.file("case.rpfnet"));
    return settings;
  }

 private:
  TemporaryFolder folder_;
};

/// Streams have the bits in core on the reference; and so has the device, streaming.
class Streams : public Streaming {};

TEST_P(Streams, WithTheBitsInCore) {
  const SampleBuffer samples = samples_of(GetParam());
  Settings settings = settings_of(GetParam());
  Result in_core = filter(samples, settings);
  EXPECT_EQ(test::difference_when_streamed(samples, settings, in_core), "");
  if (devices().empty()) GTEST_SKIP() << "on the reference alone: no OpenCL device";
  settings.backend = "opencl";
  const Result on_device = test::streamed(samples, settings);
  EXPECT_EQ(on_device.report.backend.rfind("opencl", 0), 0U) << on_device.report.backend;
  in_core.report.backend = on_device.report.backend;
  in_core.image.metadata = on_device.image.metadata;  // which names the backend
  EXPECT_EQ(test::difference(on_device, in_core), "");
}

/// What needs the frame in memory says so.
class Refuses : public Streaming {};

TEST_P(Refuses, WhatNeedsTheFrameInMemory) {
  const SampleBuffer samples = samples_of(GetParam());
  EXPECT_EQ(test::difference_when_streamed(samples, settings_of(GetParam()), {}), "");
}

std::vector<ConformanceCase> cases(bool quick, bool refused) {
  std::vector<ConformanceCase> chosen;
  for (ConformanceCase& c : all_conformance_cases())
    if (c.quick == quick && test::refusal_of(c.settings).empty() != refused) chosen.push_back(std::move(c));
  return chosen;
}

std::string name_of(const testing::TestParamInfo<ConformanceCase>& info) {
  std::string name = info.param.name;
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  return std::to_string(info.index) + "_" + name;
}

INSTANTIATE_TEST_SUITE_P(Quick, Streams, testing::ValuesIn(cases(true, false)), name_of);
INSTANTIATE_TEST_SUITE_P(Further, Streams, testing::ValuesIn(cases(false, false)), name_of);
INSTANTIATE_TEST_SUITE_P(Quick, Refuses, testing::ValuesIn(cases(true, true)), name_of);
INSTANTIATE_TEST_SUITE_P(Further, Refuses, testing::ValuesIn(cases(false, true)), name_of);

}  // namespace
}  // namespace rpf
