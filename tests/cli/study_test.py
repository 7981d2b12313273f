"""rpf study as a user runs it, on tiny pictures. Usage: study_test.py RPF PROJECT FOLDER-OF-STAND-IN-DENOISER"""
import json
import os
import re
import shlex
import shutil
import signal
import subprocess
import sys
import time
import unittest
from html.parser import HTMLParser

from command_case import RPF, CommandCase

SIZE = ["--quick", "--size", "16x12"]
STAND_IN = sys.argv[3]
for number in (signal.SIGINT, signal.SIGTERM):  # a shell ignores them for what it starts in the background
    signal.signal(number, signal.SIG_DFL)


def run(*arguments, **keywords):
    return subprocess.run([RPF, "study", *map(str, arguments)], capture_output=True, text=True, check=False, **keywords)


class Addresses(HTMLParser):
    """What a page fetches or leads to, and its ids."""

    def __init__(self, text):
        super().__init__()
        self.links, self.ids, self.tags = [], [], set()
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        self.tags.add(tag)
        for name, value in attributes:
            if name in ("src", "href", "xlink:href", "action", "data"):
                self.links.append(value)
            if name == "id":
                self.ids.append(value)


class StudyTest(CommandCase):
    def setUp(self):
        super().setUp()
        self.study = self.folder / "study"
        self.results = self.study / "features.runs.jsonl"

    def features(self, *more):
        return run("features", "-o", self.study, *SIZE, *more)

    def page(self, name):
        return (self.study / f"{name}.html").read_text(encoding="utf-8")

    def json(self, name):
        def refuse(word):
            self.fail(f"{word} is no JSON")
        return json.loads((self.study / f"{name}.json").read_text(encoding="utf-8"), parse_constant=refuse)

    def expect_whole(self, name, standalone=True):
        """Nothing is fetched, and nothing is there twice."""
        text = self.page(name)
        page = Addresses(text)
        for link in page.links:
            self.assertRegex(link, r"^(data:image/(png|jpeg);base64,[A-Za-z0-9+/=]+|#[\w-]+)$" if standalone else r"^[\w-]+\.html$")
            if link.startswith("#"):
                self.assertIn(link[1:], page.ids)
        self.assertEqual(len(page.ids), len(set(page.ids)))
        self.assertFalse(page.tags & {"script", "link", "iframe", "object"})
        self.assertIsNone(re.search(r"https?:|file://|@import|url\(", re.sub(r"base64,[A-Za-z0-9+/=]+", "", text)))
        self.assertNotIn(str(self.folder), text)
        return page

    # ---- what there is

    def test_without_a_name_they_are_listed(self):
        names = ("passes", "features", "effects", "methods", "textures", "spp", "thesis-vs-paper", "contemporaries", "all")
        self.expect(run(), 0, *names)
        self.expect(run("--help"), 0, *names)

    def test_wrong_usage_is_named_before_anything_is_made(self):
        self.expect(run("no-such", "-o", self.study), 2, "no-such", "passes")
        self.expect(run("features"), 2, "-o")
        self.expect(run("features", "-o", self.study, "--size", "16"), 2, "--size 16")
        self.assertFalse(self.study.exists())

    def test_without_gnuplot_it_says_what_to_install(self):
        result = run("features", "-o", self.study, *SIZE, env={**os.environ, "PATH": str(self.folder)})
        self.expect(result, 4, "apt-get install gnuplot-nox")
        self.assertFalse(self.study.exists())

    def test_a_folder_that_cannot_be_made(self):
        self.study.write_text("a file")
        self.expect(self.features(), 4, "study")

    # ---- one study

    def test_a_page_carries_everything_it_shows(self):
        self.expect(self.features(), 0, "features.html", "14 runs measured, 0 were there")
        page = self.expect_whole("features")
        self.assertEqual(sum(link.startswith("data:") for link in page.links), 16)  # 7 runs and a reference, two scenes
        document = self.json("features")
        self.assertEqual((document["width"], document["height"], document["quick"]), (16, 12, True))
        self.assertEqual(len(document["runs"]), 14)
        self.assertEqual(len(document["verdicts"]), 5)
        for run_ in document["runs"]:
            self.assertIn(run_["options"], self.page("features"))
        self.assertFalse([file for file in self.study.rglob(".*")], "no temporary file is left")

    def test_every_run_is_repeated_by_its_commands(self):
        self.expect(self.features(), 0)
        run_ = next(r for r in self.json("features")["runs"] if r["label"] == "normals" and r["scene"] == "column")
        *commands, compare = [shlex.split(command) for command in run_["commands"]]
        for command in commands:
            self.assertEqual(command[0], "rpf")
            subprocess.run([RPF, *command[1:]], cwd=self.folder, check=True, capture_output=True)
        compared = subprocess.run([RPF, *compare[1:], "--json"], cwd=self.folder, check=True, capture_output=True, text=True)
        error = json.loads(compared.stdout)["images"][0]
        self.assertEqual([error[k] for k in ("relMSE", "MSE", "FLIP")], [run_["error"][k] for k in ("relMSE", "MSE", "FLIP")])

    def test_it_goes_on_where_it_was_stopped(self):
        self.expect(self.features(), 0)
        whole = self.results.read_bytes().splitlines(keepends=True)
        page = self.page("features")
        self.expect(self.features(), 0, "0 runs measured, 14 were there")
        self.assertEqual(self.page("features"), page)
        self.results.write_bytes(b"".join(whole[:5]) + whole[5][:-9])  # killed while it wrote the sixth line
        self.expect(self.features(), 0, "9 runs measured, 5 were there")
        lines = self.results.read_bytes().splitlines(keepends=True)
        self.assertEqual(lines[:5], whole[:5])
        self.assertEqual({json.loads(line)["key"] for line in lines}, {json.loads(line)["key"] for line in whole})

    def test_another_size_is_another_study(self):
        self.expect(self.features(), 0)
        self.expect(run("features", "-o", self.study, "--quick", "--size", "18x12"), 0, "14 runs measured")

    def test_a_signal_ends_it_cleanly(self):
        process = subprocess.Popen([RPF, "study", "passes", "-o", self.study, "--size", "64x36"], stderr=subprocess.PIPE)
        results = self.study / "passes.runs.jsonl"
        while not results.exists() or results.read_bytes().count(b"\n") < 2:
            self.assertIsNone(process.poll())
            time.sleep(0.01)
        process.send_signal(signal.SIGINT)
        self.assertIn(b"the same command goes on from there", process.communicate()[1])
        self.assertEqual(process.returncode, 130)
        self.assertFalse((self.study / "passes.html").exists())
        self.assertFalse([file for file in self.study.rglob(".*")], "no temporary file is left")
        for line in results.read_text().splitlines():
            json.loads(line)

    def test_what_is_not_its_results_stays(self):
        self.study.mkdir()
        self.results.write_text("my notes")
        self.expect(self.features(), 3, "no result of rpf bench sweep or rpf study")
        self.assertEqual(self.results.read_text(), "my notes")
        self.results.write_text("")
        self.results.chmod(0o444)
        self.expect(self.features(), 4, "write-protected")
        self.results.unlink()
        os.mkfifo(self.results)
        self.expect(self.features(), 4, "a pipe or socket")

    def test_targets_are_checked_before_the_work(self):
        def spoil(path, kind):
            path.parent.mkdir()
            if kind == "folder":
                path.mkdir()
            elif kind == "pipe":
                os.mkfifo(path)
            else:
                path.write_text("")
                path.chmod(0o444)
        for name, kind, text in (("features.html", "protected", "write-protected"), ("features.html", "folder", "a folder"),
                                 ("features.json", "protected", "write-protected"), ("features.json", "pipe", "a pipe"),
                                 ("features.runs.jsonl", "folder", "a folder"), ("features.pictures", "file", "features.pictures"),
                                 ("images", "file", "images"), ("scenes", "file", "scenes"), ("index.html", "pipe", "a pipe")):
            spoil(self.study / name, kind)
            self.expect(run("all" if name == "index.html" else "features", "-o", self.study, *SIZE), 4, text)
            self.assertEqual([path.name for path in self.study.iterdir()], [name])
            shutil.rmtree(self.study)

    # ---- contemporaries

    def contemporaries(self, libraries=""):
        return run("contemporaries", "-o", self.study, *SIZE, env={**os.environ, "LD_LIBRARY_PATH": libraries})

    def test_contemporaries_with_open_image_denoise_and_without(self):
        self.expect(self.contemporaries(STAND_IN), 0, "74 runs measured, 0 were there")
        self.expect_whole("contemporaries")
        document = self.json("contemporaries")
        self.assertEqual(len(document["verdicts"]), 21)
        for verdict in document["verdicts"]:
            self.assertRegex(verdict["measured"], r"at [\d, ]+ samples: (dof|soft-shadow) [\d.]+")
            self.assertIn("hold", verdict["verdict"])
        denoised = [r for r in document["runs"] if r["label"] == "Open Image Denoise"]
        self.assertEqual([round(r["energy"], 6) for r in denoised], [0.5] * 4)
        self.assertEqual(len({r["label"] for r in document["runs"]}), 13 + 3 + 5)
        self.expect(self.contemporaries(), 0, "0 runs measured, 70 were there")
        self.assertIn("Open Image Denoise was not found", self.page("contemporaries"))
        self.assertEqual(len(self.json("contemporaries")["verdicts"]), 20)

    def expect_verdict(self, document, words, ratios, limit=1):
        """ratios: {scene: [at 4, 16 samples]}, worked out from the runs"""
        told = next(v for v in document["verdicts"] if words in v["statement"])
        measured = "; ".join(f"{scene} {', '.join(f'{r:.3g}' for r in of)}" for scene, of in ratios.items())
        self.assertTrue(told["measured"].endswith(": " + measured), told)
        values = [r for of in ratios.values() for r in of]
        holding = sum(r < limit for r in values)
        verdict = {0: "does not hold", len(values): "holds"}.get(holding, f"holds on {holding} of {len(values)} frames")
        self.assertEqual(told["verdict"], verdict, told)

    def test_verdicts_follow_from_the_runs(self):
        self.expect(self.contemporaries(STAND_IN), 0)
        document = self.json("contemporaries")
        runs = document["runs"]

        def frame(r):
            return r["scene"], re.search(r"-(\d+)spp", r["commands"][0])[1]

        def ratios(label, others, key="relMSE"):
            found = {}
            for r in (r for r in runs if r["label"] == label):
                least = min(o["error"][key] for o in runs if o["label"] in others and frame(o) == frame(r))
                found.setdefault(r["scene"], []).append(r["error"][key] / least)
            return found

        best = {r["label"] for r in runs if "--preset" not in r["options"] and "Denoise" not in r["label"] and "adaptive" not in r["label"]}
        self.expect_verdict(document, "gem (Rousselle", ratios("gem", ["Gaussian"]))
        self.expect_verdict(document, "paper (Sen", ratios("paper", ["plain mean"]), 0.25)
        self.expect_verdict(document, "the error of sbf", ratios("sbf, adaptive", ["sbf"], "trimmed_relMSE"))
        self.expect_verdict(document, "balanced is better", ratios("balanced", best))
        told = next(v for v in document["verdicts"] if "in a penumbra" in v["statement"])
        parts = [float(text) for text in re.findall(r"\d\.\d+", told["measured"].split("samples:")[1])]
        self.assertTrue(0.25 < min(parts) < 1, told)  # less noise, but not what four times the samples bring
        self.assertEqual(told["verdict"], "does not hold")

    def test_adaptive_runs_are_repeated_by_their_commands(self):
        self.expect(self.contemporaries(), 0)
        run_ = next(r for r in self.json("contemporaries")["runs"] if r["label"] == "nlm, adaptive" and r["scene"] == "dof")
        *commands, compare = [shlex.split(command.replace("-- rpf", f"-- '{RPF}'")) for command in run_["commands"]]
        for command in commands:
            subprocess.run([RPF, *command[1:]], cwd=self.folder, check=True, capture_output=True)
        compared = subprocess.run([RPF, *compare[1:], "--json"], cwd=self.folder, check=True, capture_output=True, text=True)
        self.assertEqual(json.loads(compared.stdout)["images"][0]["relMSE"], run_["error"]["relMSE"])

    # ---- all of them

    def test_all_of_them(self):
        self.expect(run("all", "-o", self.study, *SIZE), 0, "index.html")
        links = self.expect_whole("index", standalone=False).links
        self.assertEqual(len(links), 8)
        for link in links:
            name = link.removesuffix(".html")
            self.expect_whole(name)
            self.assertGreater(len(self.json(name)["runs"]), 0)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
