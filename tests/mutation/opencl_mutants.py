"""Mutants of the OpenCL kernels: at least one for every stage that the conformance suite compares.

The test "conformance CASE STAGE" demands that STAGE is the first one in which device and reference differ; "device" means
that the device's self-test refuses it.
"""
from mutants import Mutant

NUMERIC = "kernels/numeric.h"
NEIGHBORHOOD, STATISTICS = "kernels/neighborhood.cl", "kernels/statistics.cl"
COORDINATES = "kernels/coordinates.cl"
WEIGHTING, FILTER = "kernels/weighting.cl", "kernels/filter.cl"
SAMPLES, PIXELS, SUMS = "kernels/network_samples.cl", "kernels/network_pixels.cl", "kernels/network_sums.cl"
PASSES, NETWORK = "kernels/network_passes.cl", "kernels/network.cl"
LAYERS, STEPS = "src/opencl/layer_blocking.cpp", "src/opencl/estimate_steps.cpp"
LEARNED, MANY = "conformance learned/scene/dof ", "conformance learned/samples/150spp "
DOF, PAPER = "conformance scene/dof/thesis ", "conformance scene/dof/paper "

MUTANTS = [
    Mutant("cl_contraction", NUMERIC, "#pragma OPENCL FP_CONTRACT OFF", "#pragma OPENCL FP_CONTRACT ON",
           DOF + "device", "a * b + c in one rounding"),

    # ---------------------------------------------------------------- 3. neighborhood
    Mutant("cl_shift", NEIGHBORHOOD, "out->shift[c] = shift_of(frame, pass, first, own, c);",
           "out->shift[c] = shift_of(frame, pass, first + own - 1, 1, c);", DOF + "shift", "another sample's values"),
    Mutant("cl_own_mean", NEIGHBORHOOD, "count == 0 ? 0.0f : rpf_lanes_total(&sum) / number;",
           "count == 0 ? 0.0f : rpf_lanes_total(&sum) / (number + 1.0f);", DOF + "own_mean", "one sample too many"),
    Mutant("cl_own_deviation", NEIGHBORHOOD, "sqrt(rpf_lanes_total(&sum) / number)", "sqrt(rpf_lanes_total(&sum) / (number - 1.0f))",
           DOF + "own_deviation", "n - 1"),
    Mutant("cl_tolerance", NEIGHBORHOOD, "count == 0 ? INFINITY : tolerance;", "tolerance;",
           "conformance extreme/missing-feature tolerance", "a feature that no own sample has"),
    Mutant("cl_attempt", NEIGHBORHOOD, "uint attempt = 0; attempt < pass->attempts", "uint attempt = 1; attempt < pass->attempts",
           DOF + "neighbors", "draws: the first attempt is left out"),
    Mutant("cl_redraw", NEIGHBORHOOD, "attempt < pass->attempts && any_lane(failed)", "attempt + 1 < pass->attempts && any_lane(failed)",
           "conformance redraws/1 shift", "draws: an attempt less"),
    Mutant("cl_border", NEIGHBORHOOD, "to_x < 0 | to_x >= pass->width", "to_x < 0 | to_x > pass->width",
           DOF + "neighbors", "draws: a column behind the image"),
    Mutant("cl_rejection", NEIGHBORHOOD, "return !any_lane(rejected);", "return !rejected.s0;",
           DOF + "shift", "rejection: by the first feature alone"),

    # ---------------------------------------------------------------- 4. normalization
    Mutant("cl_mean", STATISTICS, "rpf_lanes_total(&sums.values) / count", "rpf_lanes_total(&sums.values) / (count + 1.0f)",
           DOF + "mean", "one neighbor too many"),
    Mutant("cl_missing", STATISTICS, "if (RPF_MISSING) sums.missing += rpf_is_missing(value) ? 1 : 0;", "",
           "conformance extreme/nan-feature mean", "missing values count"),
    Mutant("cl_flat", STATISTICS, "magnitude = fabs(value + shift);", "magnitude = fabs(value);",
           "conformance world/offset1e+07 deviation", "spread is compared with shifted values"),
    Mutant("cl_normalized", STATISTICS, "rpf_normalize(value, n->mean[chunk]", "rpf_normalize(value, 0.0f * n->mean[chunk]",
           DOF + "normalized", "mean is not 0"),

    # ---------------------------------------------------------------- 5. mutual information and weights
    Mutant("cl_bins", STATISTICS, "rpf_signed_bin(value, RPF_HALF_BINS)", "rpf_signed_bin(value * 1.1f, RPF_HALF_BINS)",
           DOF + "bins", "bins: stretched"),
    Mutant("cl_half", STATISTICS, "rows[2 * bin + 1] = as_float16(halves[1]", "rows[2 * bin + 1] = as_float16(halves[0]",
           "conformance max-samples/64 any", "bit planes: the second half is the first"),
    Mutant("cl_word", STATISTICS, "(variable_at(place) * words + word)", "(variable_at(place) * words)",
           "conformance max-samples/1025 any", "bit planes: the last 64 neighbors only"),
    Mutant("cl_mask", STATISTICS, "uint16 plane = is_neighbor;", "uint16 plane = 0xFFFFFFFFu;",
           "conformance max-samples/17 any", "bit planes: what is no neighbor counts"),
    Mutant("cl_margin", STATISTICS, "left[v] -= rows[i][v];", ";", DOF + "histograms", "histograms: the last row"),
    Mutant("cl_information", STATISTICS, "joint - units[x] - units[y] + all", "joint - units[x] - units[y] - all",
           DOF + "information", "sign of N ln N"),
    Mutant("cl_bias", STATISTICS, "pass->nats_per_unit, pass->information_bias,", "pass->nats_per_unit, 0.0f,",
           "conformance bias-correction information", "correction ignored"),
    Mutant("cl_w", FILTER, "rpf_weigh_dependencies(information, RPF_RANDOM",
           "rpf_weigh_dependencies(information + 1, RPF_RANDOM",
           DOF + "W", "a pair is lost"),
    Mutant("cl_alpha", FILTER, "RPF_FEATURES, pass->alpha_factor, pass->growth", "RPF_FEATURES, 1.0f, pass->growth",
           DOF + "alpha", "factor ignored"),
    Mutant("cl_beta", FILTER, "RPF_FEATURES, pass->alpha_factor, pass->growth", "RPF_FEATURES, pass->alpha_factor, 1.0f",
           "conformance alpha-factor/0 beta", "growth ignored"),

    # ---------------------------------------------------------------- 6., 7. filter and outliers
    Mutant("cl_distance", WEIGHTING, "distance[i] += difference * difference;", "distance[i] += fabs(difference);",
           DOF + "weights", "distance is not squared"),
    Mutant("cl_batch", COORDINATES, "min(begin + i, means->own - 1)", "min(i, means->own - 1)",
           "conformance samples/dof/8spp weights", "the second four samples are the first"),
    Mutant("cl_weight_mask", WEIGHTING, "is_neighbor ? rpf_weight(distance[i]) : 0.0f", "rpf_weight(distance[i])",
           "conformance max-samples/17 filtered", "what is no neighbor has a weight"),
    Mutant("cl_hull", WEIGHTING, "largest_lane(ranges.largest[c])", "smallest_lane(ranges.smallest[c])",
           DOF + "filtered", "held below the smallest color"),
    Mutant("cl_outliers", FILTER, "if (pass->outlier_step) replace_outliers(out, own);", "", PAPER + "colors", "no outlier step"),
    Mutant("cl_energy", WEIGHTING, "filtered[i * RPF_CARRIED + c] += taken;", "filtered[i * RPF_CARRIED + c] -= taken;",
           PAPER + "colors", "energy of the outliers"),
    Mutant("cl_items", FILTER, "i += (uint)get_global_size(0)", "i += (uint)get_global_size(0) + 1",
           DOF + "statistics", "pixels are left out"),
    Mutant("cl_statistics", FILTER, "statistics.beta = rpf_mean(weights.beta, RPF_FEATURES);", "statistics.beta = weights.beta[0];",
           DOF + "statistics", "one feature instead of the mean"),
    Mutant("cl_explained_information", FILTER, "explained[i] = information[i];", "explained[i] = information[0];",
           "conformance explain/4spp explained", "one pair for all"),
    Mutant("cl_explained_samples", WEIGHTING, "share += weight[i] * (1.0f / lanes_total(slot->sums[(begin + i) * (1 + RPF_CARRIED)]));", "share += weight[i];",
           "conformance explain/4spp explained", "own samples with many neighbors count more"),

    # ---------------------------------------------------------------- the learned estimator
    Mutant("cl_seen", SAMPLES, "rows[RPF_SEEN_INPUTS + RPF_INPUT_BRIGHTNESS + i] = rpf_brightness(color);",
           "rows[RPF_SEEN_INPUTS + RPF_INPUT_BRIGHTNESS + i] = rpf_brightness(color * 1.000001f);", LEARNED + "inputs", "another color"),
    Mutant("cl_records", LAYERS, "r{}[columns[j]]", "r{}[columns[j] - 1]", LEARNED + "sample1", "the column before"),
    Mutant("cl_moments", PIXELS, "m->squares = fma(d, d, m->squares);", "m->squares += d * d;", LEARNED + "pixel", "two roundings"),
    Mutant("cl_last_records", SAMPLES, "begin + k < end ? of->records[begin + k] : 0.0f", "0.0f", LEARNED + "inputs", "the last records are not read"),
    Mutant("cl_pixel_batch", PIXELS, "batch->x = x + 1;", "batch->x = x;", "conformance learned/samples/varying pixel",
           "statistics stand a pixel too far to the left behind one without samples"),
    Mutant("cl_traced_rows", "src/opencl/sample_stage.cpp", "bring(row, trace_ == nullptr ? rows.end : row + 1, again)", "bring(row, rows.end, again)",
           "conformance learned/crop/wide inputs", "samples beside the window are traced"),
    Mutant("cl_stretch", SAMPLES, "stretch.begins = first_of_pixel(part, x) == sample;", "stretch.begins = true;", MANY + "pixel",
           "a pixel begins anew with every row of samples"),
    Mutant("cl_stretch_sums", SUMS, "PixelSums sums = stretch->begins ? no_sums() : *pixel;", "PixelSums sums = no_sums();", MANY + "sums",
           "only the last samples of a pixel count"),
    Mutant("cl_context", SUMS, "    x = stretch.x;\n", "", LEARNED + "weights", "the context of the pixel before"),
    Mutant("cl_border_cells", NETWORK, "line[k - stride] = line[k];", "line[k - stride] = 0.0f;", LEARNED + "down0", "zeros beside the frame"),
    Mutant("cl_layer_order", LAYERS, "for (int ky = -1; ky <= 1; ++ky)", "for (int ky = 1; ky >= -1; --ky)", LEARNED + "down0", "rows upside down"),
    Mutant("cl_halve", NETWORK, "sum += vload8(0, upper + at + stride);\n", "sum += vload8(0, upper + at);\n", LEARNED + "down1a", "a cell twice"),
    Mutant("cl_coarse", LAYERS, "return (c + kx + 1) / 2;", "return (c + kx) / 2;", LEARNED + "up1a", "the coarse cell beside"),
    Mutant("cl_learned_weight", SUMS, "float16 logit = output[RPF_WEIGHT_FEATURES];", "float16 logit = 0.0f;", LEARNED + "weights", "no bias"),
    Mutant("cl_sums", SUMS, "rpf_added(sums.weight, weight)", "weight", LEARNED + "sums", "the last sample for all"),
    Mutant("cl_kept_rows", SAMPLES, "row_at(grid, part->y) + (size_t)(sample - first_of_pixel(part, 0)) * RPF_KEPT", "(size_t)(sample - first_of_pixel(part, 0)) * RPF_KEPT",
           LEARNED + "weights", "what is kept of the rows' samples lies one over the other"),
    Mutant("cl_taps", PASSES, "total += w;", "total += t == 4 ? 0.0f : w;", LEARNED + "pass0", "a tap is not counted"),
    Mutant("cl_tap_rows", PASSES, "if (row < 0 || row >= p->area.height) continue;", "if (row < 0) continue;", LEARNED + "pass0",
           "rows below the frame count"),
    Mutant("cl_edge_weights", PASSES, "begin == 0 && x < RPF_MARGIN; ++x) row[x] = RPF_NOT_THERE", "begin == 0 && x < RPF_MARGIN; ++x) row[x] = 0.0f",
           LEARNED + "pass0", "pixels beside the frame weigh"),
    Mutant("cl_weights_behind", PASSES, "(-from - 1) * plane + right * dilation", "(-from - 1) * plane", LEARNED + "pass0",
           "what a pixel further back weighs stands with that pixel"),
    Mutant("cl_weights_beside", PASSES, "begin, end, area.width, 0.0f);", "begin, end, area.width, 1.0f);", LEARNED + "pass0",
           "pixels beside the frame weigh"),
    Mutant("cl_blend", PASSES, "rpf_blend(vload16(0, values))", "vload16(0, values)", LEARNED + "result", "the logit in place of the share"),
    Mutant("cl_rows_kept", "src/opencl/row_pipeline.cpp", "first_read(read, step.done));\n}", "first_read(read, step.done) - 1);\n}",
           "conformance learned/size/3x400 image", "a row less is kept"),
]
