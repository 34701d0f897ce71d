#!/usr/bin/env python3
"""Questions of the page: the answers are those of the program, and what is wrong is refused with the place."""

import json
import os
import pathlib
import subprocess
import tempfile
import unittest

TOOLS = pathlib.Path(__file__).resolve().parents[2] / "tools"
VASE = {"width": 0.18, "height": 0.45}
SINE = {"period": 0.5, "pga": 0.6}


def asked(*questions, files=()):
    text = "".join(json.dumps(each) + "\n" for each in questions)
    done = subprocess.run([os.environ["NATIVE_ANSWERS"], *files], input=text, text=True, stdout=subprocess.PIPE, check=True)
    answers = [json.loads(line) for line in done.stdout.splitlines()]
    return answers[0] if len(questions) == 1 else answers


def printed(*arguments):
    done = subprocess.run([os.environ["OVERTURN"], *map(str, arguments), "--json"], text=True, stdout=subprocess.PIPE,
                          check=True)
    return json.loads(done.stdout)


class Questions(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))

    def test_topple_is_that_of_the_program(self):
        answer = asked({"question": "topple", **VASE, **SINE, "search": False, "center_offset": 0.01})
        del answer["numbers"]
        self.assertEqual(answer, printed("topple", "--width=0.18", "--height=0.45", "--center-offset=0.01", "--period=0.5",
                                         "--pga=0.6", "--no-search"))

    def test_a_varied_quantity_is_that_of_the_program(self):
        self.assertEqual(asked({"question": "topple", "height": 0.45, **SINE, "vary": ["width", 0.1, 0.3]}),
                         printed("topple", "--height=0.45", "--period=0.5", "--pga=0.6", "--vary", "width", 0.1, 0.3))

    def test_assess_is_that_of_the_program(self):
        table = "name,width_cm,height_cm\nvase,18,45\nstatue,41,120\n"
        (self.folder / "objects").write_text(table)
        answer = asked({"question": "assess", "table": table, "periods": [0.3, 0.5], "pga": 0.25, "pga_max": 1})
        program = printed("assess", self.folder / "objects", "--period=0.3,0.5", "--pga=0.25", "--pga-max=1")
        self.assertEqual({**answer, "table": None}, {**program, "table": None})

    def test_a_history_begins_at_rest_and_has_the_verdict(self):
        answer = asked({"question": "history", **VASE, **SINE, "samples": 100})
        self.assertEqual((answer["time"][0], answer["angle"][0], answer["verdict"]), (0, 0, "topples"))
        self.assertEqual(answer["time"], sorted(answer["time"]))
        self.assertAlmostEqual(answer["time"][-1], answer["time_of_fall"])
        self.assertAlmostEqual(abs(answer["angle"][-1]), 3.141592653589793 / 2, places=9)
        self.assertIsNone(answer["slide"])

    def test_a_spectrum_has_a_row_per_strength(self):
        strengths, periods = [0.3, 0.6, 1.2], [0.2, 0.5]
        answer = asked({"question": "spectrum", **VASE, "pga": strengths, "x": {"quantity": "pulse_period", "values": periods}})
        letters = []
        for pga in strengths:
            for period in periods:
                point = asked({"question": "topple", **VASE, "pga": pga, "period": period, "search": False})
                letters.append("t" if point["topples"] else "r" if point["peak_of_alpha"] == 0 else "s")
        self.assertEqual(answer["verdicts"], "".join(letters))
        self.assertEqual(set(letters), {"r", "s", "t"})

    def test_the_worse_direction_counts_in_a_spectrum(self):
        leaning = {"question": "spectrum", **VASE, "center_offset": 0.03, "pga": [0.35, 0.5, 0.7],
                   "x": {"quantity": "pulse_period", "values": [0.4, 0.6]}}
        both, *each = asked(leaning, {**leaning, "direction": 0}, {**leaning, "direction": 180})
        worst = ["rsut"[max("rsut".index(letter) for letter in point)] for point in zip(*(one["verdicts"] for one in each))]
        self.assertEqual(both["verdicts"], "".join(worst))
        self.assertNotEqual(each[0], each[1])

    def test_a_record_is_read_and_shakes(self):
        path = self.folder / "a.AT2"
        subprocess.run([TOOLS / "synthetic_record", "--duration=5", "-o", path], check=True, stdout=subprocess.PIPE)
        record, answer = asked({"question": "record", "record": "a.AT2"},
                               {"question": "topple", **VASE, "record": "a.AT2", "scale": 1.5, "search": False}, files=[path])
        self.assertEqual((record["format"], len(record["components"])), ("AT2", 1))
        self.assertAlmostEqual(1.5 * record["components"][0]["pga"], answer["pga"], places=12)
        self.assertEqual(answer["verdict"], printed("topple", "--width=0.18", "--height=0.45", f"--record={path}",
                                                    "--scale=1.5", "--no-search")["verdict"])

    def test_what_is_wrong_is_refused(self):
        vase = {"question": "topple", **VASE, **SINE}
        for question, code, words in (
                ({**vase, "width": -1}, 2, "width = -1 is outside (0, inf)"),
                ({**vase, "width": "18"}, 2, 'width = "18" is not a number'),
                ({**vase, "weight": 3}, 2, '"weight" is not a member'),
                ({**vase, "pga": 0}, 2, "pga = 0 is not allowed"),
                ({**vase, "pulse": "two_sine"}, 65, 'scene.pulse = "two_sine" is unknown'),
                ({**vase, "vary": ["mass", 1, 2]}, 2, "vary is not the name of a quantity"),
                ({"question": "topple", **VASE}, 2, "the ground motion is missing"),
                ({"question": "topple", **VASE, "record": "b.AT2"}, 65, "b.AT2: is not one of the files"),
                ({"question": "spectrum", **VASE, "period": 1}, 2, "a spectrum needs pga"),
                ({"question": "guess"}, 2, 'there is no question "guess"'),
                ([1], 2, "not a JSON object")):
            with self.subTest(question=question):
                answer = asked(question)
                self.assertEqual(answer["code"], code)
                self.assertIn(words, answer["refused"])


if __name__ == "__main__":
    unittest.main()
