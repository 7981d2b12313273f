"""Mutants of the error that a filtered frame tells of itself (algorithm.md, section 10)."""
from mutants import Mutant

FILE = "src/run/error_estimate.cpp"
NOISE, BLUR, FORMULA = "Filter.TellsAnErrorThatIsNoise", "Filter.TellsAnErrorThatIsBlur", "Filter.TellsTheErrorOfTheFormula"
REFUSALS, PICTURE = "Filter.RefusesToTellAnErrorOfTooFewSamples", "Filter.GivesTheSamePictureWhereItTellsTheError"
PROGRESS = "Filter.TellsHowFarItIsWithTheError"

MUTANTS = [
    Mutant("error_halves_alike", FILE, "samples.first_sample[p] + first;", "samples.first_sample[p] + 0 * first;",
           NOISE, "halves: the first one twice"),
    Mutant("error_halves_overlap", FILE, "s += 2)", "s += 1)", NOISE, "halves: the second is all but the first sample"),
    Mutant("error_of_half", FILE, "(fa - fb) * (fa - fb) / 4 / brightness", "(fa - fb) * (fa - fb) / 2 / brightness",
           NOISE, "variance: that of a half"),
    Mutant("error_bias_of_one", FILE, "(fb - b.mean.pixel(pixel)[c])", "(fa - a.mean.pixel(pixel)[c])",
           NOISE, "bias: a half against itself, so that its noise counts"),
    Mutant("error_colors", FILE, "colors * (color * color + relmse_floor)", "(color * color + relmse_floor)",
           NOISE, "three colors as one"),
    Mutant("error_least_brightness", FILE, "color * color + relmse_floor", "color * color + 2 * relmse_floor", BLUR, "unit: another one than relMSE's"),
    Mutant("error_around", FILE, "around = 4;", "around = 3;", BLUR, "means: over 7x7 pixels"),
    Mutant("error_chance", FILE, "std::max(sum - variance / sum, 0.0)", "sum", BLUR, "bias: chance counts"),
    Mutant("error_chance_unbiased", FILE, " * count / (count - 1);", ";", BLUR, "bias: variance of as many numbers as there are"),
    Mutant("error_below_zero", FILE, "if (sum <= 0 || count < 2) return 0;", "if (count < 2) return 0;",
           FORMULA + "WithoutBias", "bias: what is below 0 counts"),
    Mutant("error_one_half", FILE, "- samples.first_sample[p] > 1 ? 1 : 0", "- samples.first_sample[p] > 0 ? 1 : 0",
           FORMULA, "means: pixels with one half only count"),
    Mutant("error_crop_row", FILE, "for (int y = image.y - frame.y; y < image.y - frame.y + image.height; ++y)", "for (int y = 0; y < image.height; ++y)",
           FORMULA, "crop: rows of the frame's corner"),
    Mutant("error_crop_column", FILE, "for (int x = image.x - frame.x; x < image.x - frame.x + image.width; ++x)", "for (int x = 0; x < image.width; ++x)",
           FORMULA, "crop: columns of the frame's corner"),
    Mutant("error_mean_clamps", FILE, "mean.clamp_negative = settings.clamp_negative;", "",
           FORMULA, "plain mean: of other samples than the filter's"),
    Mutant("error_least_samples", FILE, "? 4 : 2;", "? 3 : 2;", REFUSALS, "halves: one of three samples has no variance"),
    Mutant("error_axis_aligned", FILE, " && method != Method::axis_aligned", "",
           REFUSALS, "halves: axis-aligned is asked for four samples"),
    Mutant("error_in_front", FILE, "with.channels.emplace_back(\"error\");", "with.channels.emplace(with.channels.begin(), \"error\");",
           PICTURE, "channels: the error's name is the first feature's"),
    Mutant("error_values_in_front", FILE,
           "if (before > 0) with.pixels.insert(with.pixels.end(), result.features.pixel(p), result.features.pixel(p) + before);\n"
           "    with.pixels.push_back(errors[p]);",
           "with.pixels.push_back(errors[p]);\n"
           "    if (before > 0) with.pixels.insert(with.pixels.end(), result.features.pixel(p), result.features.pixel(p) + before);",
           PICTURE, "channels: the error's values are the first feature's"),
    Mutant("error_progress", FILE, "part_of(control, share, share)", "part_of(control, 0, share)", PROGRESS, "progress: goes back"),
    Mutant("error_progress_end", FILE, "part_of(control, 2 * share, 2 * share)", "part_of(control, 2 * share, share)",
           PROGRESS, "progress: ends early"),
]
