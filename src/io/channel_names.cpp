#include "io/channel_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <set>

#include "io/guard.h"
#include "io/near_names.h"
#include "rpf/error.h"

namespace rpf::io {
namespace {

using SlotMap = std::map<std::string, std::string>;

const std::vector<std::string> single_slots = {"R", "G", "B", "A", "film.X", "film.Y", "weight", "feature.hit"};

// <group> or <group>.<component>, neither of them empty.
bool is_group(const std::string& text) {
  const auto dot = text.find('.');
  if (dot == std::string::npos) return !text.empty();
  return dot > 0 && dot + 1 < text.size() && text.find('.', dot + 1) == std::string::npos;
}

std::string with_letter(const std::string& pattern, char letter) {
  std::string name = pattern;
  std::replace(name.begin(), name.end(), '*', letter);
  return name;
}

bool is_name(const std::string& channel, const std::string& name, bool after_layer) {
  if (channel == name) return true;
  const std::string tail = "." + name;
  return after_layer && channel.size() > tail.size() &&
         channel.compare(channel.size() - tail.size(), tail.size(), tail) == 0;
}

// The slot that this row gives to the channel, or an empty string.
std::string match(const ChannelAlias& alias, const std::string& channel) {
  if (std::strchr(alias.channel, '*') == nullptr)
    return is_name(channel, alias.channel, alias.after_layer) ? alias.slot : "";
  for (std::size_t i = 0; alias.channel_letters[i] != '\0'; ++i)
    if (is_name(channel, with_letter(alias.channel, alias.channel_letters[i]), alias.after_layer))
      return with_letter(alias.slot, alias.slot_letters[i]);
  return "";
}

// What a misspelled slot could have meant: all slots of the alias table and those of the file.
std::vector<std::string> known_slots(const std::vector<std::string>& channels) {
  std::set<std::string> names(single_slots.begin(), single_slots.end());
  for (const ChannelAlias& alias : channel_aliases())
    for (const char* letter = alias.slot_letters; *letter != '\0'; ++letter)
      names.insert(with_letter(alias.slot, *letter));
  for (const std::string& channel : channels)
    if (is_slot(channel)) names.insert(channel);
  return {names.begin(), names.end()};
}

void check_map_slot(const std::string& slot, const std::string& channel, const std::vector<std::string>& channels) {
  if (is_slot(slot)) return;
  throw Error(ErrorKind::usage,
              fmt::format("--map {0}={1}: \"{0}\" is not a slot; use R, G, B, A, film.X, film.Y, weight, "
                          "random.<group>[.<component>] or feature.<group>[.<component>] (near: {2})",
                          slot, channel, near_names(slot, known_slots(channels))));
}

// Fills `slots` with the user's choices.
void assign_mapped(const std::string& path, const std::vector<std::string>& channels, const SlotMap& slot_map,
                   std::vector<std::string>& slots) {
  for (const auto& [slot, channel] : slot_map) {
    check_map_slot(slot, channel, channels);
    if (channel.empty()) continue;
    const auto found = std::find(channels.begin(), channels.end(), channel);
    if (found == channels.end())
      throw Error(ErrorKind::input, fmt::format("\"{0}\" has no channel \"{2}\" for --map {1}={2}; near names in the "
                                                "file are {3}",
                                                path, slot, channel, near_names(channel, channels)));
    std::string& chosen = slots[static_cast<std::size_t>(found - channels.begin())];
    if (!chosen.empty())
      throw Error(ErrorKind::usage, fmt::format("--map names channel \"{}\" for two slots, {} and {}; a channel can "
                                                "fill one slot only",
                                                channel, chosen, slot));
    chosen = slot;
  }
}

void reject_conflict(const std::string& path, const std::string& slot, const std::string& first,
                     const std::string& second) {
  throw Error(ErrorKind::input,
              fmt::format("\"{0}\" has two channels for the slot {1}, \"{2}\" and \"{3}\"; choose one with "
                          "--map \"{1}={2}\" or --map \"{1}={3}\"",
                          path, slot, first, second));
}

}  // namespace

bool is_slot(const std::string& name) {
  if (std::find(single_slots.begin(), single_slots.end(), name) != single_slots.end()) return true;
  for (const std::string prefix : {"random.", "feature."})
    if (name.compare(0, prefix.size(), prefix) == 0) return is_group(name.substr(prefix.size()));
  return false;
}

std::string slot_of_alias(const std::string& channel) {
  for (const ChannelAlias& alias : channel_aliases()) {
    std::string slot = match(alias, channel);
    if (!slot.empty()) return slot;
  }
  return "";
}

std::vector<std::string> assign_slots(const std::string& path, const std::vector<std::string>& channels,
                                      const SlotMap& slot_map) {
  // Three rounds, the strongest first; a round leaves alone what an earlier one has settled.
  std::vector<std::string> slots(channels.size());
  assign_mapped(path, channels, slot_map, slots);
  std::map<std::string, std::string> owner;  // slot -> channel, for what is assigned automatically
  for (std::size_t i = 0; i < channels.size(); ++i)
    if (slots[i].empty() && is_slot(channels[i]) && slot_map.count(channels[i]) == 0) {
      slots[i] = channels[i];
      owner[channels[i]] = channels[i];
    }
  for (std::size_t i = 0; i < channels.size(); ++i) {
    if (!slots[i].empty() || is_slot(channels[i])) continue;
    const std::string slot = slot_of_alias(channels[i]);
    if (slot.empty() || slot_map.count(slot) != 0) continue;
    const auto [place, is_new] = owner.emplace(slot, channels[i]);
    if (is_new) slots[i] = slot;
    // A slot that its own name fills is no conflict: the name wins.
    if (!is_new && place->second != slot) reject_conflict(path, slot, place->second, channels[i]);
  }
  return slots;
}

SampleLayout record_layout(const std::vector<std::string>& slots) {
  // The set sorts the groups by name, so equal files have equal records whatever the order of channels.
  const std::set<std::string> present(slots.begin(), slots.end());
  SampleLayout layout;
  for (const char* slot : {"R", "G", "B", "A", "film.X", "film.Y", "weight"})
    if (present.count(slot) != 0) layout.slots.emplace_back(slot);
  for (const std::string& slot : present)
    if (is_random_slot(slot)) layout.slots.push_back(slot);
  for (const std::string& slot : present)
    if (is_feature_slot(slot)) layout.slots.push_back(slot);
  if (present.count("feature.hit") != 0) layout.slots.emplace_back("feature.hit");
  return layout;
}

}  // namespace rpf::io
