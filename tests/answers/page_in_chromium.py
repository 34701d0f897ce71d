#!/usr/bin/env python3
"""Opens pages of tools/report in Chromium: no error, no request to anywhere, rows in order, nothing cut off on a
screen, on a phone and in print.

Requires OVERTURN (the binary) in the environment, Chromium, its driver and Selenium.
"""

import base64
import json
import os
import pathlib
import re
import subprocess
import sys
import unittest

from selenium.webdriver.common.by import By
from selenium.webdriver.common.print_page_options import PrintOptions

TESTS = pathlib.Path(__file__).resolve().parents[1]
sys.path[:0] = [str(TESTS / "support"), str(TESTS.parent / "tools")]
from chromium import InChromium  # noqa: E402
from overturn import report  # noqa: E402

OVERTURN = os.path.abspath(os.environ["OVERTURN"])
ROOT = pathlib.Path(__file__).resolve().parents[2]
TABLE = """name;width_cm;height_cm;incline_deg;friction
<script>alert(1)</script>;18;45;0;0,2
Niké & "Éros";41;120;2;0,7
an object with a name that is much longer than any column of a table should be;20;160;0;0,7
"""


class Pages(InChromium):
    def opened(self, table, *options):
        """Opens the page about a table; returns the answers."""
        run = subprocess.run([OVERTURN, "assess", table, "--json", *options], cwd=self.folder, check=True,
                             stdout=subprocess.PIPE, text=True)
        (self.folder / "answers.json").write_text(run.stdout)
        subprocess.run([ROOT / "tools" / "report", "answers.json"], cwd=self.folder, check=True, stdout=subprocess.PIPE)
        self.requests()
        self.chromium.get((self.folder / "answers.html").as_uri())
        return json.loads(run.stdout)

    def assert_sound(self, answers):
        self.assertEqual(self.chromium.get_log("browser"), [])
        requests = self.requests()
        self.assertEqual(requests, [self.chromium.current_url])
        names = [row.text.split("\n")[0] for row in self.chromium.find_elements(By.CSS_SELECTOR, "tbody td:first-child")]
        self.assertEqual(names, report.titles_of(answers["objects"]))
        verdicts = [cell.text for cell in self.chromium.find_elements(By.CSS_SELECTOR, "tbody td.verdict")]
        self.assertEqual(verdicts, [row["verdict"] for row in answers["objects"]])
        picture = self.chromium.find_element(By.TAG_NAME, "svg")
        self.assertGreater(picture.size["height"], 50)

    def assert_fits(self, width):
        self.chromium.set_window_size(width, 900)
        wide, visible = self.chromium.execute_script(
            "const page = document.documentElement; return [page.scrollWidth, page.clientWidth]")
        self.assertLessEqual(wide, visible)

    def assert_fits_on_paper(self):
        """Nothing is wider than a sheet of A4 between its margins, 180 mm."""
        self.chromium.set_window_size(1200, 900)
        self.chromium.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": "print"})
        self.chromium.execute_script("document.body.style.width = '180mm'")
        table, page = self.chromium.execute_script(
            "return [document.querySelector('table').offsetWidth, document.body.clientWidth]")
        self.chromium.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": ""})
        self.assertLessEqual(table, page)

    def pages_in_print(self):
        """The number of printed pages."""
        options = PrintOptions()
        options.page_width, options.page_height = 21.0, 29.7
        printed = base64.b64decode(self.chromium.print_page(options))
        return len(re.findall(rb"/Type\s*/Page\b", printed))

    def test_the_statues_fit_on_two_sheets(self):
        answers = self.opened(ROOT / "jobs" / "statues.csv", "--period", "0.3,0.5", "--pga", "0.4")
        self.assert_sound(answers)
        self.assertLessEqual(self.pages_in_print(), 2)
        self.assert_fits(1200)
        self.assert_fits(375)
        self.assert_fits_on_paper()

    def test_names_are_texts_and_nothing_is_cut_off(self):
        (self.folder / "objects.csv").write_text(TABLE)
        answers = self.opened("objects.csv", "--period", "0.3,0.5", "--pga", "0.4")
        self.assert_sound(answers)
        self.assert_fits(1200)
        self.assert_fits(375)
        self.assert_fits_on_paper()

    def test_without_a_strength(self):
        answers = self.opened(ROOT / "jobs" / "statues.csv", "--record", ROOT / "jobs" / "synthetic.AT2")
        self.assertEqual(self.chromium.get_log("browser"), [])
        names = [row.text.split("\n")[0] for row in self.chromium.find_elements(By.CSS_SELECTOR, "tbody td:first-child")]
        self.assertEqual(names, report.titles_of(answers["objects"]))


if __name__ == "__main__":
    unittest.main()
