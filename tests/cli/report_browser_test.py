"""The page of rpf report in headless Chromium; skipped without one. Usage: report_browser_test.py RPF PROJECT [SCREENSHOTS]"""
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from browser import PROGRAM, Browser
from command_case import RPF
from report_page import exr_values

WIDTH, HEIGHT = 96, 54


def run(*arguments):
    subprocess.run([RPF, *map(str, arguments), "-q"], check=True)


class ReportBrowserTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.place = tempfile.TemporaryDirectory(prefix="rpf browser test ü ")
        cls.folder = Path(cls.place.name)
        samples, cls.output, reference, cls.page = (cls.folder / name for name in ("in.samples.exr", "out.exr", "reference.exr", "page.html"))
        run("scene", "combined", "--size", f"{WIDTH}x{HEIGHT}", "-o", samples)
        run("scene", "combined", "--size", f"{WIDTH}x{HEIGHT}", "--reference", "16", "-o", reference)
        run(samples, "-o", cls.output, "--preset", "fast")
        run("report", samples, cls.output, reference, "-o", cls.page)
        cls.values = exr_values(cls.output)
        cls.browser = Browser().__enter__()

    @classmethod
    def tearDownClass(cls):
        cls.browser.__exit__()
        cls.place.cleanup()

    def setUp(self):
        self.open(1280)

    def open(self, width, scheme="light", mobile=False):
        self.browser.resize(width, mobile=mobile)
        self.browser.scheme(scheme)
        self.browser.call("Page.navigate", url=self.page.as_uri())
        self.browser.wait_for("document.readyState === 'complete' && document.querySelector('#viewer-stage').dataset.ready")
        self.settle()
        self.box = self.browser.evaluate("(({x, y, width, height}) => ({x, y, width, height}))(document.querySelector('#viewer-stage').getBoundingClientRect())")

    def settle(self):
        """What events have changed is drawn: it is by the second frame after them."""
        self.browser.evaluate("new Promise(done => requestAnimationFrame(() => requestAnimationFrame(() => done(true))))")

    def text(self, name):
        self.settle()
        return self.browser.evaluate(f"document.querySelector('#viewer-{name}').textContent")

    def at(self, x, y):
        """The place of the middle of a pixel, while the whole frame is shown."""
        return self.box["x"] + (x + 0.5) * self.box["width"] / WIDTH, self.box["y"] + (y + 0.5) * self.box["height"] / HEIGHT

    def told(self, layer):
        """The numbers below the picture."""
        rows = self.browser.evaluate("[...document.querySelectorAll('#viewer-values tr')].map(tr => [...tr.cells].map(cell => cell.textContent))")
        return next(row[1:] for row in rows if row[0] == layer)

    def color(self, fraction_x, y):
        """What the canvas has at a part of its width, in the middle of a row of pixels."""
        self.settle()
        return self.browser.evaluate(
            f"(canvas => [...canvas.getContext('2d').getImageData(Math.floor({fraction_x} * canvas.width), "
            f"Math.floor({(y + 0.5) / HEIGHT} * canvas.height), 1, 1).data.slice(0, 3)])(document.querySelector('#viewer-canvas'))")

    def split(self):
        self.settle()
        return self.browser.evaluate("parseFloat(document.querySelector('#viewer-divider').style.left) / 100")

    def expect_pixel(self, x, y):
        self.assertEqual(self.text("pixel"), f"Pixel {x}, {y}")
        for told, value in zip(self.told("filtered"), self.values[y, x]):
            self.assertAlmostEqual(float(told), float(value), delta=5.1e-6 * abs(float(value)))

    def test_the_pixel_under_the_cursor_has_the_value_of_the_file(self):
        for x, y in ((0, 0), (17, 30), (63, 41), (WIDTH - 1, HEIGHT - 1)):
            self.browser.mouse("Moved", *self.at(x, y))
            self.expect_pixel(x, y)

    def test_the_line_moves_by_mouse_and_by_slider(self):
        before = self.color(0.3, 40)
        self.browser.drag(self.at(WIDTH / 2 - 0.5, 20), self.at(WIDTH / 4 - 0.5, 20))
        self.assertAlmostEqual(self.split(), 0.25, delta=0.005)
        self.assertNotEqual(self.color(0.3, 40), before)  # now to the right of the line
        self.browser.evaluate("(s => { s.value = 800; s.dispatchEvent(new Event('input')); })(document.querySelector('#viewer-split'))")
        self.assertAlmostEqual(self.split(), 0.8, delta=0.001)
        self.assertEqual(self.color(0.3, 40), before)

    def test_a_pixel_is_drawn_as_its_value_says(self):
        x, y = 70, 41
        shown = self.color((x + 0.5) / WIDTH, y)
        for byte, light in zip(shown, self.values[y, x]):
            light = min(max(float(light), 0), 1)
            self.assertAlmostEqual(byte, 255 * (12.92 * light if light <= 0.0031308 else 1.055 * light ** (1 / 2.4) - 0.055), delta=1)

    def test_exposure_doubles_light(self):
        x, y = 5, 4
        for _ in range(4):
            self.browser.evaluate("document.querySelector('#viewer-stage').focus()")
            self.browser.key("e")
        self.assertEqual(self.text("exposure-text"), "+1.00 stops")
        self.browser.evaluate("document.querySelector('#viewer-left').value = 1; document.querySelector('#viewer-left').onchange()")
        for byte, light in zip(self.color((x + 0.5) / WIDTH, y), self.values[y, x]):
            self.assertAlmostEqual(byte, 255 * (1.055 * min(2 * float(light), 1) ** (1 / 2.4) - 0.055), delta=1)

    def test_keys_move_the_pixel_and_zoom_on_it(self):
        self.browser.mouse("Moved", *self.at(20, 20))
        self.browser.mouse("Moved", 1, 1)
        self.browser.evaluate("document.querySelector('#viewer-stage').focus()")
        for key in ("ArrowRight", "ArrowRight", "ArrowDown", "+", "+"):
            self.browser.key(key)
        self.expect_pixel(22, 21)
        zoomed = float(self.text("zoom-text").split()[0])
        self.browser.key("0")
        self.assertAlmostEqual(zoomed / float(self.text("zoom-text").split()[0]), 4, delta=0.01)

    def test_when_zoomed_the_pixel_under_the_cursor_is_still_the_right_one(self):
        point = self.at(30, 22)
        self.browser.mouse("Moved", *point)
        self.browser.mouse("Wheel", *point, deltaX=0, deltaY=-100, modifiers=2)
        self.browser.mouse("Moved", *point)
        self.expect_pixel(30, 22)
        self.browser.drag(point, (point[0] + 40, point[1] + 10))  # the picture is moved, and the pixel with it
        self.browser.mouse("Moved", point[0] + 40, point[1] + 10)
        self.expect_pixel(30, 22)

    def test_touch_moves_the_line_and_two_fingers_zoom(self):
        self.open(400, mobile=True)
        middle = self.at(WIDTH / 2, 30)
        self.browser.touch("Start", middle)
        for step in range(1, 6):
            self.browser.touch("Move", (middle[0] + 16 * step, middle[1]))
        self.browser.touch("End")
        self.assertAlmostEqual(self.split(), 0.5 + 80 / self.box["width"], delta=0.08)  # a browser keeps the first pixels
        before = float(self.text("zoom-text").split()[0])
        self.browser.touch("Start", (100, middle[1]), (140, middle[1]))
        self.browser.touch("Move", (80, middle[1]), (160, middle[1]))
        self.browser.touch("Move", (60, middle[1]), (180, middle[1]))
        self.browser.touch("End")
        self.assertGreater(float(self.text("zoom-text").split()[0]), 1.5 * before)

    def test_nothing_is_wider_than_the_page(self):
        for width in (400, 1280):
            for scheme in ("light", "dark"):
                with self.subTest((width, scheme)):
                    self.open(width, scheme)
                    self.assertLessEqual(self.browser.evaluate("document.documentElement.scrollWidth"), width)
                    background = self.browser.evaluate("getComputedStyle(document.body).backgroundColor")
                    self.assertEqual(background == "rgb(255, 255, 255)", scheme == "light")
                    if len(sys.argv) > 3:
                        self.browser.screenshot(Path(sys.argv[3]) / f"report-{width}-{scheme}.png", whole=True)

    def test_every_layer_can_be_shown_with_its_legend(self):
        count = self.browser.evaluate("document.querySelectorAll('#viewer-right option').length")
        self.assertEqual(count, 7)
        for number in range(count):
            self.browser.evaluate(f"document.querySelector('#viewer-right').value = {number}; document.querySelector('#viewer-right').onchange()")
            shown = self.text("right-tag")
            legends = self.browser.evaluate("[...document.querySelectorAll('.layer-legend:not([hidden]) b')].map(b => b.textContent)")
            self.assertEqual(legends, [shown] if number >= 3 else [])

    def test_nothing_is_fetched(self):
        self.assertEqual({url.split(":")[0] for url in self.browser.requests} - {"file", "data"}, set())
        self.assertEqual({url for url in self.browser.requests if url.startswith("file")}, {self.page.as_uri()})


if __name__ == "__main__":
    if not PROGRAM:
        print("skipped: no chromium; on Debian apt-get install chromium")
        sys.exit(77)
    unittest.main(argv=sys.argv[:1], verbosity=2)
