"""The page of tools/paper/gallery in a browser: its contents and its readout of points.

Requires OVERTURN (the binary) in the environment, and CHROMIUM, if it is not chromium on the PATH.
PICTURES is the folder of a gallery at 60 x 60 points left by gallery_test.py; without it one is
created.
"""

import json
import math
import os
import pathlib
import random
import subprocess
import tempfile
import unittest

from PIL import Image

from browser import Browser, Failure
from gallery_test import FIGURES, OVERTURN
from page_words import COLOURS, LEFT_STANDING, POINTS, Spectrum
from tool import TOOLS, run_tool

CHECKOUT = TOOLS.parent
PANELS = "overturn:panels"
HINT = "Move over the spectrum, tap it, or use the arrow keys."
SPECTRA = {"07a": "7b_and_8", "14b": "15b"}  # and the figures of their end states


class TestThePage(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="overturn-test-")
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        cls.pictures = pathlib.Path(os.environ.get("PICTURES", cls.folder / "pictures"))
        if "PICTURES" not in os.environ:
            run_tool("paper/gallery", "-o", cls.pictures, "--points", str(POINTS), "--page",
                     check=True, timeout=280)
        cls.spectra = {figure: Spectrum(figure, cls.folder) for figure in SPECTRA}
        cls.browser = Browser(1280, 1000)
        cls.addClassCleanup(cls.browser.close)

    def setUp(self):
        self.browser.open(self.pictures / "index.html")
        self.browser.events.clear()

    # Actions of a reader.

    def look_at(self, figure):
        """Scrolls to the picture of a figure; returns its box and reads its panels."""
        self.figure = f"document.getElementById('figure_{figure}')"
        self.picture = f"{self.figure}.querySelector('.picture')"
        self.browser.evaluate(f"{self.picture}.scrollIntoView({{block: 'center'}})")
        box = self.browser.evaluate(f"{self.picture}.getBoundingClientRect().toJSON()")
        self.assertGreater(box["top"], 0)
        self.assertLess(box["bottom"], 1000 - 80)  # the readout is below it
        path = self.pictures / self.browser.evaluate(
            f"{self.figure}.querySelector('.files a').getAttribute('href')")
        self.image = Image.open(path)
        self.panels = json.loads(self.image.text[PANELS])
        self.image = self.image.convert("RGB")
        return box

    def place_of_cell(self, row, column, aside=0.0):
        """Returns the position in fractions of the picture; aside is in cells."""
        panel = self.panels[0]
        across, up = (column + 0.5 + aside) / POINTS, (row + 0.5 + aside) / POINTS
        return (panel["left"] + across * (panel["right"] - panel["left"]),
                panel["bottom"] + up * (panel["top"] - panel["bottom"]))

    def move_to(self, box, place):
        self.browser.move(box["x"] + place[0] * box["width"], box["y"] + place[1] * box["height"])

    def colour_at(self, place):
        return self.image.getpixel((int(place[0] * self.image.width),
                                    int(place[1] * self.image.height)))

    def assert_shows(self, words):
        """Waits for the readout: it follows the event, after the spectrum is unpacked."""
        readout = f"{self.figure}.querySelector('.readout').textContent"
        try:
            self.browser.wait(f"{readout} === {json.dumps(words)}", patience=10)
        except Failure:
            self.assertEqual(self.browser.evaluate(readout), words)

    def marks(self):
        return self.browser.evaluate(
            f"[...{self.figure}.querySelectorAll('.mark')].map((mark) => "
            "[parseFloat(mark.style.left) / 100, parseFloat(mark.style.top) / 100])")

    # Behaviour of the page.

    def test_shows_every_figure_with_words_files_and_commands(self):
        figures = self.browser.evaluate("""[...document.querySelectorAll("article")].map((one) => ({
            title: one.querySelector("h3").innerText, words: one.querySelector("p").innerText,
            width: one.querySelector("img").naturalWidth, alt: one.querySelector("img").alt,
            files: [...one.querySelectorAll(".files a")].map((link) => link.getAttribute("href")),
            commands: one.querySelector("pre").innerText }))""")
        self.assertEqual(sorted(f"figure_{figure}.png" for figure in FIGURES),
                         [figure["files"][0] for figure in figures])
        for figure in figures:
            with self.subTest(figure["title"]):
                self.assertRegex(figure["title"], r"^Figures? \d")
                self.assertGreater(len(figure["words"]), 80)
                self.assertGreater(len(figure["alt"]), 40)
                self.assertGreater(figure["width"], 900)
                for file in figure["files"]:
                    self.assertTrue((self.pictures / file).is_file())
                self.assertIn("tools/plot_", figure["commands"])
                self.assertTrue(figure["commands"].endswith(f"-o {figure['files'][0]}"))

    def test_fits_into_a_narrow_window(self):
        self.browser.resize(420, 800)
        self.addCleanup(self.browser.resize, 1280, 1000)
        self.assertLessEqual(self.browser.evaluate("document.documentElement.scrollWidth"), 420)

    def test_prints_every_picture_whole(self):
        self.browser.resize(794, 1123)  # A4
        self.addCleanup(self.browser.resize, 1280, 1000)
        self.browser.ask("Emulation.setEmulatedMedia", media="print")
        self.addCleanup(self.browser.ask, "Emulation.setEmulatedMedia", media="")
        widest = self.browser.evaluate("""Math.max(...[...document.querySelectorAll("img")]
            .map((picture) => picture.getBoundingClientRect().right))""")
        self.assertLessEqual(widest, 794)

    def test_links_its_contents_to_every_figure(self):
        lost = self.browser.evaluate("""[...document.querySelectorAll("nav a")]
            .filter((link) => !document.querySelector(link.getAttribute("href"))).length""")
        self.assertEqual(lost, 0)

    def test_loads_no_other_file_and_logs_no_error(self):
        self.browser.open(self.pictures / "index.html")
        for figure in ("7a", *SPECTRA.values()):
            box = self.look_at(figure)
            self.move_to(box, self.place_of_cell(30, 30))
            self.browser.wait(f"{self.figure}.querySelector('.mark')")
        page = (self.pictures / "index.html").resolve().as_uri()
        asked = [event["request"]["url"] for event in
                 self.browser.events["Network.requestWillBeSent"]]
        self.assertIn(page, asked)
        self.assertEqual([url[:200] for url in asked
                          if url != page and not url.startswith("data:")], [])
        for event in ("Runtime.exceptionThrown", "Runtime.consoleAPICalled", "Log.entryAdded"):
            self.assertEqual(self.browser.events[event], [])

    def test_shows_the_values_of_the_point_under_the_pointer(self):
        for figure, spectrum in self.spectra.items():
            box = self.look_at(figure.lstrip("0"))
            for point in spectrum.one_of_each_region():
                with self.subTest(figure, point=point):
                    self.move_to(box, self.place_of_cell(*point))
                    self.assert_shows(spectrum.words(*point))

    def test_shows_the_region_whose_colour_is_under_the_pointer(self):
        draw = random.Random(1)
        for figure, spectrum in self.spectra.items():
            box = self.look_at(figure.lstrip("0"))
            coloured = 0
            for point in draw.sample(spectrum.borders(), 60):
                place = self.place_of_cell(*point, aside=draw.choice((-0.4, 0.4)))
                self.move_to(box, place)
                self.assert_shows(spectrum.words(*point))
                colour = self.colour_at(place)
                if colour in COLOURS.values():  # no label covers it
                    self.assertEqual(colour, COLOURS[spectrum.region[point]])
                    coloured += 1
            self.assertGreater(coloured, 50)

    def test_marks_the_end_state_of_the_point(self):
        draw = random.Random(2)
        for figure, landing in SPECTRA.items():
            spectrum = self.spectra[figure]
            box = self.look_at(landing)
            seen = marked = 0
            for _ in range(60):
                point = draw.randrange(POINTS), draw.randrange(POINTS)
                self.move_to(box, self.place_of_cell(*point))
                self.assert_shows(spectrum.words(*point))
                on_the_plane, *landed = self.marks()
                for mark, wanted in zip(on_the_plane, self.place_of_cell(*point)):
                    self.assertAlmostEqual(mark, wanted, delta=1e-5)
                if spectrum.region[point] > LEFT_STANDING:
                    self.assertEqual(landed, [])
                    continue
                self.assertIn(len(landed), (1, 2))
                # The full view contains all end states. Few share a pixel there, and it has the
                # colour of the point, unless a line or a name covers it.
                own = (255 * (point[1] + 0.5) / POINTS, 0, 255 * (point[0] + 0.5) / POINTS)
                marked += 1
                seen += any(math.dist(self.colour_at(self.beside(landed[-1], dx, dy)), own) < 12
                            for dx in range(-3, 4) for dy in range(-3, 4))
            self.assertGreater(marked, 25)
            self.assertGreater(seen, 0.6 * marked)

    def beside(self, place, dx, dy):
        return place[0] + dx / self.image.width, place[1] + dy / self.image.height

    def test_marks_the_point_of_a_spectrum_in_its_end_state_picture_too(self):
        box = self.look_at("7a")
        self.move_to(box, self.place_of_cell(30, 30))
        self.assert_shows(self.spectra["07a"].words(30, 30))
        self.assertEqual(len(self.marks()), 1)
        self.figure = "document.getElementById('figure_7b_and_8')"
        self.assertEqual(len(self.marks()), 3)

    def test_shows_no_point_outside_of_the_axes(self):
        box = self.look_at("7a")
        inside = self.spectra["07a"].words(30, 30)
        panel = self.panels[0]
        for place in ((panel["left"] - 0.01, 0.5), (panel["right"] + 0.01, 0.5),
                      (0.4, panel["top"] - 0.01), (0.4, panel["bottom"] + 0.01), (-0.05, 0.5)):
            self.move_to(box, self.place_of_cell(30, 30))
            self.assert_shows(inside)
            self.move_to(box, place)
            self.assert_shows(HINT)
            self.assertEqual(self.marks(), [])

    def test_keeps_the_point_of_a_click_or_a_tap_until_escape(self):
        spectrum = self.spectra["07a"]
        box = self.look_at("7a")
        clicked, tapped, other = (20, 30), (25, 10), (40, 50)
        place = self.place_of_cell(*clicked)
        self.browser.click(box["x"] + place[0] * box["width"], box["y"] + place[1] * box["height"])
        self.assert_shows(spectrum.words(*clicked))
        self.move_to(box, self.place_of_cell(*other))
        self.assert_shows(spectrum.words(*other))
        self.move_to(box, (-0.05, 0.5))
        self.assert_shows(spectrum.words(*clicked))
        place = self.place_of_cell(*tapped)
        self.browser.tap(box["x"] + place[0] * box["width"], box["y"] + place[1] * box["height"])
        self.assert_shows(spectrum.words(*tapped))
        self.browser.press("Escape")
        self.assert_shows(HINT)

    def test_arrow_keys_move_by_one_point_and_not_beyond_the_edge(self):
        spectrum = self.spectra["07a"]
        self.look_at("7a")
        self.browser.evaluate(f"{self.picture}.focus()")
        self.browser.press("ArrowUp")
        row = column = POINTS // 2
        self.assert_shows(spectrum.words(row, column))
        for key, shift, rows, columns in (
                ("ArrowRight", False, 0, 1), ("ArrowUp", False, 1, 0), ("ArrowLeft", False, 0, -1),
                ("ArrowDown", False, -1, 0), ("ArrowRight", True, 0, 10), ("ArrowUp", True, 10, 0),
                ("ArrowUp", True, 10, 0), ("ArrowUp", True, 9, 0), ("ArrowUp", False, 0, 0)):
            self.browser.press(key, shift)
            row, column = row + rows, column + columns
            self.assert_shows(spectrum.words(row, column))
        self.assertEqual(row, POINTS - 1)

    def test_commands_create_the_picture_above_them(self):
        checkout = self.folder / "checkout"
        (checkout / "build").mkdir(parents=True)
        (checkout / "build" / "overturn").symlink_to(pathlib.Path(OVERTURN).resolve())
        for name in ("jobs", "tools"):
            (checkout / name).symlink_to(CHECKOUT / name)
        for figure in ("5", "7a", "7b_and_8"):
            with self.subTest(figure):
                commands = self.browser.evaluate(
                    f"document.querySelector('#figure_{figure} pre').innerText")
                run = subprocess.run(["bash", "-e", "-c", commands], cwd=checkout, timeout=100,
                                     capture_output=True, text=True, stdin=subprocess.DEVNULL,
                                     env=os.environ | {"OMPI_MCA_rmaps_base_oversubscribe": "1"})
                self.assertEqual(run.returncode, 0, run.stderr)
                name = commands.split()[-1]
                self.assertEqual((checkout / name).read_bytes(),
                                 (self.pictures / name).read_bytes())


if __name__ == "__main__":
    unittest.main()
