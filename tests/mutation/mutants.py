"""The mutants: one small error each, and the check that must notice it.

A test is a filter of rpf_unit_tests, or "oracle CASE STAGE": compare.py must find the case different in that stage.
Together the mutants fail every stage of the comparison. Errors seen in public implementations (algorithm.md, section 10)
are among them.
"""
from dataclasses import dataclass

NUMERIC, ELEMENTWISE, MATH = "kernels/numeric.h", "kernels/elementwise.h", "kernels/rpf_math.h"
NEIGHBORHOOD, STATISTICS = "src/cpu/neighborhood.cpp", "src/cpu/statistics.cpp"
WEIGHTING, BACKEND = "src/cpu/weighting.cpp", "src/cpu/cpu_backend.cpp"
PLAN, TABLES, CLEAN = "src/plan.cpp", "src/tables.cpp", "src/clean.cpp"
PREPARE, DRIVER, RESOLVE = "src/prepare.cpp", "src/driver.cpp", "src/resolve.cpp"
MERGE, RAW_READER, HDR_FLIP = "src/merge.cpp", "src/io/raw_reader.cpp", "src/metrics/hdr_flip.cpp"
BOTH = "Profiles/BothProfiles."


@dataclass(frozen=True)
class Mutant:
    name: str
    file: str
    old: str        # occurs exactly once in the file
    new: str
    test: str
    reason: str     # stage and what is wrong, in a few words


MUTANTS = [
    # ---------------------------------------------------------------- the numeric contract
    Mutant("exp_coefficient", ELEMENTWISE, "1.6666665459e-1f", "1.6666765459e-1f",
           "Exp.StaysWithinOneUlpOfLongDouble", "exp: a coefficient is off"),
    Mutant("exp_underflow", ELEMENTWISE, "RPF_EXP_UNDERFLOW -87.0f", "RPF_EXP_UNDERFLOW -88.0f",
           "Exp.IsExactlyOneAtZeroAndZeroBelowTheUnderflow", "exp: subnormal results"),
    Mutant("lane_tree", ELEMENTWISE, "for (int l = 0; l < width; ++l) lane[l] += lane[l + width];",
           "for (int l = 0; l < width; ++l) lane[l] = lane[2 * l] + lane[2 * l + 1];",
           "Lanes.TotalIsTheFixedTree", "sums: neighbors are paired instead of halves"),
    Mutant("lane_of_element", ELEMENTWISE, "sum->lane[j % RPF_LANES]", "sum->lane[j / 2 % RPF_LANES]",
           "Lanes.ElementBelongsToItsLaneModuloSixteen", "sums: another lane"),
    Mutant("hash_constant", ELEMENTWISE, "x = x * 1664525u", "x = x * 1664521u",
           "Hash.IsThePublishedPcg3d", "random numbers: a constant is off"),
    Mutant("mul_hi", NUMERIC, ">> 32", ">> 31",
           "MulHi.IsTheUpperHalfOfTheProduct", "random numbers: another half of the product"),
    Mutant("contraction", "tests/CMakeLists.txt", '"-mfma"', '"-mfma;-O2;-ffp-contract=fast"',
           "Contraction.IsOffWhereTheKernelsAreCompiled", "a * b + c in one rounding"),

    # ---------------------------------------------------------------- 1. input
    Mutant("nan_sample_kept", CLEAN, "if (!std::isfinite(record[c])) return false;", "if (std::isinf(record[c])) return false;",
           BOTH + "LeavesOutSamplesThatAreNotFinite/*", "input: a NaN color is used"),
    Mutant("constant_channel_kept", PREPARE, "const bool constant = is_constant(samples, source);", "const bool constant = false;",
           "oracle spp1_paper variables", "input: constant channels are modeled"),
    Mutant("constant_channel_trace", PREPARE, "const bool constant = is_constant(samples, source);", "const bool constant = false;",
           BOTH + "DropsAConstantChannelWithoutATrace/*", "input: constant channels are modeled"),
    Mutant("pixel_fraction", PREPARE, "value - std::floor(value) : value", "value : value",
           "oracle spp4_thesis mean", "input: the film position as random parameter"),
    Mutant("hit_mask_ignored", PREPARE, "if (columns.hit) return record[*columns.hit] != 0;", "",
           "PositionDiagonal.LeavesOutRaysThatTheHitChannelCallsMissed", "input: feature.hit is not read"),
    Mutant("missed_rays_in_box", PREPARE, "return columns.normal.empty() || ", "return true || ",
           "oracle missed_rays_unmarked tolerance", "input: a normal of 0 counts as a hit"),
    Mutant("scale_no_power_of_two", PREPARE, "std::ldexp(1.0F, std::clamp(", "std::ldexp(1.1F, std::clamp(",
           "RadianceScale.IsThePowerOfTwoThatBringsTheBrightestTo2To40", "radiance scale: rounds"),
    Mutant("scale_of_one", PREPARE, "return brightest > 0 ?", "return brightest < 0 ?",
           BOTH + "ScalesExactlyWithPowersOfTwo/*", "radiance scale: none"),

    # ---------------------------------------------------------------- 3. neighborhood
    Mutant("sigma", TABLES, "box_width / 4.0", "box_width / 3.0",
           "*OffsetTable.IsTheTruncatedGaussianOfAQuarterBoxWidth/*", "draws: sigma is b / 3"),
    Mutant("sigma_drawn", TABLES, "box_width / 4.0", "box_width / 3.0",
           "oracle spp8_paper draws", "draws: sigma is b / 3"),
    Mutant("offsets_toward_zero", TABLES, "static_cast<std::int8_t>(d)", "static_cast<std::int8_t>(d < 0 ? d + 1 : d)",
           "*OffsetTable.IsTheTruncatedGaussianOfAQuarterBoxWidth/*", "draws: negative offsets truncated"),
    Mutant("center_drawn", NEIGHBORHOOD, "if ((dx == 0 && dy == 0) || x < 0", "if (x < 0",
           "oracle spp4_thesis neighbors", "draws: the pixel itself is a candidate"),
    Mutant("outside_to_border", NEIGHBORHOOD, "const int x = x_ + dx, y = y_ + dy;",
           "const int x = std::min(std::max(x_ + dx, 0), frame_.width - 1), "
           "y = std::min(std::max(y_ + dy, 0), frame_.height - 1);",
           "oracle spp4_thesis neighbors", "draws: clamped into the image"),
    Mutant("redraws_ignored", NEIGHBORHOOD, "attempt < plan_.attempts", "attempt < 1",
           "oracle spp4_thesis neighbors", "draws: one attempt"),
    Mutant("one_redraw_more", PLAN, "static_cast<std::uint32_t>(settings.redraws) + 1", "static_cast<std::uint32_t>(settings.redraws) + 2",
           "Plan.AllowsOneAttemptMoreThanRedraws", "draws: one attempt too many"),
    Mutant("draws_own_too", PLAN, "return std::max(size(samples), samples) - samples;", "return size(samples);",
           "NeighborhoodSize.IsHalfTheBoxInTheThesisAndGrowsInThePaper", "draws: M instead of M - s"),
    Mutant("paper_without_samples", PLAN, "std::uint64_t{box_area} * samples / 2", "std::uint64_t{box_area} / 2",
           "oracle spp4_paper draws", "draws: M of the paper without s"),
    Mutant("limit_ignored", PLAN, "std::min<std::uint64_t>(wanted, limit)", "std::min<std::uint64_t>(wanted, most_neighbors)",
           "NeighborhoodSize.FollowsFactorAndLimit", "draws: --max-samples is not obeyed"),
    Mutant("choose_modulo", MATH, "return mul_hi(word, count);", "return word % count;",
           "oracle spp_varying_thesis neighbors", "draws: another sample of the pixel"),
    Mutant("seed_ignored", MATH, "return rpf_hash(seed, pass, pixel);", "return rpf_hash(1u, pass, pixel);",
           BOTH + "DependsOnTheSeed/*", "draws: one for all seeds"),
    Mutant("pass_ignored", MATH, "return rpf_hash(seed, pass, pixel);", "return rpf_hash(seed, 0u, pixel);",
           "oracle spp4_thesis draws", "draws: the same in every pass"),
    Mutant("counters_meet", ELEMENTWISE, "draw * RPF_MAX_ATTEMPTS + attempt", "draw + attempt",
           "oracle spp4_thesis draws", "draws: redraws repeat the next draw"),
    Mutant("history_in_draws", NEIGHBORHOOD, "sampler.draw(number)",
           "sampler.draw(number + static_cast<std::uint32_t>(n.rows.capacity()))",
           BOTH + "GivesTheSameBitsForThreadsTilesAndRuns/*", "draws: depend on the pixels before in the tile"),
    Mutant("tolerance_least", ELEMENTWISE, "scaled > minimum ? scaled : minimum", "scaled < minimum ? scaled : minimum",
           "Tolerance.IsTheLargerOfScaledDeviationAndMinimum", "rejection: smaller of the two"),
    Mutant("rejection_one_sided", ELEMENTWISE, "return fabs(value - own_mean) > tolerance;", "return value - own_mean > tolerance;",
           "Rejection.IsStrictAbsoluteAndIgnoresMissingValues", "rejection: printed formula, no absolute value"),
    Mutant("own_deviation_n_1", NEIGHBORHOOD, "/ static_cast<float>(m.count));", "/ static_cast<float>(m.count - 1));",
           "oracle spp4_thesis own_std", "rejection: n - 1"),
    Mutant("own_missing_as_zero", NEIGHBORHOOD, "if (kernel::rpf_is_missing(value)) continue;\n    kernel::rpf_lanes_add(&sum, j, value);",
           "kernel::rpf_lanes_add(&sum, j, kernel::rpf_is_missing(value) ? 0.0F : value);",
           "oracle missing_values own_mean", "rejection: missing values count"),
    Mutant("position_scale_ignored", PLAN, "facts.position_diagonal / settings.position_scale", "facts.position_diagonal",
           "Plan.HasToleranceAndFactorOfEveryFeature", "rejection: a of positions"),
    Mutant("second_hit_rejects", PLAN, "settings.reject_second_hit || !is_second_hit(group(name))", "settings.reject_second_hit || !name.empty()",
           "oracle second_hit_keep tolerance", "rejection: second hits take part"),

    # ---------------------------------------------------------------- 4. normalization
    Mutant("shift_not_subtracted", NEIGHBORHOOD, "shift.assign(first_own, first_own + variables);", "shift.assign(variables, 0.0F);",
           BOTH + "SurvivesAWorldOffsetThatTheInputSurvives/*", "normalization: large world positions"),
    Mutant("shift_world_std", NEIGHBORHOOD, "shift.assign(first_own, first_own + variables);", "shift.assign(variables, 0.0F);",
           "oracle world_offset std", "normalization: large world positions"),
    Mutant("missing_as_zero", STATISTICS, "out.count[v] += missing ? 0 : 1;", "out.count[v] += 1;",
           "oracle missing_values mean", "normalization: missing values count"),
    Mutant("missing_normalized", ELEMENTWISE, "return rpf_is_missing(value) ? 0.0f : (value - mean)", "return (value - mean)",
           "Normalize.LeavesMissingValuesOutAndAtZero", "normalization: missing values stay"),
    Mutant("deviation_n_1", STATISTICS, "static_cast<float>(out.count[v]), out.largest[v]", "static_cast<float>(out.count[v] - 1), out.largest[v]",
           "Normalize.LeavesMissingValuesOutAndAtZero", "normalization: n - 1"),
    Mutant("flat_threshold", MATH, "RPF_FLAT_SPREAD 1e-6f", "RPF_FLAT_SPREAD 1e-8f",
           "Normalization.TreatsTinySpreadAsConstant", "normalization: rounding noise is stretched"),
    Mutant("mean_kept", ELEMENTWISE, "(value - mean) * inverse_deviation", "value * inverse_deviation",
           "oracle spp4_thesis normalized", "normalization: mean is not 0"),

    # ---------------------------------------------------------------- 5. mutual information and weights
    Mutant("bin_half_to_even", ELEMENTWISE, "magnitude - RPF_TO_REAL(whole) >= 0.5f",
           "magnitude - (float)whole > 0.5f || (magnitude - (float)whole == 0.5f && whole % 2 == 1)",
           "Bin.RoundsHalfAwayFromZeroAndClamps", "bins: half to even"),
    Mutant("bin_truncation", ELEMENTWISE, "? whole + 1 : whole;", "? whole : whole;",
           "oracle spp4_thesis bins", "bins: truncation"),
    Mutant("bin_clamp", ELEMENTWISE, "fabs(normalized) < limit ? fabs(normalized) : limit", "fabs(normalized)",
           "Bin.RoundsHalfAwayFromZeroAndClamps", "bins: a firefly leaves the histogram"),
    Mutant("histogram_cell", STATISTICS, "const std::size_t line = row[x] * bins;", "const std::size_t line = row[x] * (bins - 1);",
           "oracle spp4_thesis histograms", "histograms: rows overlap"),
    Mutant("entropy_off_by_one", TABLES, "(n * std::log2(n))", "(n * std::log2(n + 1))",
           "EntropyTable.HoldsNLog2NModulo32Bits", "mutual information: table of n ln (n + 1)"),
    Mutant("entropy_overflow", TABLES, ">= 2147483648.0", ">= 4294967296.0",
           "EntropyTable.LeavesRoomForTheLargestSum", "mutual information: sums overflow"),
    Mutant("information_sign", STATISTICS, "marginal_units[y] + all)", "marginal_units[y] - all)",
           "oracle spp4_thesis mutual_information", "mutual information: sign of N ln N"),
    Mutant("slack_dropped", MATH, "if (units <= slack)", "if (units <= 0)",
           "MutualInformation.OfExactlyIndependentVariablesIsZero", "mutual information: rounding of the table counts"),
    Mutant("information_negative", MATH, "return information > 0.0f ? information : 0.0f;", "return information;",
           "MutualInformation.CountsWhatCannotBeToldFromZeroAsZero", "mutual information: not clamped at 0"),
    Mutant("bias_not_subtracted", MATH, "nats_per_unit - bias)", "nats_per_unit)",
           "oracle bias_correction mutual_information", "mutual information: correction ignored"),
    Mutant("color_fraction_swapped", MATH, "return on_random / (", "return on_position / (",
           "oracle spp4_thesis W_c_r", "W: position instead of random"),
    Mutant("feature_fraction_swapped", MATH, "rpf_fraction_random(rpf_sum(information + 2, random), rpf_sum(information, 2))",
           "rpf_fraction_random(rpf_sum(information, 2), rpf_sum(information + 2, random))", "oracle spp4_thesis W_f_r", "W: position instead of random"),
    Mutant("fraction_denominator", MATH, "(on_random + on_position + on_features + RPF_EPSILON)", "(on_random + on_features + RPF_EPSILON)",
           "oracle spp4_thesis W_c_f", "W: a term less in (T 5.6)"),
    Mutant("fraction_of_red", MATH, "rpf_sum(color->color_fraction_random, 3) / 3.0f", "color->color_fraction_random[0]",
           "oracle spp4_thesis fraction_random", "W: one channel instead of the mean"),
    Mutant("alpha_factor_ignored", MATH, "1.0f - factor * growth * color_fraction_random", "1.0f - growth * color_fraction_random",
           "AlphaAndBeta.FollowEquation59", "alpha: factor"),
    Mutant("alpha_growth_ignored", MATH, "1.0f - factor * growth * color_fraction_random", "1.0f - factor * color_fraction_random",
           "oracle alpha_factor_5_2 alpha", "alpha: growth"),
    Mutant("beta_growth_ignored", MATH, "1.0f - growth * feature_fraction_random", "1.0f - feature_fraction_random",
           "oracle spp4_thesis beta", "beta: growth"),
    Mutant("growth_from_one", PLAN, "0.1 * static_cast<double>(pass)", "0.1 * static_cast<double>(pass + 1)",
           "oracle spp4_thesis alpha", "alpha, beta: passes counted from 1"),

    # ---------------------------------------------------------------- 6. filter
    Mutant("sharpness_exponent", MATH, "certain * certain * (float)samples", "certain * (float)samples",
           "Weight.FollowsEquations53And510", "weights: (1 - W) not squared"),
    Mutant("noise_factor", MATH, "(16.0f * noise)", "(8.0f * noise)",
           "oracle spp4_thesis filtered", "weights: 2 sigma^2 without the 2"),
    Mutant("distance_scale", MATH, "return sqrt(sharpness * coefficient);", "return sharpness * coefficient;",
           "Weight.FollowsEquations53And510", "weights: squared twice"),
    Mutant("padding_weighs", WEIGHTING, "for (std::uint32_t l = neighbors - begin; l < RPF_LANES; ++l) weight[l] = 0.0F;", "",
           "oracle spp4_thesis filtered", "filter: lanes behind the last neighbor count"),
    Mutant("hull_left", MATH, "if (mean < smallest) return smallest;\n  return mean > largest ? largest : mean;", "return mean;",
           BOTH + "KeepsAConstantImageExactly/*", "filter: rounding leaves the convex hull"),
    Mutant("hull_largest", MATH, "return mean > largest ? largest : mean;", "return mean;",
           "Filtered.CannotLeaveTheHull", "filter: rounding leaves the convex hull"),
    Mutant("colors_not_carried", BACKEND, "Workspace& w = workspaces.local();",
           "Workspace& w = workspaces.local();\n"
           "std::vector<float> colors_;\n"
           "for (std::size_t s = 0; s < frame_->sample_count(); ++s)\n"
           "  colors_.insert(colors_.end(), frame_->record(s), frame_->record(s) + 3);",
           "oracle spp4_thesis image", "passes: c instead of c'"),
    Mutant("filtered_in_place", BACKEND, "next_colors_.data() + frame_->first_sample[pixel]", "colors_.data() + frame_->first_sample[pixel]",
           "oracle spp4_thesis image", "passes: pixels read what the same pass wrote"),

    # ---------------------------------------------------------------- 7. outliers
    Mutant("outlier_threshold", MATH, "1.00001f", "2.0f",
           "oracle spp8_paper color", "outliers: two deviations"),
    Mutant("outlier_equality", MATH, "1.00001f", "1.0f",
           "OutlierStep.KeepsTwoSamplesAndEqualSamples", "outliers: equality counts"),
    Mutant("outlier_one_sided", MATH, "return fabs(value - mean) > RPF_OUTLIER_THRESHOLD", "return value - mean > RPF_OUTLIER_THRESHOLD",
           "Outlier.IsMoreThanOneStandardDeviationOff", "outliers: only bright ones"),
    Mutant("energy_lost", WEIGHTING, "filtered[i * carried + c] += taken;", "filtered[i * carried + c] += 0 * taken;",
           "OutlierStep.KeepsTheEnergy", "outliers: energy not given back"),

    # ---------------------------------------------------------------- result, tiles and crop
    Mutant("scale_not_undone", DRIVER, "value / prepared.radiance_scale", "value",
           "oracle spp4_thesis image", "radiance scale: left in the image"),
    Mutant("weights_ignored", RESOLVE, "const bool weighted = !frame.weights.empty()", "const bool weighted = false",
           "Filter.WeightsSamplesInThePixelMean", "pixel mean: weights ignored"),
    Mutant("zero_weights", RESOLVE, "const auto is_weighted = [&](float w) { return w > 0; };", "const auto is_weighted = [&](float) { return true; };",
           "oracle sample_weight image", "pixel mean: 0 / 0 where no sample has a weight"),
    Mutant("empty_pixel", RESOLVE, "if (frame.samples(pixel) > 0) mean_of_samples", "if (colors.size() > 0) mean_of_samples",
           "oracle spp_varying_thesis image", "pixel mean: 0 / 0 without samples"),
    Mutant("tile_origin", BACKEND, "static_cast<std::size_t>(tile.x) + i % width", "i % width",
           BOTH + "GivesTheSameBitsForThreadsTilesAndRuns/*", "tiles: tile-relative pixel"),
    Mutant("last_tile_lost", DRIVER, "for (int y = 0; y < region.height; y += height)", "for (int y = 0; y + height <= region.height; y += height)",
           BOTH + "GivesTheSameBitsForThreadsTilesAndRuns/*", "tiles: the last band is skipped"),
    Mutant("crop_margin", PLAN, "(pass->box_width - 1) / 2", "(pass->box_width - 1) / 2 - 1",
           BOTH + "GivesTheSamePixelsForACrop/*", "crop: margin one pixel short"),

    # ---------------------------------------------------------------- files: merging and raw samples
    Mutant("merge_order", MERGE, "merged.record(next[p]));\n    next[p] += count;", "merged.record(next[p]));",
           "Merge.KeepsEverySampleOfTheFirstThenOfTheSecond", "merge: parts overwrite each other"),
    Mutant("merge_slots_by_place", MERGE, "if (samples.layout.slots == layout.slots) return;", "return;",
           "Merge.OrdersTheSlotsAsTheFirstDoes", "merge: columns taken by place, not by name"),
    Mutant("merge_twice", MERGE, "if (!repeats(a.samples, b.samples)) return;", "return;",
           "Merge.RefusesTheSameSamplesTwice", "merge: copies count as samples"),
    Mutant("raw_byte_order", RAW_READER, "b[1] << 8U", "b[1] << 16U",
           "Raw.IsRecognizedByItsContentAndDescribed", "raw: bytes in another order"),
    Mutant("raw_unused_plane", RAW_READER, "begin += samples.sample_count() * word;",
           "begin += channel.slot.empty() ? 0 : samples.sample_count() * word;",
           "Raw.AliasesAndMapWorkAndUnusedChannelsAreSkipped", "raw: planes of unused channels are not skipped"),
    Mutant("raw_counts_unchecked", RAW_READER, "if (sum != expected) fail();", "",
           "RawRefusals.EveryTruncationAndEveryByteMore", "raw: fewer samples than the file holds"),

    # ---------------------------------------------------------------- metrics
    Mutant("hdr_flip_least", HDR_FLIP, "return std::max(a, b);", "return std::min(a, b);",
           "HdrFlip.IsThatOfItsAuthors", "HDR-FLIP: the least error instead of the largest"),
    Mutant("hdr_flip_median", HDR_FLIP, "luminances.size() / 2)", "luminances.size() / 2 - 1)",
           "ExposureRange.ReachesFromTheBrightestPixelToTheMedian", "HDR-FLIP: the lower median"),
    Mutant("convolution_border", "src/metrics/convolution.cpp", "std::fill_n(padded.end() - radius, radius, row[width - 1]);", "",
           "HdrFlip.IsThatOfItsAuthors", "metrics: black beyond the right border"),
]
