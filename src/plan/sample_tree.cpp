#include "plan/sample_tree.h"

#include <algorithm>
#include <cmath>

namespace rpf {
namespace {

constexpr std::uint64_t most_in_leaf = 4;
/// Leaves that a search of neighbors looks into: more than it ever needs where samples lie as renderers put them.
constexpr int most_leaves = 256;

class TreeBuilder {
 public:
  TreeBuilder(const std::vector<float>& places, SampleTree& tree) : places_(places), tree_(tree) {}

  /// Cuts the samples begin .. end - 1 of a node in halves, and those again.
  void divide(std::uint32_t node, std::uint32_t begin, std::uint32_t end) {
    if (node >= tree_.leaves) {
      tree_.first[node - tree_.leaves] = begin;
      return;
    }
    const std::uint32_t axis = widest_axis(begin, end), middle = begin + (end - begin) / 2;
    const auto samples = tree_.samples.begin();
    std::nth_element(samples + begin, samples + middle, samples + end, [&](std::uint32_t a, std::uint32_t b) {
      return at(a, axis) < at(b, axis) || (at(a, axis) == at(b, axis) && a < b);
    });
    tree_.axis[node] = axis;
    tree_.split[node] = at(tree_.samples[middle], axis);
    divide(2 * node, begin, middle);
    divide(2 * node + 1, middle, end);
  }

 private:
  float at(std::uint32_t sample, std::size_t axis) const {
    return places_[std::size_t{sample} * RPF_DIMENSIONS + axis];
  }

  std::uint32_t widest_axis(std::uint32_t begin, std::uint32_t end) const {
    std::uint32_t widest = 0;
    double most = -1;
    for (std::uint32_t axis = 0; axis < RPF_DIMENSIONS; ++axis) {
      float low = at(tree_.samples[begin], axis), high = low;
      for (std::uint32_t i = begin; i < end; ++i) {
        low = std::min(low, at(tree_.samples[i], axis));
        high = std::max(high, at(tree_.samples[i], axis));
      }
      const double width = double{high} - double{low};
      if (width > most) widest = axis;
      most = std::max(most, width);
    }
    return widest;
  }

  const std::vector<float>& places_;
  SampleTree& tree_;
};

bool is_finite(const float* place) {
  return std::all_of(place, place + RPF_DIMENSIONS, [](float x) { return std::isfinite(x); });
}

struct Neighbor {
  double distance;  ///< squared
  std::uint32_t place, sample;

  bool operator<(const Neighbor& other) const {
    return distance < other.distance || (distance == other.distance && sample < other.sample);
  }
};

struct Branch {
  std::uint32_t node;
  double distance;  ///< squared, at least
};

/// The nearest so far, the farthest of them in front.
class Neighbors {
 public:
  Neighbors(const SampleTree& tree, const ColumnPlace& place, std::size_t count)
      : tree_(tree), place_(place), count_(count) {
    found_.reserve(count);
  }

  void look_into(std::uint32_t leaf) {
    for (std::uint32_t i = tree_.first[leaf]; i < tree_.first[leaf + 1]; ++i) {
      double distance = 0;
      for (std::size_t k = 0; k < RPF_DIMENSIONS; ++k) {
        const double off = tree_.place(i)[k] - place_[k];
        distance += off * off;
      }
      add({distance, i, tree_.samples[i]});
    }
  }
  bool may_hold_nearer(const Branch& branch) const {
    return found_.size() < count_ || !(branch.distance > found_.front().distance);
  }
  const std::vector<Neighbor>& found() const { return found_; }

 private:
  void add(const Neighbor& neighbor) {
    if (found_.size() == count_) {
      if (!(neighbor < found_.front())) return;
      std::pop_heap(found_.begin(), found_.end());
      found_.pop_back();
    }
    found_.push_back(neighbor);
    std::push_heap(found_.begin(), found_.end());
  }

  const SampleTree& tree_;
  const ColumnPlace& place_;
  std::size_t count_;
  std::vector<Neighbor> found_;
};

/// Goes down to a leaf on the place's side; the other sides wait.
std::uint32_t go_down(const SampleTree& tree, const ColumnPlace& place, Branch from, std::vector<Branch>& waiting) {
  while (from.node < tree.leaves) {
    const double off = place[tree.axis[from.node]] - tree.split[from.node];
    const std::uint32_t side = off >= 0 ? 1 : 0;
    waiting.push_back({2 * from.node + 1 - side, std::max(from.distance, off * off)});
    from.node = 2 * from.node + side;
  }
  return from.node - tree.leaves;
}

}  // namespace

std::uint32_t leaves_for(std::uint64_t samples) {
  if (samples == 0) return 0;
  std::uint32_t leaves = 1;
  while (samples > most_in_leaf * leaves) leaves *= 2;
  return leaves;
}

SampleTree make_sample_tree(const std::vector<float>& places) {
  SampleTree tree;
  for (std::size_t i = 0; i < places.size() / RPF_DIMENSIONS; ++i)
    if (is_finite(&places[i * RPF_DIMENSIONS])) tree.samples.push_back(static_cast<std::uint32_t>(i));
  tree.leaves = leaves_for(tree.samples.size());
  if (tree.leaves == 0) return tree;
  tree.axis.resize(tree.leaves);
  tree.split.resize(tree.leaves);
  tree.first.resize(std::size_t{tree.leaves} + 1);
  tree.first.back() = static_cast<std::uint32_t>(tree.samples.size());
  TreeBuilder(places, tree).divide(1, 0, tree.first.back());
  tree.places.reserve(tree.samples.size() * RPF_DIMENSIONS);
  for (const std::uint32_t sample : tree.samples) {
    const auto from = places.begin() + static_cast<std::ptrdiff_t>(std::size_t{sample} * RPF_DIMENSIONS);
    tree.places.insert(tree.places.end(), from, from + RPF_DIMENSIONS);
  }
  return tree;
}

std::vector<std::uint32_t> nearest_samples(const SampleTree& tree, const ColumnPlace& place, std::size_t count) {
  Neighbors neighbors(tree, place, count);
  std::vector<Branch> waiting = {{1, 0}};
  for (int looked = 0; looked < most_leaves && !waiting.empty();) {
    const Branch next = waiting.back();
    waiting.pop_back();
    if (!neighbors.may_hold_nearer(next)) continue;
    neighbors.look_into(go_down(tree, place, next, waiting));
    ++looked;
  }
  std::vector<std::uint32_t> places;
  for (const Neighbor& neighbor : neighbors.found()) places.push_back(neighbor.place);
  return places;
}

}  // namespace rpf
