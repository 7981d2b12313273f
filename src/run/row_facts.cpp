#include "run/row_facts.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "rpf/error.h"

namespace rpf {
namespace {

using nlohmann::json;

constexpr const char *learned_kind = "learned", *other_kind = "published";

void put(const CleanReport& report, json& to) {
  to["notes"] = json::array();
  for (const InputNote& note : report.notes)
    to["notes"].push_back({{"what", note.what}, {"count", note.count}, {"x", note.x}, {"y", note.y}});
  to["lacks_positions"] = report.lacks_positions;
  to["brightest"] = report.brightest;
  to["most_samples"] = report.most_samples;
  to["has_color"] = report.has_color;
  to["lost"] = json::array();
  for (const LostPixel& lost : report.lost) to["lost"].push_back({lost.pixel, lost.samples, lost.color});
}

CleanReport report_in(const json& from) {
  CleanReport report;
  for (const json& note : from.at("notes"))
    report.notes.push_back({note.at("what"), note.at("count"), note.at("x"), note.at("y")});
  report.lacks_positions = from.at("lacks_positions");
  report.brightest = from.at("brightest");
  report.most_samples = from.at("most_samples");
  report.has_color = from.at("has_color");
  for (const json& lost : from.at("lost")) report.lost.push_back({lost.at(0), lost.at(1), lost.at(2)});
  return report;
}

void put(const FrameFindings& found, json& to) {
  to["kind"] = other_kind;
  put(found.cleaned, to);
  to["constant"] = found.constant;
  to["position_diagonal"] = found.position_diagonal;
  to["feature_spread"] = json::array();
  for (const FeatureSpread& spread : found.feature_spread)
    to["feature_spread"].push_back({spread.mean, spread.deviation});
  to["uninformative"] = found.uninformative;
}

FrameFindings frame_findings_in(const json& from) {
  FrameFindings found;
  found.cleaned = report_in(from);
  found.constant = from.at("constant").get<std::vector<std::string>>();
  found.position_diagonal = from.at("position_diagonal");
  for (const json& spread : from.at("feature_spread")) found.feature_spread.push_back({spread.at(0), spread.at(1)});
  found.uninformative = from.at("uninformative").get<std::vector<std::string>>();
  return found;
}

void put(const ObservedFindings& found, json& to) {
  to["kind"] = learned_kind;
  put(found.cleaned, to);
  to["position_median"] = found.positions.median;
  to["position_deviation"] = found.positions.deviation;
  to["exposure"] = found.exposure;
  to["weight_scale"] = found.weight_scale;
  to["has_hit"] = found.has_hit;
  to["constant_inputs"] = found.constant;
}

ObservedFindings observed_findings_in(const json& from) {
  ObservedFindings found;
  found.cleaned = report_in(from);
  for (std::size_t k = 0; k < 3; ++k) found.positions.median[k] = from.at("position_median").at(k);
  found.positions.deviation = from.at("position_deviation");
  found.exposure = from.at("exposure");
  found.weight_scale = from.at("weight_scale");
  found.has_hit = from.at("has_hit");
  found.constant = from.at("constant_inputs").get<std::vector<int>>();
  return found;
}

}  // namespace

std::string text_of(const RowFacts& facts) {
  json text;
  std::visit([&](const auto& found) { put(found, text); }, facts);
  return text.dump(1);
}

RowFacts facts_of(const std::string& text, Method method) {
  const char* kind = method == Method::learned ? learned_kind : other_kind;
  try {
    const json facts = json::parse(text);
    if (facts.at("kind") != kind)
      throw Error(ErrorKind::input, fmt::format("facts are of another method, expected those of a {} one; make them "
                                                "with the settings that filter",
                                                kind));
    if (method == Method::learned) return observed_findings_in(facts);
    return frame_findings_in(facts);
  } catch (const json::exception& e) {
    throw Error(ErrorKind::input,
                fmt::format("facts are not as rpf facts writes them ({}); make them again", e.what()));
  }
}

}  // namespace rpf
