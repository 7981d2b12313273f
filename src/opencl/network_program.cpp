#include "opencl/network_program.h"

#include <fmt/format.h>

#include <numeric>
#include <set>

#include "network_launch.h"
#include "opencl/target.h"

namespace rpf {
namespace {

std::vector<int> all_inputs(const NetworkLayer& layer) {
  std::vector<int> inputs(static_cast<std::size_t>(layer.inputs * layer.taps));
  std::iota(inputs.begin(), inputs.end(), 0);
  return inputs;
}

/// Rows of weights for these inputs (of all taps), outputs first .. first + count - 1, filled up to whole vectors.
std::vector<float> weights_of(const NetworkLayer& layer, const std::vector<int>& inputs, int first, int count) {
  std::vector<float> weights;
  weights.reserve(inputs.size() * static_cast<std::size_t>(padded(count)));
  for (const int input : inputs) {
    const auto row = layer.weights.begin() + static_cast<std::ptrdiff_t>(input) * layer.outputs + first;
    weights.insert(weights.end(), row, row + count);
    weights.resize(weights.size() + static_cast<std::size_t>(padded(count) - count));
  }
  return weights;
}

std::vector<float> bias_of(const NetworkLayer& layer, int first, int count) {
  std::vector<float> bias(layer.bias.begin() + first, layer.bias.begin() + first + count);
  bias.resize(static_cast<std::size_t>(padded(count)));
  return bias;
}

/// Samples have strides of their own.
LayerShape sample_shape(LayerShape shape, const char* name, int own_stride, int out_stride) {
  shape.samples = name;
  shape.own_stride = own_stride;
  shape.out_stride = out_stride;
  return shape;
}

}  // namespace

Blocking blocking_of(const cl::Device& device) {
  return floats_a_register(device) >= 16 ? Blocking{16, 32} : Blocking{8, 16};
}

NetworkProgram::NetworkProgram(Session& session, const EstimatePlan& plan, const Blocking& blocking, const Check& check)
    : session_(session), features_(plan.network->sample_features) {
  place_layers(*plan.network, plan.live);
  compile(blocking, check);
}

void NetworkProgram::place(DeviceLayer& to, const NetworkLayer& layer, const std::vector<int>& inputs, int first,
                           int count) {
  to.shape.taps = layer.taps;
  to.shape.own = static_cast<int>(inputs.size()) / layer.taps - to.shape.coarse;
  to.shape.outputs = count;
  to.shape.coarse_stride = padded(to.shape.coarse);
  to.shape.own_stride = padded(to.shape.own);
  to.shape.out_stride = padded(count);
  to.weights = session_.copy(weights_of(layer, inputs, first, count));
  to.bias = session_.copy(bias_of(layer, first, count));
}

void NetworkProgram::place_layers(const Network& network, const std::vector<int>& live) {
  layers_.resize(network.layers.size());
  for (std::size_t i = 0; i < layers_.size(); ++i) {
    const NetworkLayer& layer = network.layers[i];
    const bool is_first = i == 0;
    for (int l = 0; l + 1 < network.levels(); ++l)
      if (&layer == &network.up(l, false)) layers_[i].shape.coarse = network.channels[static_cast<std::size_t>(l + 1)];
    place(layers_[i], layer, is_first ? live : all_inputs(layer), 0, layer.outputs);
  }
  const int pass_values = network.embedding + 1 + RPF_GUIDES;
  heads_.resize(1 + static_cast<std::size_t>(network.passes()));
  for (std::size_t p = 0; p < heads_.size(); ++p) {
    heads_[p].shape.leaky = false;
    const int first = p == 0 ? 0 : RPF_CONTEXT + 1 + (static_cast<int>(p) - 1) * pass_values;
    place(heads_[p], network.head(), all_inputs(network.head()), first, p == 0 ? RPF_CONTEXT + 1 : pass_values);
  }
  DeviceLayer &sample1 = layers_[0], &sample2 = layers_[1], &enter = layers_[2], &weight1 = layers_[layers_.size() - 2];
  sample1.shape = sample_shape(sample1.shape, "sample1", 0, padded(features_));
  sample1.shape.records = true;
  sample1.shape.coarse = RPF_INPUT_NORMAL;  // computed
  sample1.shape.coarse_stride = RPF_SEEN;
  sample1.shape.own = 0;  // any number
  sample2.shape = sample_shape(sample2.shape, "sample2", padded(features_), feature_stride());
  enter.shape = sample_shape(enter.shape, "enter", padded(network.enter().inputs), padded(network.enter().outputs));
  weight1.shape = sample_shape(weight1.shape, "weight1", feature_stride(), RPF_WEIGHT_FEATURES);
  std::vector<float> last = network.weight2().weights;
  last.push_back(network.weight2().bias.front());
  last_weights_ = session_.copy(last);
}

void NetworkProgram::compile(const Blocking& blocking, const Check& check) {
  std::string text;
  std::set<std::string> names;
  const auto for_all = [&](auto body) {
    for (std::size_t i = 0; i < layers_.size(); ++i)
      if (i + 3 != layers_.size() && i + 1 != layers_.size()) body(layers_[i]);  // neither head nor weight2
    body(heads_[0]);
  };
  for_all([&](const DeviceLayer& layer) {
    if (names.insert(layer.shape.name()).second) text += layer_text(layer.shape, blocking);
  });
  const LayerShape& pass = heads_[1].shape;
  text += head_text(pass.own, pass.outputs, blocking);
  const std::string definitions = fmt::format(
      "-DRPF_HEAD_INPUTS={} -DRPF_PASS_VALUES={} -DRPF_SAMPLE_FEATURES={} -DRPF_HIDDEN_STRIDE={} "
      "-DRPF_FEATURE_STRIDE={} -DRPF_PIXEL_STRIDE={} -DRPF_ENTER_STRIDE={}",
      pass.own, pass.outputs, features_, padded(features_), feature_stride(), layers_[2].shape.own_stride,
      layers_[2].shape.out_stride);
  session_.rehearse("network.cl", definitions, text, check);
  program_ = session_.compile("network.cl", definitions, text);
  for_all([&](DeviceLayer& layer) {
    if (layer.shape.samples.empty()) layer.kernel = kernel(layer.shape.name());
  });
}

}  // namespace rpf
