// Networks of the learned estimator.
#pragma once

#include <string>

namespace rpf {

/// The hash of the network that Settings::model means, as Report::model_hash has it: 16 hexadecimal digits. Throws
/// Error(usage) where neither the library nor a file has that name, Error(input) where the file is no network.
std::string model_hash(const std::string& model);

}  // namespace rpf
