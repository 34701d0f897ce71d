"""Reports of benchmarks and checks, the page that contains them, docs/measured.md, and the numbers in them."""

import re
import typing

TITLE = """\
# Measured

The measured numbers of the documentation are from these reports of commands, except for those that state a date of
their own. `tools/bench all --checks` writes this page, and `tools/check docs` compares the others with it.
"""
# Lines that are no result: progress, lists of builds and tests, load and paths of the machine.
PROGRESS = re.compile("|".join((
    r"\[ *\d+ s\] (?!  |skipped|tools/check:)", r"\[\d+/\d+\] ", r"-- ", r"\s*round \d+ of \d+$", r"\d+ of \d+ kills: ",
    r"\.+$", r"written: ", r"\S+: written", r"Logs and inputs are in ", r"installing missing dependencies",
    r"All packages are installed", r"settling verdicts and computing about", r"shake_table: (verdicts of|rock)",
    r"Process 0 Terminating",  # of OpenSees
    # of Google Benchmark, whose units vary, GoogleTest, ctest and unittest
    r"Benchmark +Time", r"\S+_(?:mean|median|stddev|cv) ",
    r"\d{4}-\d\d-\d\dT", r"Running /", r"Run on \(", r"CPU Caches:", r"  L\d ", r"Load Average:", r"\*\*\*WARNING",
    r"Note: ", r"Repeating all tests", r"\[[=-]+\]", r"\[  PASSED  \]", r"Test project ", r"\s+Start +\d+: ",
    r"\s*\d+/\d+ Test +#", r"Label Time Summary", r"\w+ += .* sec\*proc", r"Total Test time", r"-+$", r"Ran \d+ tests?",
    r"OK$")))


class Report(typing.NamedTuple):
    machine: str  # lines
    day: str
    seconds: int  # that the command took
    text: str


def results_of(output):
    """What a command printed, without the lines that are no result; of a check, what follows its build."""
    lines = output.splitlines()
    built = [i for i, line in enumerate(lines) if re.match(r"\[ *\d+ s\] 3 of 3:", line)]
    kept = [re.sub(r"^\[ *\d+ s\] *|, in /\S+$", "", line).rstrip() for line in lines[built[0] if built else 0:]
            if not PROGRESS.match(line)]
    return re.sub(r"\n{3,}", "\n\n", "\n".join(kept)).strip("\n")


def written(commit, reports):
    """The page of reports, by command, that were measured at a commit. Machines are numbered."""
    machines = list(dict.fromkeys(report.machine for report in reports.values()))
    head = "\n\n".join([f"commit       {commit}", *(f"machine      {i}\n{lines}" for i, lines in enumerate(machines, 1))])
    return "\n".join((TITLE, f"```text\n{head}\n```", *(
        f"\n## `{command}`\n\n{report.day}, machine {machines.index(report.machine) + 1}, {report.seconds} s\n\n"
        f"```text\n{report.text}\n```" for command, report in reports.items()))) + "\n"


def read(page):
    """Returns the commit and the reports of a page."""
    head = re.search(r"^```text\ncommit +(\S+)\n(.*?)^```$", page, re.DOTALL | re.MULTILINE)
    if not head:
        return "", {}
    machines = dict(re.findall(r"^machine +(\d+)\n(.*?)\n$", head[2] + "\n", re.DOTALL | re.MULTILINE))
    found = re.finditer(r"^## `([^`\n]+)`\n\n(\S+), machine (\d+), (\d+) s\n\n```text\n(.*?)\n```$", page,
                        re.DOTALL | re.MULTILINE)
    return head[1], {each[1]: Report(machines[each[3]], each[2], int(each[4]), each[5]) for each in found}


SCALES = {"": (1, ""), "%": (0.01, ""), "million": (1e6, ""), "billion": (1e9, ""),
          "ns": (1e-9, "s"), "us": (1e-6, "s"), "ms": (1e-3, "s"), "s": (1, "s"), "min": (60, "s"), "h": (3600, "s"),
          "bytes": (1, "byte"), "kB": (1e3, "byte"), "MB": (1e6, "byte"), "GB": (1e9, "byte"), "TB": (1e12, "byte"),
          "KiB": (2**10, "byte"), "MiB": (2**20, "byte"), "GiB": (2**30, "byte")}
NUMBER = re.compile(
    r"(?<![\w.])(?<![A-Za-z]-)(?P<digits>[+-]?(?:\d{1,3}(?:,\d{3})+|\d+)(?:\.\d+)?)(?:e(?P<exponent>[+-]?\d+))?"
    rf"(?:(?= ?(?P<unit>%|(?:{'|'.join(name for name in SCALES if name.isalpha())})\b))|(?!\.?\w))")
JOINED = re.compile(r" to |,? and | or |, |/")  # between numbers of one unit, as in "0.5 to 4 ms"


class Number(typing.NamedTuple):
    printed: str
    unit: str
    value: float  # in the unit
    half_digit: float  # half a unit of its last digit

    @property
    def scaled(self):
        scale, dimension = SCALES[self.unit]
        return scale * self.value, scale * self.half_digit, dimension

    def is_rounded(self, other):
        """Whether this number is the other one, rounded. Numbers without a unit may have any."""
        if abs(self.value - other.value) <= 1.001 * self.half_digit and (
                self.unit == other.unit or "" in (self.unit, other.unit)):
            return True
        (value, half_digit, dimension), (exact, _, of_other) = self.scaled, other.scaled
        return dimension == of_other and abs(value - exact) <= 1.001 * half_digit


def half_digit(digits, exponent):
    """Half a unit of the last digit. Zeros at the end of an integer may be rounded, but two digits are not."""
    digits = digits.lstrip("+-")
    if "." in digits:
        return 0.5 * 10.0**(exponent - len(digits.partition(".")[2]))
    digits = digits.replace(",", "")
    zeros = len(digits) - len(digits.rstrip("0"))
    return 0.5 * 10.0**(exponent + max(0, min(zeros, len(digits) - 2)))


def numbers(text):
    """The numbers of a text. Digits within a word, as in rk45 or AVX-512, and versions are none."""
    text = re.sub(r"([\d.]+) x 10\^(-?\d+)", r"\1e\2", text)
    text = re.sub(r"\b10\^(-?\d+)", r"1e\1", text)
    found, unit, begin = [], "", None
    for each in reversed(list(NUMBER.finditer(text))):
        joined = begin is not None and JOINED.fullmatch(text[each.end():begin])
        unit = each["unit"] or (unit if joined else "")
        begin, exponent = each.start(), int(each["exponent"] or 0)
        found.append(Number(each[0], unit, float(each["digits"].replace(",", "")) * 10.0**exponent,
                            half_digit(each["digits"], exponent)))
    return found[::-1]
