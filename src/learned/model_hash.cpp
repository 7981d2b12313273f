#include "learned/network_file.h"
#include "rpf/model.h"

namespace rpf {

std::string model_hash(const std::string& model) { return find_network(model)->hash; }

}  // namespace rpf
