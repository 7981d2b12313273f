// Which channel of a file fills which slot of a sample's record (docs/file-format.md).
#pragma once

#include <map>
#include <string>
#include <vector>

#include "rpf/samples.h"

namespace rpf::io {

/// One row of the alias table. '*' stands for one letter: where it is the i-th of `channel_letters` in the channel's
/// name, it is the i-th of `slot_letters` in the slot's. A pattern without '*' is one name.
struct ChannelAlias {
  const char* channel;
  const char* channel_letters;
  const char* slot;
  const char* slot_letters;
  bool after_layer;  ///< the name may follow a layer's name and a dot: "ViewLayer.Position.X"
};

/// The names that other programs give to our slots; the table is in channel_aliases.cpp.
const std::vector<ChannelAlias>& channel_aliases();

/// True for canonical names: R G B A film.X film.Y weight feature.hit random.<group>[.<comp>] feature.<group>[.<comp>].
bool is_slot(const std::string& name);

/// The slot that `channel` is an alias for, or an empty string.
std::string slot_of_alias(const std::string& channel);

/// For each channel the slot it fills, empty where it is not used. `slot_map` beats canonical names, they beat aliases.
/// Throws Error(usage) for a slot_map that cannot be, Error(input) for two aliases of one slot or a missing channel.
std::vector<std::string> assign_slots(const std::string& path, const std::vector<std::string>& channels,
                                      const std::map<std::string, std::string>& slot_map);

/// The order of a record: R G B [A] film.X film.Y [weight] random.* feature.* [feature.hit], the groups sorted by name.
SampleLayout record_layout(const std::vector<std::string>& slots);

}  // namespace rpf::io
