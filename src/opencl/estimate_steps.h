// The learned estimator as steps over grids of rows: plain data, in the order of docs/network.md.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "learned/estimate_plan.h"
#include "opencl/row_pipeline.h"

namespace rpf {

/// Values of every cell of a level.
struct EstimateGrid {
  std::string name;
  int width = 0, height = 0;
  int values = 0;       ///< that mean something
  int stored = 0;       ///< floats a cell, or planes
  bool planes = false;  ///< [row][plane][cell], RPF_MARGIN around; else [row][cell][value], RPF_BORDER around

  int pitch() const;  ///< floats a row
};

struct EstimateStep {
  enum class Kind { see, layer, halve, head, sum, embed, weigh, pass, finish };
  Kind kind = Kind::layer;
  int number = 0;            ///< of the layer in the network, or of the pass
  int level = 0;             ///< of what it makes
  std::vector<int> in, out;  ///< grids; what the head says of a pass stands, where it is kept, behind its embedding
  double row_work = 0;       ///< multiply-adds a row, about
};

/// All steps over a window, with the rows that are kept.
struct EstimateSteps {
  std::vector<EstimateGrid> grids;
  std::vector<EstimateStep> steps;
  RowPipeline pipeline;
  /// Grids: of the first layer; of what the head says before the passes; of the albedo before its passes.
  int enter = 0, guides = 0, heads = 0, albedo = 0, result = 0;
  int pixel = -1;  ///< of what the first layer reads; -1: nobody wants it
  int kept = -1;   ///< of samples; -1: what is computed of them is not kept

  /// Plans the rows first .. end - 1 of a window with so many samples. `row_samples`: in the row that has most, where
  /// what is computed of samples may be kept until they are summed up; else 0.
  EstimateSteps(const EstimatePlan& plan, const Window& window, double samples, int first, int end, bool keep_all,
                int row_samples = 0);

  /// Bytes at most of what is kept of so many samples.
  static double most_kept(const EstimatePlan& plan, double samples);

  double work() const;          ///< multiply-adds in all, about
  std::uint64_t bytes() const;  ///< of all grids
};

}  // namespace rpf
