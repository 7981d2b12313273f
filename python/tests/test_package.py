"""The package against the command, and what it promises about memory, threads, signals and errors."""
import json
import re
import resource
import signal
import subprocess
import sys
import threading
import time
import zlib
from pathlib import Path

import numpy as np
import pytest

rpf = pytest.importorskip("rpf")
pytest.importorskip("rpf._core")

PROJECT = Path(__file__).parents[2]


def small_frame(width=12, height=8, spp=4, seed=1, **options):
    random = np.random.default_rng(seed)
    y, x = np.repeat(np.indices((height, width)).reshape(2, -1), spp, axis=1)
    planes = {name: random.random(x.size, np.float32) for name in ("R", "G", "B", "random.lens.U", "random.lens.V")}
    planes.update({"film.X": x + 0.5, "film.Y": y + 0.5})
    return rpf.Samples.from_channels(np.full((height, width), spp), planes, **options)


def address(array):
    return array.__array_interface__["data"][0]


# ---- files --------------------------------------------------------------------------------------------------------------

def test_convert_writes_what_read_and_write_write(tmp_path):
    rpf.write(tmp_path / "a.rpf", small_frame())
    for ending in ("exr", "rpf"):
        rpf.convert(tmp_path / "a.rpf", tmp_path / f"converted.{ending}")
        rpf.write(tmp_path / f"written.{ending}", rpf.read(tmp_path / "a.rpf"))
        assert (tmp_path / f"converted.{ending}").read_bytes() == (tmp_path / f"written.{ending}").read_bytes()
    with pytest.raises(rpf.InputError, match="nothing.exr"):
        rpf.convert(tmp_path / "nothing.exr", tmp_path / "b.exr")


# ---- bits ---------------------------------------------------------------------------------------------------------------

@pytest.mark.parametrize("backend", ["cpu", "opencl"])
@pytest.mark.parametrize("choice", [{"preset": "fast"}, {"preset": "balanced"}, {"profile": "paper"}], ids=lambda c: "-".join(*c.items()))
def test_bits_are_the_commands(command, tmp_path, backend, choice):
    if backend == "opencl" and not rpf.devices():
        pytest.skip("no OpenCL device")
    path, ours, theirs = (tmp_path / name for name in ("in.exr", "ours.exr", "theirs.exr"))
    rpf.write(path, small_frame(31, 23))
    image = rpf.filter(rpf.read(path), backend=backend, **choice)
    assert image.report.backend.startswith(backend)
    rpf.write(ours, image)
    command(path, "-o", theirs, "--backend", backend, "-q", *(f"--{name}={value}" for name, value in choice.items()))
    expected = rpf.read_image(theirs)
    assert np.array_equal(image.pixels.view(np.uint32), expected.pixels.view(np.uint32))
    assert np.array_equal(rpf.read_image(ours).pixels.view(np.uint32), expected.pixels.view(np.uint32))


def test_readme(command, tmp_path, example, monkeypatch):
    """The five lines of the README, run where they find their files."""
    code = re.search(r"```python\n(.*?)```", (PROJECT / "README.md").read_text(), re.S).group(1)
    (tmp_path / "render.samples.exr").write_bytes(example.read_bytes())
    monkeypatch.chdir(tmp_path)
    exec(code, {})
    command("render.samples.exr", "-o", "theirs.exr", "-q")
    assert np.array_equal(rpf.read_image("filtered.exr").pixels, rpf.read_image("theirs.exr").pixels)


def test_compare_is_the_commands(command, tmp_path, example):
    reference = PROJECT / "examples/dof-spheres.reference.exr"
    image = rpf.filter(rpf.read(example), preset="fast")
    rpf.write(tmp_path / "a.exr", image)
    error = rpf.compare(image, rpf.read_image(reference))
    told = json.dumps(json.loads(command("compare", tmp_path / "a.exr", reference, "--json")))
    for name in ("relmse", "flip", "energy"):
        value = float(re.search(rf'"{name}": ([0-9.e-]+)', told, re.I).group(1))
        assert getattr(error, name) == pytest.approx(value, rel=1e-9)


# ---- memory -------------------------------------------------------------------------------------------------------------

def test_arrays_share_memory():
    samples = small_frame()
    values = samples.values
    assert values.shape == (384, 7) and values.dtype == np.float32
    assert address(values) == address(samples.values)
    for column, slot in enumerate(samples.slots):
        assert address(samples[slot]) == address(values) + 4 * column and samples[slot].strides == values.strides[:1]
    assert address(samples.first_sample) == address(samples.first_sample)
    image = rpf.filter(samples, "fast", "cpu")
    assert address(image.pixels) == address(image.pixels)
    for array in (values, samples["R"], samples.first_sample, image.pixels):
        with pytest.raises(ValueError):
            array[...] = 0


def test_arrays_outlive_what_they_look_into():
    values = small_frame().values
    expected = values.copy()
    [small_frame(seed=seed) for seed in range(20)]
    assert np.array_equal(values, expected)


def test_samples_are_kept_or_handed_over():
    samples = small_frame()
    before = samples.values.copy()
    image = rpf.filter(samples, "fast", "cpu")
    assert np.array_equal(samples.values, before)
    view = samples["R"]
    again = rpf.filter(samples, "fast", "cpu", keep=False)  # an array looks into them: a copy
    assert np.array_equal(view, before[:, samples.slots.index("R")])
    del view
    last = rpf.filter(samples, "fast", "cpu", keep=False)
    assert np.array_equal(image.pixels, again.pixels) and np.array_equal(image.pixels, last.pixels)
    with pytest.raises(rpf.UsageError, match="handed over"):
        samples.values


def test_handing_over_takes_no_second_copy():
    """Peak memory of a process that filters 100 MB of samples: with a copy it would have them twice."""
    code = """if True:
        import re, numpy as np, rpf
        peak = lambda: 1024 * int(re.search(r"VmHWM:\\s+(\\d+)", open("/proc/self/status").read()).group(1))
        n = 512 * 512 * 8
        y, x = np.repeat(np.indices((512, 512), np.float32).reshape(2, -1), 8, axis=1) + np.float32(0.5)
        samples = rpf.Samples.from_channels(np.full((512, 512), 8), {**{f"feature.{k}": x for k in "abcdefgh"}, "R": x, "G": x, "B": x, "film.X": x, "film.Y": y})
        settings = rpf.Settings()
        settings.box_widths, settings.features, settings.random = [], [], []
        before = peak()
        rpf.filter(samples, settings=settings, keep=KEEP)
        print((peak() - before) / (n * 13 * 4))"""
    handed, kept = (float(subprocess.run([sys.executable, "-c", code.replace("KEEP", keep)], check=True, stdout=subprocess.PIPE, text=True).stdout)
                    for keep in ("False", "True"))
    assert handed < kept - 0.7


def resident():
    return int(Path("/proc/self/statm").read_text().split()[1]) * resource.getpagesize()


def test_hundred_calls_do_not_grow():
    samples = small_frame(48, 32, 8)
    for _ in range(10):
        rpf.filter(samples, "fast", "cpu").pixels
    before = resident()
    for _ in range(100):
        image = rpf.filter(samples, "fast", "cpu")
        image.pixels, samples.values, samples["G"], image.metadata, image.report.notes
        with pytest.raises(rpf.UsageError):
            rpf.filter(samples, "none")
    assert resident() - before < 20 * samples.values.nbytes  # a leak of the samples alone would be 100 times that


# ---- files --------------------------------------------------------------------------------------------------------------

@pytest.mark.parametrize("ending", ["exr", "rpf"])
def test_files_keep_everything(tmp_path, ending):
    samples = small_frame(origin=(-3, 5), display_window=(0, 0, 20, 20), metadata={"rpf:seed": 7, "a": 0.5, "title": "t", "m": [1.0, 2.0]})
    rpf.write(tmp_path / f"a.{ending}", samples)
    again = rpf.read(tmp_path / f"a.{ending}")
    assert again.window == (-3, 5, 12, 8) == samples.window
    assert set(again.slots) == set(samples.slots) and all(np.array_equal(again[slot], samples[slot]) for slot in samples.slots)
    assert again.metadata["rpf:seed"] == 7 and again.metadata["a"] == 0.5 and again.metadata["title"] == "t"
    some = rpf.read(tmp_path / f"a.{ending}", slots=["R", "G", "B", "film.X", "film.Y"])
    assert set(some.slots) == {"R", "G", "B", "film.X", "film.Y"}


def test_counts_may_vary():
    counts = np.array([[1, 0], [3, 2]], np.uint32)
    values = np.zeros((6, 5), np.float32)
    samples = rpf.Samples(counts, ["R", "G", "B", "film.X", "film.Y"], values)
    assert list(samples.first_sample) == [0, 1, 1, 4, 6] and len(samples) == 6
    assert any("film" in note for note in samples.check())


# ---- errors -------------------------------------------------------------------------------------------------------------

def test_errors_have_the_kinds_of_exit_codes(tmp_path):
    samples = small_frame()
    cases = [(rpf.UsageError, 2, lambda: rpf.filter(samples, "best")), (rpf.UsageError, 2, lambda: rpf.filter(samples, "fast", profile="paper")),
             (rpf.InputError, 3, lambda: rpf.read(tmp_path / "none.exr")), (rpf.OutputError, 4, lambda: rpf.write(tmp_path / "no/a.exr", samples)),
             (rpf.MemoryLimitError, 6, lambda: rpf.filter(samples, max_memory=1)),
             (rpf.Cancelled, 130, lambda: rpf.filter(samples, progress=lambda now: False))]
    for kind, code, call in cases:
        with pytest.raises(kind) as caught:
            call()
        assert caught.value.exit_code == code and isinstance(caught.value, rpf.Error) and len(str(caught.value)) > 10
    with pytest.raises(OSError):
        rpf.write(tmp_path / "no/a.exr", samples)


@pytest.mark.parametrize("broken, words", [
    (lambda: rpf.Samples(np.ones((2, 2), np.uint32), ["R"], np.zeros((4, 2), np.float32)), "2 columns"),
    (lambda: rpf.Samples(np.ones((2, 2), np.uint32), ["R"], np.zeros((5, 1), np.float32)), "5 samples"),
    (lambda: rpf.Samples(np.ones((2, 2), np.uint32), ["R"], np.zeros((4, 1), np.float32)), "\"?G"),
    (lambda: rpf.Image(np.zeros((2, 2, 3), np.float32), ["R"]), "3 channels")])
def test_arrays_that_do_not_fit_are_refused(broken, words):
    with pytest.raises(rpf.InputError, match=words):
        broken()


def test_missing_slot_is_a_key_error():
    with pytest.raises(KeyError):
        small_frame()["feature.N.X"]


# ---- running ------------------------------------------------------------------------------------------------------------

LONG = """if True:
    import numpy as np, rpf, sys
    y, x = np.repeat(np.indices((200, 200)).reshape(2, -1), 8, axis=1) + 0.5
    light = np.random.default_rng(1).random(x.size)
    samples = rpf.Samples.from_channels(np.full((200, 200), 8), {"R": light, "G": light, "B": light, "film.X": x, "film.Y": y, "random.lens.U": light})
    print("started", flush=True)
    try:
        rpf.filter(samples, profile="paper", backend=sys.argv[1])
    except KeyboardInterrupt:
        print("stopped", flush=True)"""


@pytest.mark.parametrize("backend", ["cpu", "opencl"])
def test_control_c_stops_within_two_seconds(backend):
    if backend == "opencl" and not rpf.devices():
        pytest.skip("no OpenCL device")
    with subprocess.Popen([sys.executable, "-c", LONG, backend], stdout=subprocess.PIPE, text=True) as child:
        assert child.stdout.readline() == "started\n"
        time.sleep(1)
        since = time.monotonic()
        child.send_signal(signal.SIGINT)
        assert child.stdout.readline() == "stopped\n"
        assert time.monotonic() - since < 2


def test_other_threads_run_meanwhile():
    samples, counted, done = small_frame(64, 64, 8), [0], threading.Event()

    def count():
        while not done.is_set():
            counted[0] += 1
            time.sleep(0)

    thread = threading.Thread(target=count)
    thread.start()
    before = counted[0]
    rpf.filter(samples, profile="thesis", backend="cpu", threads=1)
    after = counted[0]
    done.set()
    thread.join()
    assert after > before + 100


def test_progress_is_told_and_what_it_raises_comes_out():
    told = []
    rpf.filter(small_frame(), profile="thesis", progress=told.append)
    assert told[-1].fraction == 1 and told[-1].passes == 4
    with pytest.raises(ZeroDivisionError):
        rpf.filter(small_frame(), progress=lambda now: 1 / 0)


def test_a_bar_where_tqdm_is_installed(monkeypatch):
    bars = []

    class Bar:
        def __init__(self, **options):
            self.n, self.options = 0, options
            bars.append(self)

        def update(self, more):
            self.n += more

        __enter__ = lambda self: self
        __exit__ = lambda self, *_: None

    module = type(sys)("tqdm.auto")
    module.tqdm = Bar
    monkeypatch.setitem(sys.modules, "tqdm", type(sys)("tqdm"))
    monkeypatch.setitem(sys.modules, "tqdm.auto", module)
    rpf.filter(small_frame(), "fast")
    rpf.filter(small_frame(), "fast", progress=False)
    assert [bar.n for bar in bars] == [100]


def test_settings_are_those_of_the_command():
    settings = rpf.Settings()
    settings.box_widths, settings.crop, settings.backend = [7], (2, 1, 5, 4), "cpu"
    image = rpf.filter(small_frame(), settings=settings)
    assert image.window == (2, 1, 5, 4) and image.pixels.shape == (4, 5, 3)
    assert settings.max_memory == 0 and image.report.passes[0].box_width == 7
    with pytest.raises(rpf.UsageError):
        settings.box_widths = [8]
        rpf.filter(small_frame(), settings=settings)


def test_explain():
    explained = rpf.explain(small_frame(), "cpu")
    assert explained.groups == ["lens"] and "share.lens" in explained.layers.channels
    assert explained.layers.pixels.shape == (8, 12, len(explained.layers.channels))


# ---- what it shows ------------------------------------------------------------------------------------------------------

def test_picture_in_a_notebook():
    image = rpf.Image(np.array([[[0, 0.5, 1], [2, -1, np.nan]]], np.float32))
    data = image._repr_png_()
    assert data.startswith(b"\x89PNG\r\n\x1a\n") and data[16:24] == bytes([0, 0, 0, 2, 0, 0, 0, 1])
    start = data.index(b"IDAT") + 4
    rows = zlib.decompress(data[start:start + int.from_bytes(data[start - 8:start - 4], "big")])
    assert list(rows) == [0, 0, 188, 255, 255, 0, 0]  # 0.5 is 188 in sRGB


def test_everything_public_is_there_and_typed():
    for name in rpf.__all__:
        assert getattr(rpf, name) is not None and getattr(rpf, name).__doc__
    package = Path(rpf.__file__).parent
    stub = (package / "_core.pyi").read_text()
    assert (package / "py.typed").exists() and all(re.search(rf"\b(class|def) {name}\b", stub) for name in rpf._COMPILED)
    typed = re.search(r"from \._core import \((.*?)\)", (package / "__init__.py").read_text(), re.S).group(1)
    assert typed.replace(",", " ").split() == rpf._COMPILED
