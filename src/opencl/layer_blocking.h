// The text of a network's layers, a kernel for every shape. Sums stand in named variables, as many as the processor has
// registers: compilers leave arrays in memory, at a fifth of the speed.
#pragma once

#include <string>

namespace rpf {

/// How a device is used best.
struct Blocking {
  int lanes = 8;       ///< floats of a vector register: 8 or 16
  int registers = 16;  ///< vector registers
};

/// What a layer's text depends on. Cells of inputs and outputs lie side by side, each with `stride` values.
struct LayerShape {
  int taps = 9;       ///< 9: 3x3; 1: a cell alone
  int coarse = 0;     ///< inputs from the next coarser level, which come first; 0: none
  int own = 0;        ///< inputs of the cells themselves
  int outputs = 0;    ///<
  bool leaky = true;  ///< lrelu at the end
  /// Of a layer whose cells are samples, or pixels at hand, without a border: its name in kernels/network_samples.cl.
  std::string samples;
  /// `coarse` inputs are computed of samples, further ones are columns of their records.
  bool records = false;
  int coarse_stride = 0, own_stride = 0, out_stride = 0;

  std::string name() const;  ///< of its kernel, of samples of its function
};

/// Values of a cell as they are stored, a multiple of vectors: what is beyond `values` has no meaning.
constexpr int padded(int values) { return (values + 7) / 8 * 8; }

/// The kernel NAME(coarse, own, weights, bias, out, rpf_layer), weights [ky][kx][coarse, then own][padded(outputs)]. Of
/// samples a function: kernels/network_samples.cl says with which parameters.
std::string layer_text(const LayerShape& shape, const Blocking& blocking);

/// The function head_of_pass() of kernels/network_passes.cl: a dense layer without lrelu, weights
/// [input][padded(outputs)].
std::string head_text(int inputs, int outputs, const Blocking& blocking);

}  // namespace rpf
