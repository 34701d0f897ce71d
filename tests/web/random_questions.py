#!/usr/bin/env python3
"""random_questions.py MODULE NATIVE_ANSWERS [QUESTIONS [SEED]]: random questions of the page, answered by the WebAssembly
module in Node and by the kernels of this computer, and by the program for some of them.

Verdicts must be equal wherever the bound of the error is below a tenth of the margin, peaks to 1e-9 alpha wherever the
bound is below 1e-10 and the peak changes as little at a hundred times the tolerance, or at 1 + 1e-13 times g: a block
that comes to rest forgets the errors of its peak. Every question is answered or refused by both, with equal exit codes; and the memory of the module
does not grow when all questions are asked again. Exit code 1 otherwise.
"""

import collections
import json
import math
import os
import pathlib
import random
import subprocess
import sys
import tempfile

FOLDER = pathlib.Path(__file__).resolve().parent
TOOLS = FOLDER.parents[1] / "tools"
PULSES = ["one_sine", "one_cosine", "symmetric_ricker", "antisymmetric_ricker", "half_sine", "rectangular", "triangular"]
RECORDS = 12


def block(rng):
    width = math.exp(rng.uniform(math.log(0.05), math.log(2)))
    block = {"width": width, "height": width * math.exp(rng.uniform(math.log(1.2), math.log(12)))}
    if rng.random() < 0.3:
        block["center_offset"] = rng.uniform(-0.3, 0.3) * width / 2
    if rng.random() < 0.2:
        block["incline"] = rng.uniform(-0.3, 0.3) * math.atan(width / block["height"])
    if rng.random() < 0.2:
        block["center_height"] = rng.uniform(0.3, 0.7) * block["height"]
    if rng.random() < 0.25:
        block["friction"] = rng.uniform(0.1, 1.2)
    return block


def motion(rng, records):
    if records and rng.random() < 0.25:
        return {"record": rng.choice(records)}
    kind = rng.random()
    given = {"period": math.exp(rng.uniform(math.log(0.1), math.log(3)))}
    if kind < 0.7:
        given["pulse"] = rng.choice(PULSES)
    elif kind < 0.8:
        given |= {"pulse": rng.choice(["sine", "cosine"]), "scene": {"cycles": rng.randint(1, 4)}}
    elif kind < 0.9:
        given |= {"pulse": "mavroeidis_papageorgiou",
                  "scene": {"gamma": rng.uniform(1.1, 3), "nu": rng.uniform(0, math.pi)}}
    return given


def one_object(rng, records):
    question = block(rng) | motion(rng, records)
    if rng.random() < 0.4:
        question["restitution_of_maximum"] = rng.uniform(0.5, 1)
    if rng.random() < 0.2:
        question["direction"] = rng.choice([0, 180])
    if "friction" not in question and rng.random() < 0.05:
        question["scene"] = question.get("scene", {}) | {"theory": "linear"}
    return question


def strength(rng, question):
    return math.tan(math.atan(question["width"] / question["height"])) * math.exp(rng.uniform(-0.3, 1.6))


def wrong(rng, question):
    """The same question with something that is refused."""
    changes = [{"width": -1}, {"height": 0}, {"width": "wide"}, {"weight": 3}, {"friction": -0.1}, {"pga": -0.5},
               {"period": 0}, {"pulse": "two_sine"}, {"record": "missing.AT2"}, {"restitution_of_maximum": 7},
               {"width": None}, {"incline": 1.5}, {"question": "guess"}, {"center_offset": 10}, {"direction": 91}]
    changed = question | rng.choice(changes)
    return {name: value for name, value in changed.items() if value is not None}


def question(rng, records):
    base = one_object(rng, records)
    pga = strength(rng, base)
    kind = rng.random()
    if kind < 0.03:
        return wrong(rng, {"question": "topple", **base, "pga": pga})
    if kind < 0.05 and "record" not in base:
        strengths = [pga * (0.6 + 0.1 * i) for i in range(8)]
        periods = [base["period"] * (0.6 + 0.1 * i) for i in range(8)]
        return {"question": "spectrum", **base, "pga": strengths, "x": {"quantity": "pulse_period", "values": periods}}
    if kind < 0.09:
        return {"question": "history", **base, "pga": pga, "samples": 50}
    if kind < 0.10:
        objects = [block(rng) for _ in range(3)]
        rows = "".join(f"{i},{each['width']!r},{each['height']!r}\n" for i, each in enumerate(objects))
        shaken = {"records": rng.sample(records, 2)} if records and kind < 0.093 else {"periods": [0.3, 0.7]}
        return {"question": "assess", "table": "name,width,height\n" + rows, "pga": pga, "pga_max": max(1, 2 * pga), **shaken}
    if kind < 0.11 and "friction" not in base and "record" not in base:
        return {"question": "topple", **base, "pga": pga, "pga_max": 3 * pga}
    return {"question": "topple", **base, "pga": pga, "search": False}


def answers_of(command, questions, **options):
    text = "".join(json.dumps(each) + "\n" for each in questions)
    done = subprocess.run(command, input=text, text=True, stdout=subprocess.PIPE, check=True, **options)
    answers = [json.loads(line) for line in done.stdout.splitlines()]
    assert len(answers) == len(questions), f"{command[0]}: {len(answers)} answers to {len(questions)} questions"
    return answers, done.stderr


class Comparison:
    """Counts what is equal, and collects what differs."""

    def __init__(self):
        self.counts = collections.Counter()
        self.differences = []

    def differ(self, question, what, *values):
        self.differences.append(f"{what}: {values}\n  {json.dumps(question)}")

    def add(self, question, module, native):
        if "failed" in module:
            self.differ(question, "the module failed", module)
        elif ("refused" in module) != ("refused" in native):
            self.differ(question, "only one refused", str(module)[:300], str(native)[:300])
        elif "refused" in module:
            self.counts["refused"] += 1
            if module["code"] != native["code"]:
                self.differ(question, "codes", module, native)
        else:
            self.counts[question["question"]] += 1
            getattr(self, question["question"])(question, module, native)

    def topple(self, question, module, native):
        others = {each["direction"]: each for each in module["by_direction"]}
        ours = {each["direction"]: each for each in native["by_direction"]}
        if others.keys() != ours.keys():
            self.differ(question, "directions", list(others), list(ours))
            return
        for numbers in native["numbers"]:
            one, other = ours[numbers["direction"]], others[numbers["direction"]]
            margin, error = numbers["margin"], numbers["error"]
            # Of a block that is not lifted, the margin is positive and free of errors of the integration.
            known = None not in (margin, error) and "infinite" not in (margin, error)
            if known and error < abs(margin) / 10:
                self.counts["verdicts"] += 1
                if one["topples"] != other["topples"]:
                    self.differ(question, "verdicts", one["topples"], other["topples"], margin, error)
                change = numbers["peak_change"]
                if error < 1e-10 and one["peak_of_alpha"] is not None and change is not None and abs(change) < 1e-10:
                    self.counts["peaks"] += 1
                    if not abs(one["peak_of_alpha"] - (other["peak_of_alpha"] or math.inf)) < 1e-9 and one["peak_of_alpha"]:
                        self.differ(question, "peaks", one["peak_of_alpha"], other["peak_of_alpha"], error)
            else:
                self.counts["uncertain"] += 1
                if None not in (one["topples"], other["topples"]) and one["topples"] != other["topples"]:
                    self.differ(question, "opposite verdicts of an uncertain point", margin, error)
            if not math.isclose(one["lifting_pga"] or 0, other["lifting_pga"] or 0, rel_tol=1e-12):
                self.differ(question, "lifting_pga", one["lifting_pga"], other["lifting_pga"])
            if "search" not in question and "record" not in question:  # there, ranges narrower than the steps exist
                self.ranges(question, other, one)

    def ranges(self, question, module, native):
        """The middle of each range of one, unless it is narrow, has the same verdict in the other. (Near an accumulation of
        flips, the search may find another number of narrow ranges.)"""
        for one, other in ((module, native), (native, module)):
            for key in ("toppling_pga", "safe_pga"):
                for first, last in one[key]:
                    last = one["end_of_search"] if last is None else last
                    middle = (first + last) / 2
                    if last - first > 1e-6 * middle:
                        self.counts["ranges"] += 1
                        if not any(begin <= middle <= (math.inf if end is None else end) for begin, end in other[key]):
                            self.differ(question, f"{key} at {middle}", module[key], native[key])

    def history(self, question, module, native):
        if None not in (module["verdict"], native["verdict"]) and "undecided" not in (module["verdict"], native["verdict"]):
            if module["verdict"] != native["verdict"]:
                self.differ(question, "verdicts of histories", module["verdict"], native["verdict"])
        if module["is_curve_certain"] and native["is_curve_certain"] and module["verdict"] == native["verdict"]:
            for name in ("end_of_motion", "time_of_fall"):
                a, b = module[name], native[name]
                if (a is None) != (b is None) or a is not None and not math.isclose(a, b, rel_tol=1e-6):
                    self.differ(question, name, a, b)

    def spectrum(self, question, module, native):
        for one, other in zip(module["verdicts"], native["verdicts"], strict=True):
            self.counts["pixels"] += 1
            if one != other and "u" not in (one, other):
                self.differ(question, "pixels", module["verdicts"], native["verdicts"])
                return

    def assess(self, question, module, native):
        rows = [{each["name"]: each for each in answer["objects"]} for answer in (module, native)]
        for name, one in rows[1].items():
            other = rows[0][name]
            if one["verdict"] != other["verdict"] and "undecided" not in (one["verdict"], other["verdict"]):
                self.differ(question, "verdicts of objects", one["verdict"], other["verdict"])
            a, b = one["topples_from"], other["topples_from"]
            # Ends of ranges are refined to 1e-4.
            if (a is None) != (b is None) or a is not None and not math.isclose(a, b, rel_tol=2e-4):
                self.differ(question, "topples_from", a, b)


def options_of(question, folder):
    """The options of the program for a question topple."""
    options = []
    for name, value in question.items():
        if name == "search":
            options.append("--no-search")
        elif name == "scene":
            options += [f"--set=scene.{key}={item}" for key, item in value.items()]
        elif name != "question":
            value = folder / value if name == "record" else value
            options.append(f"--{name.replace('_', '-')}={value}")
    return options


def main():
    module, native = sys.argv[1:3]
    count = int(sys.argv[3]) if len(sys.argv) > 3 else 10_000
    seed = int(sys.argv[4]) if len(sys.argv) > 4 else 1
    rng = random.Random(seed)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        subprocess.run([TOOLS / "synthetic_record", "--suite", str(RECORDS), "--seed", str(seed), "-o", folder],
                       check=True, stdout=subprocess.DEVNULL)
        records = sorted(folder.iterdir())
        questions = [question(rng, [each.name for each in records]) for _ in range(count)]
        comparison = Comparison()
        node = ["node", FOLDER / "node_answers.mjs", module, *records]
        modules, _ = answers_of(node, questions, stderr=subprocess.PIPE)
        natives, _ = answers_of([native, *records], questions)
        for asked, one, other in zip(questions, modules, natives, strict=True):
            comparison.add(asked, one, other)
        answered = [asked for asked, one in zip(questions, modules, strict=True) if "refused" not in one][: count // 4]
        memory = [int(answers_of(node, answered * times, stderr=subprocess.PIPE)[1]) for times in (1, 2)]
        if memory[1] > memory[0]:
            comparison.differ({}, "the memory of the module grows when questions are repeated", memory)
        program = os.environ.get("OVERTURN")
        for asked, one in zip(questions, natives, strict=True):
            if program and asked["question"] == "topple" and "refused" not in one and comparison.counts["program"] < 100:
                comparison.counts["program"] += 1
                printed = json.loads(subprocess.run([program, "topple", "--json", *options_of(asked, folder)], text=True,
                                                    stdout=subprocess.PIPE, check=True).stdout)
                if any(printed[key] != one[key] for key in printed if key != "motion"):
                    comparison.differ(asked, "the program and the native answers")
    print(f"{count} questions, seed {seed}:", ", ".join(f"{n} {what}" for what, n in comparison.counts.items()),
          f"; memory {memory[1] / 2**20:.1f} MiB")
    print(*comparison.differences[:10], f"{len(comparison.differences)} differences", sep="\n")
    return 1 if comparison.differences else 0


if __name__ == "__main__":
    sys.exit(main())
