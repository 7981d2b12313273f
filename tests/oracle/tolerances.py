"""Every tolerance of the comparison with the oracle, each with its reason. What is not listed is compared exactly."""

# The largest deviation of each kind that float32 and the table of n ln n explain.
TOLERANCE = {
    # part of the largest magnitude among the averaged values: the unshifted mean is one float32, 6e-8 of it, and sums
    # of up to a few hundred terms add a few of these
    "mean": 1e-6,
    # part of the range of the values: sums are taken after subtracting one of them, so the range sets the rounding
    "std": 1e-5,
    # relative: H times a float32 standard deviation, or the diagonal of a box
    "tolerance": 1e-5,
    # relative: a candidate whose |f - m| is this near to the tolerance may be accepted or not; the trace decides
    "near_tolerance": 1e-5,
    # normalized values, absolute, and as part of the variable's largest normalized magnitude in the neighborhood
    # (about half its range in standard deviations; mean and deviation are rounded relative to the range)
    "normalized": 1e-5,
    "normalized_relative": 2e-6,
    # a normalized value as near to a bin edge as these two allow may fall on either side; the trace decides
    # mutual information: 2 E ln 2 / (S N) from the integer table (see information_bound), and float32, relative
    "information_relative": 1e-6,
    # nats, absolute: what the integer table may cost at the largest neighborhood; keeps the bound above of use
    "information_table": 1e-4,
    # absolute: ratios and their affine functions in [0,1]; small sums amplify the error of the information
    "fraction": 1e-3,
    # relative to max(|value|, color_floor * mean radiance of the frame): the weights' exponents are multiples of the
    # fractions above by up to a few hundred
    "color": 1e-3,
    "color_floor": 1e-3,
    # an outlier decision may go either way when its distance from one standard deviation is within this part of the
    # deviation, or this part of the value (float32 error of the filtered colors)
    "outlier": 3e-6,
    "outlier_value": 1e-6,
    # fixed weights, section 8: float32's rounding of coordinates, of their differences and of the exponent, in units of
    # slack = w (1 + d^2 + d * largest coordinate), and the weights that rpf_exp sets to 0
    "fixed_weight": 5e-7,
    "fixed_least": 1e-37,
    # relative to the brightest value of the frame: the weights' errors in a mean
    "fixed_color": 2e-6,
    # methods that filter pixels, section 9, relative to the brightest value of the frame: a weighted mean of up to 3,024
    # differences, whose weights have exponents that are sums of 147 quotients of float32; measured: 2.2e-7
    "pixel_color": 1e-6,
    # a weight as near to the least one that counts may count or not; the bound of its pixel allows both
    "pixel_near": 1e-4,
    # the light field, section 11: pixels, or the part of a depth, within which float32 may decide otherwise; what a picture
    # may differ by where it does not, relative to the brightest value: the sum of up to some hundred differences; and the
    # part of all views that may be so close, beyond which nothing would be compared
    "light_near": 5e-6,
    "light_color": 1e-6,
    "light_close": 0.1,
    # section 12: the part of a squared distance within which float32 may take the other sample
    "column_near": 1e-4,
    # standard deviations of chance; 6 happens once in 1e9
    "draw_statistics": 6.0,
}
