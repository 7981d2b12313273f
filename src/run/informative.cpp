#include "run/informative.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "run/information.h"

namespace rpf {
namespace {

/// Moves the kept variables of every record together.
void repack(Frame& frame, const std::vector<std::size_t>& kept) {
  float* to = frame.records.data();
  for (std::size_t i = 0; i < frame.sample_count(); ++i) {
    const float* record = frame.record(i);
    for (const std::size_t v : kept) *to++ = record[v];  // `kept` ascends: never before what is still to be read
  }
  frame.variables = kept.size();
  frame.records.resize(frame.sample_count() * kept.size());
  frame.has_missing = std::any_of(frame.records.begin(), frame.records.end(), [](float x) { return std::isnan(x); });
}

}  // namespace

void drop_uninformative(PreparedFrame& prepared, const Settings& settings) {
  std::vector<std::string> names;
  for (const ChannelEvidence& channel : measure_information(prepared, settings))
    if (channel.is_uninformative()) names.push_back(channel.name);
  drop_channels(prepared, names);
}

void drop_channels(PreparedFrame& prepared, const std::vector<std::string>& names) {
  Variables variables;
  std::vector<std::size_t> kept(Variables::random);  // color and position
  std::iota(kept.begin(), kept.end(), 0);
  std::size_t v = Variables::random;
  const auto keep = [&](const std::vector<std::string>& from, std::vector<std::string>& to) {
    for (const std::string& name : from) {
      if (std::find(names.begin(), names.end(), name) == names.end()) {
        kept.push_back(v);
        to.push_back(name);
      }
      ++v;
    }
  };
  keep(prepared.facts.variables.random_names, variables.random_names);
  keep(prepared.facts.variables.feature_names, variables.feature_names);
  prepared.uninformative = names;
  if (names.empty()) return;
  prepared.facts.variables = variables;
  repack(prepared.frame, kept);
}

}  // namespace rpf
