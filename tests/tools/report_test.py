"""The page of tools/report.

Requires OVERTURN (the binary) in the environment.
"""

import html.parser
import json
import os
import subprocess
import unittest

from tool import JOBS, InAFolder  # first: adds the package to the path
from overturn import report

TABLE = """name,width,height,friction
vase <of glass>,0.18,0.45,0.2
statue,0.6,1.8,0.7
slim & tall,0.2,1.6,0.7
"""


class Page(html.parser.HTMLParser):
    """The cells of the table, the texts, and what the page would load."""

    def __init__(self, text):
        super().__init__()
        self.rows, self.loads, self.text, self.in_cell = [], [], [], False
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        self.loads += [value for name, value in attrs if name in ("src", "href", "xlink:href") and value[0] != "#"]
        self.loads += [tag] * (tag in ("script", "link", "iframe", "object", "image", "img"))
        if tag == "tr":
            self.rows.append([])
        self.in_cell = tag == "td"
        if self.in_cell:
            self.rows[-1].append("")

    def handle_endtag(self, tag):
        self.in_cell = self.in_cell and tag != "td"

    def handle_data(self, data):
        self.text.append(data)
        if self.in_cell:
            self.rows[-1][-1] += data


class TestReport(InAFolder):
    TOOL = "report"

    def answers(self, *options, table=TABLE):
        (self.folder / "objects.csv").write_text(table)
        found = subprocess.run([os.environ["OVERTURN"], "assess", "objects.csv", "--json", *options], text=True,
                               cwd=self.folder, stdout=subprocess.PIPE, check=True)
        (self.folder / "answers.json").write_text(found.stdout)
        return json.loads(found.stdout)

    def page(self, answers=None):
        if answers is not None:
            (self.folder / "answers.json").write_text(json.dumps(answers))
        self.assertIn("answers.html", self.output_of("answers.json"))
        return Page((self.folder / "answers.html").read_text())

    def test_has_the_objects_in_order_and_loads_nothing(self):
        answers = self.answers("--period", "0.3,0.5", "--pga", "0.4", "--pga-max", "2")
        page = self.page()
        self.assertEqual(page.loads, [])
        rows = [row for row in page.rows if row]
        self.assertEqual([row[0] for row in rows], ["slim & tall", "statue", "vase <of glass>"])
        self.assertEqual([row[1] for row in rows], ["topples", "rocks", "slides"])
        self.assertEqual(rows[2][6], "above 2")
        self.assertEqual(rows[0][6], f"{int(answers['objects'][0]['topples_from'] * 1e4) / 1e4:.4f}")
        text = " ".join("".join(page.text).split())
        for words in ("1 of 3 objects topples in at least one of up to 2 cases",
                      "Nothing is known above the search, 2 g, of: vase <of glass>", "Objects slip on their base"):
            self.assertIn(words, text)

    def test_says_how_wide_the_worst_object_must_be(self):
        answers = self.answers("--period", "0.3,0.5", "--pga", "0.4")
        self.assertEqual(answers["least_widths"]["object"], "slim & tall")
        for widths, words in (([0.31, 0.40001], "With more width and all else equal, it stands from 0.4001 m in all cases, "
                                                "from 0.3100 m in 1 of 2, as searched up to 0.6 m in steps of 0.001 m"),
                              ([0.31, None], "No wider one is known to stand in all cases, as searched up to 0.6 m"),
                              ([0.31], "With more width and all else equal, it stands from 0.3100 m, as searched up to")):
            answers["least_widths"].update(safe_from=widths, end_of_search=0.6, step_of_search=0.001)
            self.assertIn("slim & tall is 0.2 m wide. " + words, " ".join("".join(self.page(answers).text).split()))
        answers["least_widths"] = None
        self.assertNotIn("m wide", "".join(self.page(answers).text))

    def test_numbers_objects_without_a_name_as_in_the_table(self):
        answers = self.answers("--period", "0.5", "--pga", "0.4", table="width,height\n0.4,1.6\n0.3,1.5\n")
        page = self.page(answers)
        self.assertEqual([row[0] for row in page.rows if row], ["object 2", "object 1"])
        self.assertIn("Object 2 is 0.3 m wide. ", " ".join("".join(page.text).split()))

    def test_never_shows_what_is_unknown_as_safe(self):
        answers = self.answers("--period", "0.5", "--pga", "0.4")
        answers["objects"][1].update(verdict="undecided", undecided_from=0.3, peak_of_alpha=None, slide=None)
        page = self.page(answers)
        row = next(row for row in page.rows if row and row[0] == "statue")
        self.assertEqual((row[1], row[3]), ("undecided", "unknown"))
        text = " ".join("".join(page.text).split())
        self.assertIn("Undecided: statue. Treat them as objects that topple.", text)
        self.assertIn("undecided", "".join(page.text).split("not found to topple")[1])  # the legend

    def test_without_a_strength_has_no_verdicts(self):
        self.answers("--record", str(JOBS / "synthetic.AT2"), table="name,width,height\nvase,0.2,0.5\n")
        text = " ".join("".join(self.page().text).split())
        self.assertIn("no strength was asked for", text)
        self.assertIn("No object slips on its base", text)
        self.assertNotIn("largest tilt", text)

    def test_of_a_table_is_that_of_its_answers(self):
        options = ("--period", "0.5", "--pga", "0.4")
        self.answers(*options)
        self.page()
        self.assertIn("objects.html", self.output_of("objects.csv", *options))
        self.assertEqual((self.folder / "objects.html").read_text(), (self.folder / "answers.html").read_text())
        self.assertEqual(self.run_tool("objects.csv").returncode, 2)  # the motion is missing
        self.assertEqual(self.run_tool("answers.json", "--pga", "1").returncode, 2)

    def test_refuses_other_files(self):
        for content, words in (("{}", "does not contain the answers"), ("text", "does not contain the answers")):
            (self.folder / "answers.json").write_text(content)
            run = self.run_tool("answers.json")
            self.assertEqual(run.returncode, 74)
            self.assertIn(words, run.stderr)
        self.assertEqual(self.run_tool("none.json").returncode, 74)
        self.answers("--period", "0.5", table="name,width,height\nvase,0.2,0.5\n")
        (self.folder / "answers.html").write_text("<p>mine</p>")
        self.assertEqual(self.run_tool("answers.json").returncode, 74)
        self.assertEqual((self.folder / "answers.html").read_text(), "<p>mine</p>")

    def test_rounds_strengths_down(self):
        self.assertEqual(report.number(0.35249999, ""), "0.3524")


if __name__ == "__main__":
    unittest.main()
