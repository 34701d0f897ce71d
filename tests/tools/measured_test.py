"""The page of reports, the check of the numbers that are quoted from it, and the comparison of two pages."""

import contextlib
import io
import pathlib
import sys
import tempfile
import types
import unittest

CHECKOUT = pathlib.Path(__file__).resolve().parents[2]
sys.path += [str(CHECKOUT / "docs"), str(CHECKOUT / "tools"), str(CHECKOUT / "tools" / "benchmarks")]
import compare  # noqa: E402
import everything  # noqa: E402
import quotes  # noqa: E402
import reports  # noqa: E402

RUN = ("100 x 100 points, rk45: 0.0438 s\nshare of rank 0: 99.74 %, 12196.2 times, 1000000 points, answer 520 ns\n"
       "8 wrong")
PAGE = {"tools/bench run": reports.Report("MPI          4", "2026-11-28", 63, RUN)}


class Pages(unittest.TestCase):
    def test_a_page_is_read_as_it_was_written(self):
        other = reports.Report("MPI          5\nmemory       1 kB", "2026-11-29", 7, "job: 76 inputs\n\n## not a heading")
        several = PAGE | {"tools/check fuzz 60": other, "tools/bench scale": PAGE["tools/bench run"]}
        page = reports.written("1234", several)
        self.assertEqual(reports.read(page), ("1234", several))
        self.assertEqual(page.count("MPI          4"), 1)
        self.assertEqual(reports.read("# No page"), ("", {}))

    def test_of_a_check_only_results_are_kept(self):
        output = ("[  0 s] 1 of 3: installing\n[1/2] Building CXX\n[ 10 s] 3 of 3: testing\n"
                  "      Start  1: a.b\n 1/2 Test  #1: a.b ....   Passed    0.1 sec\n"
                  "\n\n100% tests passed, 0 tests failed out of 2\n\nTotal Test time (real) =   1.2 sec\n"
                  "50 of 1000 kills: a run\n  800 runs\n[ 20 s]   it finished\nwritten: /tmp/x\n"
                  "  crashes within HDF5: 3, in /tmp/y\n[ 20 s] packages 1 s\n[ 20 s] tools/check: everything passed\n")
        self.assertEqual(reports.results_of(output), "100% tests passed, 0 tests failed out of 2\n\n  800 runs\n"
                         "it finished\n  crashes within HDF5: 3\ntools/check: everything passed")

    def test_output_of_a_command_may_have_any_bytes(self):
        with tempfile.TemporaryDirectory() as folder, contextlib.redirect_stdout(io.StringIO()):
            self.assertEqual(everything.output_of(r"printf '8 \377\n9'", pathlib.Path(folder)), (0, "8 \ufffd\n9"))

    def measured(self, page, commit, report, only="tools/bench run", machine="MPI          4"):
        """Measures with a command that prints a report."""
        saved = everything.commit_and_machine, everything.output_of
        everything.commit_and_machine = lambda: (commit, machine)
        everything.output_of = lambda command, folder: (0, report)
        try:
            with contextlib.redirect_stdout(io.StringIO()):
                everything.run(types.SimpleNamespace(output=page.parent, page=page, only=[only], checks=False))
        finally:
            everything.commit_and_machine, everything.output_of = saved
        return {name: each.text for name, each in reports.read(page.read_text())[1].items()}

    def test_a_second_call_replaces_or_adds_reports_and_another_commit_begins_a_new_page(self):
        with tempfile.TemporaryDirectory() as folder:
            page = pathlib.Path(folder) / "measured.md"
            self.measured(page, "1", "1 s", "tools/bench scale")
            self.assertEqual(self.measured(page, "1", "2 s", machine="MPI          5"),
                             {"tools/bench run": "2 s", "tools/bench scale": "1 s"})
            self.assertEqual(self.measured(page, "1", "3 s"),
                             {"tools/bench run": "3 s", "tools/bench scale": "1 s"})
            self.assertEqual(self.measured(page, "2", "4 s"), {"tools/bench run": "4 s"})


class Numbers(unittest.TestCase):
    def test_words_and_versions_with_digits_are_no_numbers(self):
        text = "rk45, AVX-512, figure_07a, Fig. 7a, 3.7.1.2, S62W, 1.5x: 1,000 and -3.5 or 1e-06/avx512, 4 x 10^-9."
        self.assertEqual([number.value for number in reports.numbers(text)], [1000, -3.5, 1e-6, 4e-9])

    def test_numbers_in_a_row_have_the_unit_of_the_last(self):
        self.assertEqual([number.unit for number in reports.numbers("3; 0.5 to 4 ms, 5 and 6 %, 7 million, 8 cats")],
                         ["", "ms", "ms", "%", "%", "million", ""])


class Quotes(unittest.TestCase):
    def errors(self, block, marker="tools/bench run", measured=PAGE):
        return quotes.check("page.md", f"Text 777.\n\n<!-- measured: {marker} -->\n{block}\n\nAfter 888.\n", measured)

    def test_rounded_numbers_pass_in_any_unit(self):
        for right in ("It takes 0.04 s, or 44 ms, 43.8 ms.", "99.7 % or 100 %", "12200, 12,196 or 12000", "1 million",
                      "10^6 points", "0.5 to 0.52 us", "1.0 x 10^6", "none", "```text\n8 wrong\n```"):
            self.assertEqual(self.errors(right), ([], set()), right)

    def test_other_numbers_fail(self):
        for wrong in ("0.05 s", "43 ms", "0.0437", "99.8 %", "12197", "13000", "2 million", "0.53 us", "8.2 s", "-8",
                      "9 wrong", "```text\n9 wrong\n```", "two lines,\nof which the second has 9"):
            self.assertEqual(len(self.errors(wrong)[0]), 1, wrong)
        self.assertIn("page.md:3: not in the report of tools/bench run: 0.05 s, 9", self.errors("0.05 s and 8, 9")[0])

    def test_code_links_and_the_labels_of_tables_are_not_checked(self):
        self.assertEqual(self.errors("`--points 5`, [8](page.md#part-17)"), ([], set()))
        table = "| points | 7 |\n| --- | --- |\n| 9 x 9 | 0.044 |\n| 10 | {} |"
        self.assertEqual(self.errors(table.format(8)), ([], set()))
        self.assertEqual(len(self.errors(table.format(9))[0]), 1)

    def test_a_block_may_quote_several_reports_and_their_commands(self):
        two = PAGE | {"tools/check fuzz 60": reports.Report("MPI          4", "2026-11-29", 7, "job: 7650123 inputs")}
        marker = "tools/bench run; tools/check fuzz 60"
        self.assertEqual(self.errors("7.7 million in 60 s, 8", marker, two), ([], set()))

    def test_a_command_that_is_not_measured_is_missing_and_an_unknown_one_is_an_error(self):
        self.assertEqual(self.errors("9", "tools/bench scale"), ([], {"tools/bench scale"}))
        self.assertEqual(len(self.errors("8", "tools/bench scala")[0]), 1)

    def test_a_marker_that_is_not_understood_is_an_error(self):
        for text in ("<!-- measured tools/bench run -->\n8", "<!--measured: tools/bench run -->\n8",
                     "<!-- measured: tools/bench run -->\n\n8"):
            self.assertEqual(len(quotes.check("page.md", text, PAGE)[0]), 1, text)


class Comparison(unittest.TestCase):
    def wrong(self, new, old=RUN, command="tools/bench run"):
        return len(compare.compared(command, old, new)[1])

    def test_texts_and_counts_must_be_the_same(self):
        self.assertEqual(self.wrong(RUN), 0)
        self.assertEqual(self.wrong(RUN.replace("8 wrong", "9 wrong")), 1)
        self.assertEqual(self.wrong(RUN.replace("wrong", "right")), 1)
        self.assertEqual(self.wrong(RUN + "\none more line"), 1)

    def test_what_depends_on_the_time_of_a_kill_may_differ(self):
        faults = {"command": "tools/check faults 1000"}
        self.assertEqual(self.wrong(RUN.replace("8 wrong", "9 wrong"), **faults), 0)
        printed, wrong = compare.compared("tools/check faults 1000", RUN, "    2 rare events\n" + RUN)
        self.assertEqual((printed[0], wrong), ("only new:     2 rare events", []))
        self.assertEqual(self.wrong("\n".join(reversed(RUN.splitlines())), **faults), 0)

    def test_times_are_printed_and_ratios_are_marked(self):
        slower = RUN.replace("0.0438", "0.0876").replace("12196", "15000")
        printed, wrong = compare.compared("tools/bench run", RUN, slower)
        self.assertEqual(wrong, [])
        self.assertIn("[2.00]", printed[0])
        self.assertIn("[1.00 1.23! 1.00]", printed[1])

    def test_instructions_may_differ_by_a_thousandth(self):
        old = "instructions per point\nregion 12149.3 +18.0 %"
        self.assertEqual(self.wrong(old.replace("12149", "12160"), old), 0)
        self.assertEqual(self.wrong(old.replace("12149", "12163"), old), 1)


if __name__ == "__main__":
    unittest.main()
