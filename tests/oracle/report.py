"""The table that compare.py prints: the largest deviation of each stage, and the first failure."""
import numpy as np

STAGES = ["variables", "draws", "start", "own_mean", "own_std", "tolerance", "neighbors", "mean", "std", "normalized", "bins",
          "histograms", "mutual_information", "W_c_r", "W_f_r", "W_c_f", "fraction_random", "alpha", "beta",
          "weights", "filtered", "color", "image"]


class Report:
    """The largest deviation of each stage, the first failure, and how often the trace decided a close call."""

    def __init__(self):
        self.worst = {}             # stage -> (deviation / bound, deviation, bound)
        self.failures = {}          # stage -> number of pixels that differ
        self.first_failure = None
        self.close_calls = {"neighbors": 0, "bins": 0, "outliers": 0}

    def check(self, stage, got, expected, bound, where, note="", names=None):
        """Both arrays must have one shape and differ by no more than the bound (broadcast); NaN always fails.
        names, when given, are those of the last axis."""
        got, expected = np.asarray(got, dtype=np.float64), np.asarray(expected, dtype=np.float64)
        if got.shape != expected.shape:
            return self.fail(stage, where, f"shape {got.shape}, expected {expected.shape} {note}")
        if got.size == 0:
            self.worst.setdefault(stage, (0.0, 0.0, 0.0))
            return True
        with np.errstate(invalid="ignore", divide="ignore"):
            deviation = np.where(got == expected, 0.0, np.abs(got - expected))
            ratio = np.where(deviation == 0, 0.0, deviation / bound)
        ratio = np.where(np.isnan(ratio), np.inf, ratio)
        at = np.unravel_index(ratio.argmax(), ratio.shape)
        bound_at = float(np.broadcast_to(bound, got.shape)[at])
        if stage not in self.worst or ratio[at] > self.worst[stage][0]:
            self.worst[stage] = (float(ratio[at]), float(deviation[at]), bound_at)
        if ratio[at] > 1:
            index = "".join(f"[{i}]" for i in (at if names is None else (*at[:-1], names[at[-1]])))
            self.note_failure(stage, f"{where}: {stage}{note}{index}: trace {got[at]!r}, oracle {expected[at]!r}, "
                                     f"deviation {deviation[at]:.3g}, bound {bound_at:.3g}")
        return bool(ratio[at] <= 1)

    def fail(self, stage, where, text):
        """A failure that is not a number."""
        self.worst[stage] = (np.inf, np.inf, 0.0)
        self.note_failure(stage, f"{where}: {stage}: {text}")
        return False

    def note_failure(self, stage, text):
        self.failures[stage] = self.failures.get(stage, 0) + 1
        self.first_failure = self.first_failure or text

    def print(self):
        print(f"{'stage':<20}{'deviation':>12}{'bound':>12}{'of bound':>10}  ok")
        for stage in STAGES:
            ratio, deviation, bound = self.worst.get(stage, (0.0, 0.0, 0.0))
            state = f"NO, {self.failures[stage]} times" if stage in self.failures else (
                "yes" if stage in self.worst else "not reached")
            print(f"{stage:<20}{deviation:>12.3g}{bound:>12.3g}{ratio:>10.2g}  {state}")
        print("close calls left to the trace:", ", ".join(f"{n} {what}" for what, n in self.close_calls.items()))
        if self.first_failure:
            print("first failure:", self.first_failure)
