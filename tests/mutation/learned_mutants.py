"""Mutants of the learned estimator on the reference, stage by stage (those of its kernels: opencl_mutants.py), and of what
reads its networks."""
from mutants import Mutant

NETWORK_LAYERS, PASSES = "src/cpu/layers.cpp", "src/cpu/passes.cpp"
SAMPLES, ESTIMATE = "src/cpu/sample_network.cpp", "src/cpu/estimate.cpp"
FILE = "src/learned/network_file.cpp"
LEARNED = "conformance learned/scene/dof "

MUTANTS = [
    Mutant("learned_two_roundings", SAMPLES, "squares_[k] = fma(d, d, squares_[k]);", "squares_[k] += d * d;",
           LEARNED + "pixel", "moments: a product rounded by itself"),
    Mutant("learned_deviation", SAMPLES, "values[features + k] = kernel::rpf_feature_deviation(variance(k, samples));",
           "values[features + k] = kernel::rpf_feature_deviation(variance(0, samples));", LEARNED + "pixel", "deviations of the first feature"),
    Mutant("learned_edge", NETWORK_LAYERS, "std::clamp(x + c + kx, 0, out.width - 1)", "std::clamp(x + c + kx, 0, out.width - 2)",
           LEARNED + "down0", "convolution: another edge is repeated"),
    Mutant("learned_not_activated", NETWORK_LAYERS, "for (float* a : acc) activate(a, layer.outputs);", "",
           LEARNED + "down0", "convolution: a line in place of a bend"),
    Mutant("learned_halve", NETWORK_LAYERS, "sum += in.at(2 * x + i, 2 * y + j)[c];", "sum += in.at(2 * x + i, 2 * y)[c];",
           LEARNED + "down1a", "halving: the upper cells twice"),
    Mutant("learned_distance", PASSES, "w[x] = fma(t, t, w[x]);", "w[x] += t * t;", LEARNED + "pass0", "passes: a product rounded by itself"),
    Mutant("learned_taps", PASSES, "if (y + dy < 0 || y + dy >= in.height) continue;", "if (y + dy < 0 || y + dy >= in.height - 1) continue;",
           LEARNED + "pass0", "passes: the last row weighs nothing"),
    Mutant("learned_weight", SAMPLES, "return kernel::rpf_learned_weight(logit);", "return kernel::rpf_learned_weight(logit * 1.000001F);",
           LEARNED + "weights", "samples: another logit"),
    Mutant("learned_sum", ESTIMATE, "sums_.at(y, RPF_SUM_WEIGHT)[x] += w;", "sums_.at(y, RPF_SUM_WEIGHT)[x] += share;",
           LEARNED + "sums", "samples: their number in place of their weight"),
    Mutant("learned_not_finite", FILE, "if (!std::isfinite(values.back()))", "if (false)",
           "NetworkFile.AWeightThatIsNotFiniteIsRefusedWithItsLayer", "networks: an infinite weight is taken"),
    Mutant("learned_name", FILE, "if (!is_printable(n.name)) refuse", "if (false) refuse", "NetworkFile.ANameThatIsNoLineIsRefused",
           "networks: a name with control characters reaches the terminal"),
]
