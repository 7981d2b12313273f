#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "frame/frame.h"
#include "frame/selection.h"
#include "frame/variables.h"
#include "rpf/error.h"
#include "rpf/filter.h"

namespace rpf {
namespace {

constexpr const char* all_groups = "all";
constexpr const char* first_hit_groups = "first";
constexpr const char* inside_pixel = "pixel";

using Groups = std::vector<std::string>;

bool contains(const Groups& groups, const std::string& name) {
  return std::find(groups.begin(), groups.end(), name) != groups.end();
}

Groups groups_of(const std::vector<std::string>& slots) {
  Groups groups;
  for (const std::string& slot : slots)
    if (!contains(groups, group_of(slot))) groups.push_back(group_of(slot));
  return groups;
}

template <typename Predicate>
std::vector<std::string> slots_where(const SampleLayout& layout, Predicate predicate) {
  std::vector<std::string> slots;
  std::copy_if(layout.slots.begin(), layout.slots.end(), std::back_inserter(slots), predicate);
  return slots;
}

/// Puts the groups of the first hit in the place of the word for them.
Groups without_first_hit_word(Groups wanted, const std::vector<std::string>& slots) {
  const auto word = std::find(wanted.begin(), wanted.end(), first_hit_groups);
  if (word == wanted.end()) return wanted;
  wanted.erase(word);
  for (const std::string& group : groups_of(slots))
    if (!is_second_hit(group)) wanted.push_back(group);
  return wanted;
}

/// The slots of the wanted groups, in the layout's order. `kind` is for the error text.
std::vector<std::string> pick(const std::vector<std::string>& slots, const Groups& wanted, const char* kind) {
  const Groups available = groups_of(slots);
  for (const std::string& name : wanted)
    if (name != all_groups && name != inside_pixel && !contains(available, name))
      throw Error(ErrorKind::usage,
                  fmt::format("{0} '{1}' is not among the samples' channels; {0}s there: {2}", kind, name,
                              available.empty() ? "none" : fmt::format("{}", fmt::join(available, ", "))));
  std::vector<std::string> picked;
  for (const std::string& slot : slots)
    if (contains(wanted, all_groups) || contains(wanted, group_of(slot))) picked.push_back(slot);
  return picked;
}

/// Section 1: lens, time and light where there are any; the thesis adds the position inside the pixel.
Groups default_random(const Groups& available, Profile profile) {
  Groups wanted;
  for (const char* name : {"lens", "time", "light"})
    if (contains(available, name)) wanted.push_back(name);
  if (profile == Profile::thesis) wanted.push_back(inside_pixel);
  return wanted;
}

std::vector<std::string> select_random(const std::vector<std::string>& slots, const Settings& settings) {
  const Groups wanted = settings.random.value_or(default_random(groups_of(slots), settings.profile));
  std::vector<std::string> selected = pick(slots, wanted, "random parameter");
  if (contains(wanted, inside_pixel)) selected.insert(selected.end(), {"pixel.X", "pixel.Y"});
  return selected;
}

/// Groups that the learned estimator has inputs for (docs/network.md).
const Groups learned_random = {"lens", "time", "light", "bsdf"}, learned_features = {"N", "albedo", "P", "N2", "P2"};

/// Groups that the axis-aligned filter of shadows looks at; without the first two it cannot be.
const Groups shadow_features = {"P", "penumbra", "N", "albedo"};

/// A kind of channel, and the groups of it that a method knows.
struct Known {
  const char* method;
  const char* kind;
  const Groups& groups;
};

/// The groups that were asked for, or all that are there and known.
std::vector<std::string> select_known(const std::vector<std::string>& slots,
                                      const std::optional<std::vector<std::string>>& asked, const Known& what) {
  const Groups& known = what.groups;
  Groups wanted = without_first_hit_word(asked.value_or(Groups{all_groups}), slots);
  for (const std::string& name : wanted)
    if (name != all_groups && name != inside_pixel && contains(groups_of(slots), name) && !contains(known, name))
      throw Error(ErrorKind::usage, fmt::format("{} '{}' is none that {} looks at; those are: {}", what.kind, name,
                                                what.method, fmt::join(known, ", ")));
  std::vector<std::string> picked = pick(slots, wanted, what.kind);
  picked.erase(std::remove_if(picked.begin(), picked.end(),
                              [&](const std::string& slot) { return !contains(known, group_of(slot)); }),
               picked.end());
  return picked;
}

/// Throws where one is not there; `option`: with which rpf scene writes them.
void require_slots(const std::vector<std::string>& slots, const std::vector<std::string>& needed, const char* method,
                   const char* option) {
  for (const std::string& slot : needed)
    if (!contains(slots, slot))
      throw Error(ErrorKind::input,
                  fmt::format("--method {}: the samples have no {}, which docs/file-format.md describes; have "
                              "the renderer write it (rpf scene does with {}), or choose another --method",
                              method, slot, option));
}

/// The light field needs to know where surfaces are and, where time is a random parameter, how they move.
Selection select_trajectories(const std::vector<std::string>& random, const std::vector<std::string>& features) {
  Groups groups = {"P"};
  const bool has_time = contains(random, "random.time");
  if (has_time) groups.insert(groups.end(), {"opening", "closing"});
  std::vector<std::string> needed;
  for (const std::string& group : groups)
    for (const char* axis : {"X", "Y", "Z"}) needed.push_back(fmt::format("feature.{}.{}", group, axis));
  require_slots(features, needed, "lightfield", "--lightfield");
  return {has_time ? Groups{"random.time"} : Groups{}, needed};
}

/// The dimensions that there are beside the film's two.
std::vector<std::string> select_lens_and_time(const std::vector<std::string>& random) {
  std::vector<std::string> picked;
  for (const char* slot : {"random.lens.U", "random.lens.V", "random.time"})
    if (contains(random, slot)) picked.emplace_back(slot);
  return picked;
}

/// Shadows need to know where surfaces are and what stands before the light.
std::vector<std::string> select_shadow_features(const std::vector<std::string>& slots, const Settings& settings) {
  require_slots(slots,
                {"feature.P.X", "feature.P.Y", "feature.P.Z", "feature.penumbra.slope", "feature.penumbra.width"},
                "axis-aligned", "--penumbra");
  std::vector<std::string> picked =
      select_known(slots, settings.features, {"the axis-aligned filter", "feature", shadow_features});
  for (const char* group : {"P", "penumbra"})
    if (!contains(groups_of(picked), group))
      throw Error(ErrorKind::usage,
                  fmt::format("--method axis-aligned needs the features P and penumbra; add {} to --features", group));
  return picked;
}

}  // namespace

Selection select_channels(const SampleLayout& layout, const Settings& settings) {
  if (settings.method == Method::gaussian || settings.method == Method::bilateral || settings.method == Method::nlm ||
      settings.method == Method::gem)
    return {};
  const auto random = slots_where(layout, is_random_slot);
  const auto features = slots_where(layout, is_feature_slot);
  Selection selection;
  if (settings.method == Method::learned)
    return {select_known(random, settings.random, {"the learned estimator", "random parameter", learned_random}),
            select_known(features, settings.features, {"the learned estimator", "feature", learned_features})};
  if (settings.method == Method::axis_aligned) return {{}, select_shadow_features(features, settings)};
  if (settings.method == Method::lightfield) return select_trajectories(random, features);
  if (settings.method == Method::multidim) return {select_lens_and_time(random), {}};
  if (settings.method == Method::rpf) selection.random = select_random(random, settings);
  if (contains(settings.features.value_or(Groups{}), inside_pixel))
    throw Error(ErrorKind::usage,
                "feature 'pixel' is not a feature; --random pixel models the position inside the pixel");
  const Groups wanted_features = settings.features.value_or(Groups{all_groups});
  selection.features = pick(features, without_first_hit_word(wanted_features, features), "feature");
  // Second hits take no part in the rejection test: behind the others they need not be read for it.
  std::stable_partition(selection.features.begin(), selection.features.end(),
                        [](const std::string& slot) { return !is_second_hit(group_of(slot)); });
  return selection;
}

std::vector<std::string> selected_slots(const SampleLayout& layout, const Settings& settings) {
  const Selection selection = select_channels(layout, settings);
  const auto is_position = [](const std::string& slot) { return is_world_position(group_of(slot)); };
  const bool measures =
      settings.method == Method::rpf && std::any_of(selection.features.begin(), selection.features.end(), is_position);
  const auto is_needed = [&](const std::string& slot) {
    if (is_random_slot(slot)) return contains(selection.random, slot);
    // The tolerance of positions depends on the scene's size: first-hit positions, where the normals say it is a hit.
    if (measures && (group_of(slot) == "P" || group_of(slot) == "N")) return true;
    return !is_feature_slot(slot) || settings.filter_features || contains(selection.features, slot);
  };
  return slots_where(layout, is_needed);
}

}  // namespace rpf
