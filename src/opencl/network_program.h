// A network on a device: one program with all its layers, and their weights.
#pragma once

#include <string>
#include <vector>

#include "learned/estimate_plan.h"
#include "opencl/layer_blocking.h"
#include "opencl/session.h"

namespace rpf {

/// A layer, or some of its outputs.
struct DeviceLayer {
  LayerShape shape;
  cl::Kernel kernel;  ///< none of samples and of passes: functions that kernels/*.cl call
  cl::Buffer weights, bias;
};

/// What is best for a device: the registers that its vectors stand for.
Blocking blocking_of(const cl::Device& device);

class NetworkProgram {
 public:
  /// `check`: as require_compiled() calls it (probe.h).
  NetworkProgram(Session& session, const EstimatePlan& plan, const Blocking& blocking, const Check& check);

  /// An entry point of kernels/network.cl.
  cl::Kernel kernel(const std::string& name) const { return {program_, name.c_str()}; }
  /// A layer by its number in the network: all but the head and weight2. sample1 has live inputs only.
  const DeviceLayer& layer(std::size_t number) const { return layers_[number]; }
  /// Of the head: context and blend; what a pass needs, for the kernel `embed`.
  const DeviceLayer& first_head() const { return heads_[0]; }
  const DeviceLayer& head(int pass) const { return heads_[static_cast<std::size_t>(pass) + 1]; }
  /// Weights of weight2, then its bias.
  const cl::Buffer& last_weights() const { return last_weights_; }
  /// Floats from one sample's features to the next one's: there is room for the context behind them.
  int feature_stride() const { return padded(features_ + RPF_CONTEXT); }

 private:
  void place_layers(const Network& network, const std::vector<int>& live);
  void place(DeviceLayer& to, const NetworkLayer& layer, const std::vector<int>& inputs, int first, int count);
  void compile(const Blocking& blocking, const Check& check);

  Session& session_;
  int features_;
  cl::Program program_;
  std::vector<DeviceLayer> layers_, heads_;
  cl::Buffer last_weights_;
};

}  // namespace rpf
