"""The gallery as one HTML file: every picture with its text and its commands, and the computed
values under the pointer.

Nothing is loaded from elsewhere: pictures and values are embedded in the file. The folder page
contains its parts: texts in figures.toml, templates, style and script."""

import base64
import dataclasses
import html
import json
import pathlib
import shlex
import string
import tomllib

from packed_spectrum import FIELDS, LEAST_EXPONENT, STEPS, UNKNOWN, PackedSpectrum
from PIL import Image
from overturn.regions import LEFT_STANDING, NOT_COMPUTED, REGIONS
from overturn.result_file import PANELS

PARTS = pathlib.Path(__file__).resolve().parent / "page"
LINE = 88  # characters of a command
READOUT = '<p class="readout" aria-live="polite"></p>'


@dataclasses.dataclass
class Drawn:
    """One figure: its file and the commands that create it."""

    name: str
    commands: list
    spectrum: str  # whose points it shows; empty if none


class Page:
    """Collects figures and arranges them in the order of the paper."""

    def __init__(self, folder):
        self.folder = folder
        self.figures = {}
        self.spectra = {}

    def add_spectrum(self, job, path):
        self.spectra[job] = PackedSpectrum(path)

    def add_figure(self, number, name, commands, result):
        """Adds a figure plotted from `result`, which may be the file of a spectrum."""
        job = pathlib.Path(result).stem
        self.figures[number] = Drawn(name, commands, job if job in self.spectra else "")

    @staticmethod
    def is_own(beginning):
        return b"<title>Rocking of rigid blocks: the computed figures</title>" in beginning

    def text(self):
        words = tomllib.loads(part("figures.toml"))["section"]
        some = next(iter(self.spectra.values()))
        return template("page.html").substitute(
            style=part("page.css"), script=part("page.js"),
            contents="\n".join(map(contents, words)),
            sections="\n".join(map(self.section, words)), legend=legend(),
            constants=json.dumps(constants()), data="\n".join(map(self.data, self.spectra)),
            columns=some.columns, rows=some.rows, source=html.escape(some.source))

    def section(self, words):
        return template("section.html").substitute(
            anchor=anchor(words["title"]), title=words["title"], words=words["words"],
            figures="\n".join(map(self.figure, words["figure"])))

    def figure(self, words):
        drawn = self.figures[words["number"]]
        path = self.folder / f"{drawn.name}.png"
        with Image.open(path) as picture:
            width, height = picture.size
            places = picture.text.get(PANELS, "[]") if drawn.spectrum else ""
        return template("figure.html").substitute(
            anchor=anchor("figure " + words["number"]), name=drawn.name, number=words["number"],
            plural=plural(words["number"]), title=words["title"], words=words["words"],
            here=here(words), alternative=html.escape(words["alternative"]), width=width,
            height=height, shape=" wide" * (width > 2 * height), live=live(drawn.spectrum, places),
            readout=READOUT * bool(drawn.spectrum),
            picture=base64.b64encode(path.read_bytes()).decode(),
            commands=html.escape("\n".join(map(typed, drawn.commands))))

    def data(self, job):
        spectrum = self.spectra[job]
        return (f'<script type="application/octet-stream" id="data_{job}" '
                f'data-columns="{spectrum.columns}" data-rows="{spectrum.rows}">'
                f"{spectrum.text}</script>")


def part(name):
    return (PARTS / name).read_text(encoding="utf-8")


def template(name):
    return string.Template(part(name))


def plural(number):
    return "s" * (" and " in number)


def anchor(title):
    return title.lower().replace(" ", "_")


def contents(words):
    figures = "".join(
        f'<li><a href="#{anchor("figure " + figure["number"])}"><b>{figure["number"]}</b> '
        f'{figure["short"]}</a></li>' for figure in words["figure"])
    return f'<h2><a href="#{anchor(words["title"])}">{words["title"]}</a></h2><ul>{figures}</ul>'


def here(words):
    """Returns the paragraph on differences from the paper."""
    return f'<p class="here"><b>Here:</b> {words["here"]}</p>' if "here" in words else ""


def live(spectrum, places):
    """Returns the attributes that make a picture interactive."""
    if not spectrum:
        return ""
    return (f' tabindex="0" role="application" aria-label="Points of the spectrum: arrow keys move '
            f'the ring" data-spectrum="{spectrum}" data-places="{html.escape(places)}"')


def legend():
    """Returns the legend of all regions, shown above the figures."""
    return "".join(
        f'<li><i class="swatch" style="background:{colour}"></i><b>{name}</b> {meaning}</li>'
        for name, meaning, colour in REGIONS.values() if name)


def constants():
    """Returns the constants that the page needs to read packed spectra."""
    return {"fields": FIELDS, "unknown": UNKNOWN, "leastExponent": LEAST_EXPONENT, "steps": STEPS,
            "leftStanding": LEFT_STANDING,
            "regions": REGIONS | {NOT_COMPUTED: ("", "not computed yet", "#ffffff")}}


def typed(command):
    """Returns a command wrapped at LINE characters. All commands end with -o OUTPUT."""
    *words, option, output = map(shlex.quote, command)
    lines = [""]
    for word in (*words, f"{option} {output}"):
        if lines[-1] and len(lines[-1]) + len(word) > LINE:
            lines[-1] += " \\"
            lines.append("   ")
        lines[-1] += " " * bool(lines[-1]) + word
    return "\n".join(lines)
