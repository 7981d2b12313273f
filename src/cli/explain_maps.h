// The layers of an explanation as pictures with legends.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "report/html_page.h"
#include "rpf/explain.h"

namespace rpf::cli {

/// One picture: what it is called, how to read it, and what its colors mean.
struct ExplainMap {
  std::string name;     ///< of its file, without extension
  std::string chapter;  ///< of the page that shows it
  std::string reading;  ///< one sentence
  Image picture;        ///< R, G, B in linear light
  report::Legend legend;
};

/// Hands out all of them, chapter by chapter; one at a time, for all together take more memory than the layers.
void for_each_map(const Explanation& explanation, const std::function<void(const ExplainMap&)>& use);

/// Names of the maps that layers with these channels have.
std::vector<std::string> map_names(const std::vector<std::string>& channels);

/// Which random parameters make the noise: the groups' colors, mixed by their shares.
ExplainMap attribution_map(const Explanation& explanation);

/// One channel in the colors of magma from `least` to `most`; logarithmic where `least` is above 0.
struct Scale {
  double least = 0, most = 1;
};
ExplainMap scalar_map(const Image& values, std::size_t channel, const Scale& scale);

/// Column of a channel; there is one.
std::size_t channel_of(const Image& layers, const std::string& name);

/// So many channels from `first` on, as an image with these names; windows and metadata stay.
Image part_of(const Image& layers, const std::string& first, const std::vector<std::string>& names);

/// Values of a channel in ascending order.
std::vector<float> sorted_values(const Image& layers, std::size_t channel);

}  // namespace rpf::cli
