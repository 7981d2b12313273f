#include "opencl/layer_blocking.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "network_launch.h"

namespace rpf {
namespace {

/// Text, line by line.
class Lines {
 protected:
  template <typename... Values>
  void line(const std::string& format, const Values&... values) {
    text_ += fmt::format(fmt::runtime(format), values...) + "\n";
  }

  std::string text_;
};

/// Writes one kernel.
class LayerText : Lines {
 public:
  LayerText(const LayerShape& shape, const Blocking& blocking) : shape_(shape) {
    std::vector<Vector> all;
    for (int first = 0, outputs = padded(shape.outputs); first < outputs; first += all.back().lanes)
      all.push_back({first, outputs - first < blocking.lanes ? 8 : blocking.lanes});
    const int vectors = static_cast<int>(all.size());
    // A vector of weights each, and one with an input in all lanes.
    const auto fit = [&](int cells) { return std::max((blocking.registers - 1) / (cells + 1), 1); };
    const int most = vectors <= fit(RPF_CELLS) ? fit(RPF_CELLS) : fit(RPF_CELLS / 2);
    const int groups = (vectors + most - 1) / most, largest = (vectors + groups - 1) / groups;
    cells_ = largest <= fit(RPF_CELLS) ? RPF_CELLS : RPF_CELLS / 2;
    for (int first = 0; first < vectors; first += largest)
      groups_.emplace_back(all.begin() + first, all.begin() + std::min(first + largest, vectors));
  }

  std::string text() {
    open();
    for (const Group& group : groups_) {
      line("    for (int x = begin; x < end; x += {}) {{", cells_);
      sums(group);
      line("    }}");
    }
    close();
    return text_;
  }

 private:
  /// Some outputs; 8 where what is left does not fill a register.
  struct Vector {
    int first, lanes;
  };
  using Group = std::vector<Vector>;  ///< whose sums are made together

  bool is_of_samples() const { return !shape_.samples.empty(); }
  /// Values of samples are the work-item's own.
  const char* space() const { return is_of_samples() ? "" : "__global "; }
  int border() const { return is_of_samples() ? 0 : RPF_BORDER; }

  void open() {
    if (is_of_samples()) return open_function();
    line("__kernel void {}(__global const float* coarse, __global const float* own, __global const float* weights,",
         shape_.name());
    line("    __global const float* bias, __global float* out, const rpf_layer l) {{");
    line("  for (int i = first_part(&l.area), last = end_part(&l.area); i < last; ++i) {{");
    line(
        "    const int y = row_of_part(&l.area, i), begin = begin_of_part(&l.area, i), end = end_of_part(&l.area, i);");
    line("    __global float* line = out + row_at(&l.out, y) + {};", border() * shape_.out_stride);
  }

  void open_function() {
    line("static void {}(const float* {}, ", shape_.name(), shape_.records ? "coarse" : "own");
    if (shape_.records)
      line("    __global const float* records, __global const int* columns, int inputs, int variables,");
    line("    __global const float* weights, __global const float* bias, float* line, int end) {{");
    line("    const int begin = 0;");
  }

  void close() {
    if (!is_of_samples()) {
      line("    close_row(line, {}, begin, end, l.area.width);", shape_.out_stride);
      line("  }}");
    }
    line("}}");
  }

  template <typename Body>
  void for_all(const Group& group, Body body) {
    for (int c = 0; c < cells_; ++c)
      for (const Vector& vector : group) body(c, vector);
  }

  /// All outputs of a group for the cells from x on.
  void sums(const Group& group) {
    for_all(group, [&](int c, const Vector& v) {
      line("      float{} a{}_{} = vload{}(0, bias + {});", v.lanes, c, v.first, v.lanes, v.first);
    });
    line("      __global const float* w = weights;");
    if (shape_.records) {
      add_record_inputs(group);
    } else if (shape_.taps == 1) {
      line("      {}const float* s = own + {}(x + {}) * {};", space(), is_of_samples() ? "" : "row_at(&l.own, y) + ",
           border(), shape_.own_stride);
      add_inputs(group, "s", std::to_string(shape_.own), shape_.own_stride, [](int c) { return c; });
    } else {
      line("      for (int ky = -1; ky <= 1; ++ky) {{");
      line("      const int row = clamp(y + ky, 0, l.area.height - 1);");
      line("      __global const float* s = own + row_at(&l.own, row) + x * {};", shape_.own_stride);
      add_row(group);
      line("      }}");
    }
    for_all(group, [&](int c, const Vector& v) {
      line(shape_.leaky ? "      vstore{}(rpf_leaky(a{}_{}), 0, line + x * {} + {});"
                        : "      vstore{}(a{}_{}, 0, line + x * {} + {});",
           v.lanes, c, v.first, shape_.out_stride, c * shape_.out_stride + v.first);
    });
  }

  /// The three columns of a row of a convolution. Cell c of column kx is c + kx cells from s on: the border is one.
  void add_row(const Group& group) {
    if (shape_.coarse > 0)
      line("      __global const float* t = coarse + row_at(&l.coarse, row >> 1) + (x >> 1) * {};",
           shape_.coarse_stride);
    else if (shape_.own_stride == shape_.own) {  // the inputs of the three columns lie one after another
      add_inputs(group, "s", std::to_string(3 * shape_.own), shape_.own_stride, [](int c) { return c; });
      return;
    }
    for (int kx = 0; kx < 3; ++kx) {
      if (shape_.coarse > 0)
        add_inputs(group, "t", std::to_string(shape_.coarse), shape_.coarse_stride,
                   [=](int c) { return (c + kx + 1) / 2; });
      add_inputs(group, "s", std::to_string(shape_.own), shape_.own_stride, [=](int c) { return c + kx; });
    }
  }

  /// Of samples: what is computed of them, then columns of their records.
  void add_record_inputs(const Group& group) {
    line("      const float* t = coarse + x * {};", shape_.coarse_stride);
    add_inputs(group, "t", std::to_string(shape_.coarse), shape_.coarse_stride, [](int c) { return c; });
    for (int c = 0; c < cells_; ++c)
      line("      __global const float* r{} = records + (size_t)min(x + {}, end - 1) * (size_t)variables;", c, c);
    add_inputs_at(group, "inputs", [](int c) { return fmt::format("r{}[columns[j]]", c); });
  }

  /// A loop over inputs; `place(c)`: where those of cell c begin, in cells from `source` on.
  template <typename Place>
  void add_inputs(const Group& group, const char* source, const std::string& inputs, int stride, Place place) {
    add_inputs_at(group, inputs, [&](int c) { return fmt::format("{}[{} + j]", source, place(c) * stride); });
  }

  /// `input(c)`: the text of input j of cell c.
  template <typename Input>
  void add_inputs_at(const Group& group, const std::string& inputs, Input input) {
    line("      for (int j = 0; j < {}; ++j, w += {}) {{", inputs, padded(shape_.outputs));
    for (const Vector& v : group)
      line("        const float{} w{} = vload{}(0, w + {});", v.lanes, v.first, v.lanes, v.first);
    for (int c = 0; c < cells_; ++c) {
      line("        const float b{} = {};", c, input(c));
      for (const Vector& v : group)
        line("        a{}_{} = fma((float{})b{}, w{}, a{}_{});", c, v.first, v.lanes, c, v.first, c, v.first);
    }
    line("      }}");
  }

  const LayerShape& shape_;
  int cells_ = RPF_CELLS;
  std::vector<Group> groups_;
};

/// The outputs of the head for a pass, of RPF_LANES cells: lanes are cells here, which passes read side by side.
class HeadText : Lines {
 public:
  HeadText(int inputs, int outputs, const Blocking& blocking)
      : inputs_(inputs), outputs_(outputs), lanes_(blocking.lanes), most_(blocking.registers - 2) {}

  std::string text() {
    line("static void head_of_pass(const float* in, __global const float* weights, __global const float* bias,");
    line("                         float* out) {{");
    line("  for (int c = 0; c < {}; c += {}) {{", RPF_LANES, lanes_);
    const int groups = (outputs_ + most_ - 1) / most_, largest = (outputs_ + groups - 1) / groups;
    for (int first = 0; first < outputs_; first += largest) sums(first, std::min(first + largest, outputs_));
    line("  }}");
    line("}}");
    return text_;
  }

 private:
  void sums(int first, int end) {
    for (int o = first; o < end; ++o) line("    float{} a{} = bias[{}];", lanes_, o, o);
    line("    for (int j = 0; j < {}; ++j) {{", inputs_);
    line("      const float{} value = vload{}(0, in + {} * j + c);", lanes_, lanes_, RPF_LANES);
    line("      __global const float* w = weights + {} * j;", padded(outputs_));
    for (int o = first; o < end; ++o) line("      a{} = fma(value, (float{})w[{}], a{});", o, lanes_, o, o);
    line("    }}");
    for (int o = first; o < end; ++o) line("    vstore{}(a{}, 0, out + {} * {} + c);", lanes_, o, RPF_LANES, o);
  }

  int inputs_, outputs_, lanes_, most_;
};

}  // namespace

std::string LayerShape::name() const {
  if (!samples.empty()) return samples;
  const std::string inputs = taps == 1    ? fmt::format("dense_{}", own)
                             : coarse > 0 ? fmt::format("up_{}_{}", coarse, own)
                                          : fmt::format("convolution_{}", own);
  return fmt::format("{}_{}{}_{}_{}", inputs, outputs, leaky ? "_leaky" : "", own_stride, out_stride);
}

std::string layer_text(const LayerShape& shape, const Blocking& blocking) { return LayerText(shape, blocking).text(); }

std::string head_text(int inputs, int outputs, const Blocking& blocking) {
  return HeadText(inputs, outputs, blocking).text();
}

}  // namespace rpf
