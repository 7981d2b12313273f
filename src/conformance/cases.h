// The frames and settings that a device is compared on.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "learned/network.h"
#include "rpf/samples.h"
#include "rpf/scene.h"
#include "rpf/settings.h"

namespace rpf {

struct ConformanceCase {
  std::string name;  ///< group/what/profile; of a method with fixed weights method/NAME/what;
                     ///< of the learned estimator learned/what
  std::string scene;
  SceneOptions options;
  Settings settings;
  std::function<void(SampleBuffer&)> change;  ///< done to the samples before they are filtered; may be empty
  std::shared_ptr<const Network> network;     ///< of the learned estimator
  bool explain = false;                       ///< also compare Backend::explained()
  int band_rows = 0;                          ///< rows that the device may hold at once; 0: all
  bool quick = false;                         ///< among the cases of a short test
};

/// All of them.
std::vector<ConformanceCase> all_conformance_cases();

}  // namespace rpf
