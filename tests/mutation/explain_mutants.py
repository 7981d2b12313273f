"""Mutants of src/explain, and of what backends hand to it (those of the kernels are in opencl_mutants.py)."""
from mutants import BACKEND, Mutant

ATTRIBUTION, LAYERS = "src/explain/attribution.cpp", "src/explain/layers.cpp"
TRACED_PIXEL = "src/explain/traced_pixel.cpp"

MUTANTS = [
    Mutant("explain_all_close", ATTRIBUTION, "if (is_close(", "if (true || is_close(",
           "Filter.ExplainFindsTheGroup*", "all pairs count as close"),
    Mutant("explain_chance", ATTRIBUTION, "certainty = 1;", "certainty = 0;",
           "Filter.ExplainBlamesNobody*", "what could be chance counts"),
    Mutant("explain_covariance", ATTRIBUTION, "std::max(caused[p] - covariance[p] - ", "std::max(caused[p] + covariance[p] - ",
           "Filter.ExplainBlamesNobody*:Filter.ExplainSharesNoise*", "what all pairs have in common counts"),
    Mutant("explain_noise_unit", LAYERS, "attribution.variance[pixel] / 3 / unit / unit", "attribution.variance[pixel] / unit / unit",
           "Filter.ExplainKnowsTheStandardError*", "three channels as one"),
    Mutant("explain_density_sum", LAYERS, "mean * measured * relative[pixel] / sum", "mean * relative[pixel] / sum",
           "Filter.ExplainSuggests*", "not scaled to the samples there are"),
    Mutant("explain_repeated_draws", TRACED_PIXEL, "++result[place->second].drawn;", "result[place->second].drawn = 1;",
           "Filter.ExplainedPixel*", "a sample that was drawn twice counts once"),
    Mutant("explain_tile", BACKEND, "(y - tile.y) * tile.width + x - tile.x", "(y - tile.y) * tile.width + x",
           "Filter.ExplainIsTheSame*", "place in the tile"),
]
