// Every sampler and every seed lead to the same picture, at the rate they should.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "every_scene.h"
#include "rpf/metrics.h"
#include "rpf/scene.h"

namespace {

rpf::Image mean_of(const std::string& name, int samples, rpf::SceneSampler sampler, std::uint32_t seed) {
  rpf::SceneOptions options;
  options.width = 32;
  options.height = 18;
  options.samples = samples;
  options.sampler = sampler;
  options.seed = seed;
  return render_reference(name, options);
}

double residual(const rpf::Image& image) { return std::get<float>(image.metadata.at("rpf:residualRelMSE")); }

class EveryScene : public testing::TestWithParam<std::string> {};

// The relative squared difference of two pictures is the sum of their own errors, if they have the same expectation.
TEST_P(EveryScene, HasTheSameExpectationForEverySampler) {
  const rpf::Image random = mean_of(GetParam(), 1024, rpf::SceneSampler::random, 1);
  for (const rpf::SceneSampler sampler : {rpf::SceneSampler::stratified, rpf::SceneSampler::sobol}) {
    const rpf::Image other = mean_of(GetParam(), 1024, sampler, 2);
    const rpf::ImageError error = compare_images(other, random);
    EXPECT_LE(error.relmse, 2 * (residual(random) + residual(other)) + 1e-12);
    EXPECT_NEAR(error.energy, 1, GetParam() == "dof-hdr" ? 0.08 : 0.02);  // few samples carry the light there
    EXPECT_LE(residual(other), 1.5 * residual(random));
  }
}

TEST_P(EveryScene, ConvergesLikeOneOverTheNumberOfSamples) {
  const rpf::Image reference = mean_of(GetParam(), 4096, rpf::SceneSampler::sobol, 7);
  if (residual(reference) == 0) return;  // constant
  const double few = compare_images(mean_of(GetParam(), 16, rpf::SceneSampler::random, 3), reference).relmse;
  const double many = compare_images(mean_of(GetParam(), 256, rpf::SceneSampler::random, 4), reference).relmse;
  EXPECT_NEAR(std::log(many / few) / std::log(16.0), -1, 0.25);
}

INSTANTIATE_TEST_SUITE_P(Scenes, EveryScene, testing::ValuesIn(rpf::test::scene_names()), rpf::test::name_of_scene);

}  // namespace
