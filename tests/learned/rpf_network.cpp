// Networks and stages of the learned estimator, for what compares them with other implementations.
//   rpf_network random FILE NAME SEED S E C0 C1 ...     writes a network of random weights
//   rpf_network stages SAMPLES MODEL FOLDER             writes every stage of a whole frame: FOLDER/<stage>.f32, raw
//                                                       little-endian floats, and FOLDER/stages.json: their shapes, and
//                                                       what the plan says
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "learned/network_file.h"
#include "learned/observe.h"
#include "rpf/error.h"
#include "rpf/io.h"
#include "run/backends.h"
#include "test_networks.h"

namespace {

using Json = nlohmann::json;

int write_random(const std::vector<std::string>& arguments) {
  rpf::test::NetworkOptions options;
  options.seed = static_cast<std::uint32_t>(std::stoul(arguments.at(2)));
  options.shape.sample_features = std::stoi(arguments.at(3));
  options.shape.embedding = std::stoi(arguments.at(4));
  options.shape.channels.clear();
  for (std::size_t i = 5; i < arguments.size(); ++i) options.shape.channels.push_back(std::stoi(arguments[i]));
  rpf::Network network = rpf::test::random_network(options);
  network.name = arguments.at(1);
  rpf::test::write_network(network, arguments.at(0));
  return 0;
}

void write_floats(const std::string& path, const std::vector<float>& values) {
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(values.data()),  // NOLINT
             static_cast<std::streamsize>(values.size() * sizeof(float)));
}

int write_stages(const std::vector<std::string>& arguments) {
  rpf::Settings settings;
  settings.method = rpf::Method::learned;
  settings.model = arguments.at(1);
  if (const char* backend = std::getenv("RPF_BACKEND")) settings.backend = backend;
  const rpf::Observed observed =
      rpf::observe(rpf::read_samples(arguments.at(0), {}), settings, rpf::find_network(settings.model));
  const rpf::PreparedFrame& prepared = observed.prepared;
  const rpf::EstimatePlan& plan = observed.plan;
  const std::unique_ptr<rpf::Backend> backend = rpf::make_backend(settings);
  backend->load_estimate(prepared.frame, plan);
  Json all = {{"width", plan.width},
              {"height", plan.height},
              {"exposure", plan.exposure},
              {"radiance_scale", prepared.facts.radiance_scale},
              {"has_albedo", plan.has_albedo},
              {"live", plan.live},
              {"first_sample", prepared.frame.first_sample}};
  for (const rpf::EstimateStage& stage : backend->trace_estimate({0, 0, plan.width, plan.height})) {
    write_floats(arguments.at(2) + "/" + stage.name + ".f32", stage.values);
    all["stages"].push_back({{"name", stage.name}, {"channels", stage.channels}});
  }
  std::ofstream(arguments.at(2) + "/stages.json") << all.dump() << '\n';
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + std::min(argc, 2), argv + argc);
  try {
    if (argc > 7 && std::string(argv[1]) == "random") return write_random(arguments);
    if (argc == 5 && std::string(argv[1]) == "stages") return write_stages(arguments);
    std::fputs("usage: rpf_network random FILE NAME SEED S E C0 ... | stages SAMPLES MODEL FOLDER\n", stderr);
    return 2;
  } catch (const rpf::Error& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return static_cast<int>(e.kind());
  }
}
