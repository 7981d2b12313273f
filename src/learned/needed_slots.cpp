#include <algorithm>

#include "frame/selection.h"
#include "learned/network_file.h"
#include "learned/record_view.h"
#include "rpf/filter.h"
#include "rpf/methods.h"

namespace rpf {

std::vector<std::string> needed_slots(const SampleLayout& layout, const Settings& settings) {
  std::vector<std::string> slots = selected_slots(layout, settings);
  if (settings.method != Method::learned) return slots;
  const auto network = find_network(settings.model, settings.max_memory);
  const auto is_idle = [&](const std::string& slot) {
    const bool is_input = is_random_slot(slot) || (is_feature_slot(slot) && !settings.filter_features);
    return is_input && !looks_at(*network, slot);
  };
  slots.erase(std::remove_if(slots.begin(), slots.end(), is_idle), slots.end());
  return slots;
}

}  // namespace rpf
