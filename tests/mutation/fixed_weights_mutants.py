"""Mutants of the methods with fixed weights (algorithm.md, section 8), of the reference and of the OpenCL kernel."""
from mutants import CLEAN_FRAME, ELEMENTWISE, Mutant

BOX, BOX_KERNEL, FIXED_WEIGHTS = "src/cpu/box.cpp", "kernels/box.cl", "src/plan/fixed_weights.cpp"

MUTANTS = [
    Mutant("box_row", BOX, "frame.height - 1); ++row", "frame.height - 2); ++row", "oracle gaussian neighbors", "box: without the last row"),
    Mutant("box_own", BOX, "first_sample[row == y ? pixel + 1 : begin]", "first_sample[row == y ? pixel : begin]",
           "oracle bilateral neighbors", "box: the own samples twice"),
    Mutant("box_missing", ELEMENTWISE, "rpf_or_zero(value - center)", "rpf_or_zero(value) - center",
           "oracle cross_bilateral_missing weights", "a missing feature counts as 0 instead of the mean"),
    Mutant("box_sigma", FIXED_WEIGHTS, "(std::sqrt(2.0) * sigma)", "sigma", "oracle gaussian weights", "sigma: without the 2"),
    Mutant("box_group", "src/frame/feature_spread.cpp", "group_of_variable(names[other]) == group_of_variable(names[k])", "other == k",
           "oracle cross_bilateral weights", "features: a unit for every component"),
    Mutant("box_radiance", FIXED_WEIGHTS, "(settings.sigma_color) * facts.radiance_scale", "(settings.sigma_color)",
           "oracle bilateral weights", "sigma of the color: in scaled radiance"),
    Mutant("box_largest_scale", FIXED_WEIGHTS, "0x1p80", "0x1p127",
           "Methods/EveryMethod.StaysInsideTheRangeOfItsInputAtAnyRadianceAndSigma/*", "sigma: so small that distances overflow"),
    Mutant("box_position", CLEAN_FRAME, "(place[axis]) + 0.5F", "(place[axis])",
           "Methods/EveryMethod.TakesTheMiddleOfThePixelForAMissingPosition/*", "input: a missing position is the pixel's corner"),

    Mutant("cl_box_edge", BOX_KERNEL, "row <= min(y + pass->reach, pass->height - 1)", "row <= min(y + pass->reach, pass->height - 2)",
           "conformance method/gaussian/4spp neighbors", "box: without the last row"),
    Mutant("cl_box_own", BOX_KERNEL, "begin = after_own;", "begin = own;",
           "conformance method/bilateral/varying neighbors", "box: the own samples twice"),
    Mutant("cl_box_missing", BOX_KERNEL, "RPF_VARIABLES + v], centers[v])", "RPF_VARIABLES + v], 0.0f)",
           "conformance method/cross-bilateral/extreme/nan-feature weights", "a missing feature counts as 0 instead of the mean"),
    Mutant("cl_box_copy", BOX_KERNEL, "i < box->count[r]; i += RPF_LANES", "i + RPF_LANES <= box->count[r]; i += RPF_LANES",
           "conformance method/gaussian/varying weights", "runs: what fills no vector is not copied"),
    Mutant("cl_box_carried", BOX_KERNEL, "(RPF_VARIABLES + c) * pass->samples", "(RPF_VARIABLES + RPF_CARRIED - 1 - c) * pass->samples",
           "conformance method/gaussian/4spp filtered", "colors: blue for red"),
]
