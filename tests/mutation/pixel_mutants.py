"""Mutants of the methods that filter pixels (algorithm.md, section 9); both backends run one text."""
from mutants import Mutant

PATCH, BANK, RISK, PLANES = "kernels/patch_steps.h", "kernels/bank_steps.h", "kernels/risk_steps.h", "kernels/plane_steps.h"
SHADOW = "kernels/shadow_steps.h"
VIEWS, TRACKS = "kernels/views.h", "src/plan/tracks.cpp"
NEAREST, METRICS, TREE, COLUMNS = "kernels/nearest.h", "src/plan/leaf_metrics.cpp", "src/plan/sample_tree.cpp", "src/plan/pixel_columns.cpp"
QUANTITIES = "src/frame/pixel_planes.cpp"

MUTANTS = [
    Mutant("pixel_nlm_variance", PATCH, "variance_b < variance_a ? variance_b : variance_a", "variance_b",
           "oracle nlm image", "patch distance: the other's variance, smaller or not"),
    Mutant("pixel_nlm_cut", PATCH, "mean < least ? 0.0f : mean", "mean < 0.0f * least ? 0.0f : mean", "oracle nlm image", "patch weights: small ones count"),
    Mutant("pixel_gather_own", PLANES, "(other[x + dx] - own[x])", "(other[x + dx] - 0.5f * own[x])", "oracle nlm image", "gathering: half of what p has"),
    Mutant("pixel_box_edge", PLANES, "run.x1 < width - i ? run.x1 : width - i", "run.x1 < width - 1 - i ? run.x1 : width - 1 - i",
           "oracle nlm_one_row image", "a box that stops before the last pixel"),
    Mutant("pixel_halves_alike", QUANTITIES, "mean(pixel, plane.channel, samples > 1 ? 1 : 0, 2)", "mean(pixel, plane.channel, 0, 2)",
           "oracle nlm image", "halves: the first one twice"),
    Mutant("pixel_gem_bias", BANK, "trust * (ratio *", "trust * (0.5f * ratio *", "oracle gem image", "bias: that of the wider Gaussian alone"),
    Mutant("pixel_gem_agreed", BANK, ">= 0.5f) ? 1.0f", ">= 0.0f) ? 1.0f", "oracle gem_varying image", "stops: each decides alone"),
    Mutant("pixel_sbf_risk", RISK, "(2.0f * own_share - 1.0f)", "(own_share - 1.0f)", "oracle sbf image", "risk: half of the derivative"),
    Mutant("pixel_shadow_finest", SHADOW, "blur > finest ? blur : finest", "blur", "oracle axis_aligned_varying image", "falloff: no least width"),
    Mutant("pixel_shadow_normals", SHADOW, "turned <= step->least", "turned >= 0.0f * step->least", "oracle axis_aligned image", "weights: normals do not count"),
    Mutant("pixel_shadow_albedo", SHADOW, "in[x] / (albedo[x] > step->least ? albedo[x] : step->least)", "in[x]", "oracle axis_aligned image", "albedo: put in twice"),
    Mutant("pixel_shadow_least", QUANTITIES, "value < least)", "value > least)", "oracle axis_aligned image", "slopes: the largest"),
    Mutant("light_crossings", VIEWS, "if (still < fabs(", "if (still < -fabs(", "oracle lightfield image", "surfaces: those that the lens parts are one"),
    Mutant("light_covers", VIEWS, "return end - first > 2;", "return end - first > 9;", "oracle lightfield image", "coverage: of crowds only"),
    Mutant("light_depth", VIEWS, "a->depth < b->depth", "a->depth > b->depth", "oracle lightfield image", "surfaces: the last one is seen"),
    Mutant("light_shift", VIEWS, "1.0f / seen.depth - lens->inverse_focus", "1.0f / seen.depth", "oracle lightfield image", "the lens: focused on what is far"),
    Mutant("light_shares", VIEWS, "1.0f - sqrt(seen->near[i].distance) / reach", "1.0f", "oracle lightfield image", "surfaces: samples count alike"),
    Mutant("light_bend", TRACKS, "bends ? off / around : 0", "0", "oracle lightfield image", "trajectories: straight ones"),
    Mutant("column_metric", METRICS, "is_steep ? tensor[k][l] / all : 0", "is_steep ? 0 * tensor[k][l] : 0", "oracle multidim image", "the metric: round"),
    Mutant("column_triangle", METRICS, "(k == l ? 1 : 2) * tensor[k][l]", "tensor[k][l]", "oracle multidim image", "the metric: half of what is beside the diagonal"),
    Mutant("column_reach", NEAREST, "off * off * metric[RPF_REACH + axis]", "off * off * (1.0f + metric[RPF_REACH + axis])", "oracle multidim image", "the search: stops where the metric is steepest"),
    Mutant("column_leaves", NEAREST, "#define RPF_MOST_LEAVES 64", "#define RPF_MOST_LEAVES 6", "oracle multidim image", "the search: gives up early"),
    Mutant("column_axis", TREE, "if (width > most) widest", "if (width < most) widest", "oracle multidim image", "the tree: cut where it is narrow"),
    Mutant("column_lens", COLUMNS, "lens * record[", "0.1F * lens * record[", "oracle multidim image", "the space: samples on a smaller lens than points"),
    Mutant("pixel_sbf_least", RISK, "variance > least ? variance : least", "variance + least", "oracle sbf image", "features: the least variance is added"),
]
